"""Sliding forces at thousands of motions against the sums of each."""

import numpy as np
import pytest

from ehl.oil.rheology import Rheology, ShearLaw
from ehl.traction.film_quadrature import FilmQuadrature, sliding_forces
from ehl.traction.table.many_motions import many_sliding_forces

LAWS = {
    "newtonian": Rheology(),
    "limited": Rheology(limiting_coefficient=0.05),
    "eyring": Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6, limiting_coefficient=0.05),
    "carreau": Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=7e6, carreau_exponent=0.5),
}


def film(rheology, *, limited):
    """Random nodes of viscosities over eight decades."""
    rng = np.random.default_rng(5)
    n = 300
    x, y = rng.uniform(-1e-4, 1e-4, n), rng.uniform(-1e-3, 1e-3, n)
    eta = 10.0 ** rng.uniform(-2.0, 6.0, n)
    limit = rng.uniform(5e6, 1e8, n) if limited else np.full(n, np.inf)
    rows = [x, y, np.full(n, 1e-10), rng.uniform(1e-7, 1e-6, n), eta, limit, np.full(n, 1e-12), np.full(n, 1e-10)]
    return FilmQuadrature(nodes=np.stack(rows), half_width=8e-4, rheology=rheology)


@pytest.mark.parametrize("name", LAWS)
def test_forces_are_those_of_each_motion(name):
    rheology = LAWS[name]
    own = film(rheology, limited=rheology.limiting_coefficient is not None)
    rng = np.random.default_rng(6)
    size = 10.0 ** rng.uniform(-7.0, 0.5, (3, 400))
    slide = np.sign(rng.uniform(-1.0, 1.0, size.shape)) * size * np.array([[1.0], [1.0], [300.0]])
    slide[:, :3] = 0.0  # at rest against each other
    rolling = np.full(400, 1000.0)
    several, each = (f(own, tuple(slide), rolling, 20.0) for f in (many_sliding_forces, sliding_forces))
    assert np.all(np.abs(several - each) < 6e-4 * np.abs(each).max(axis=0))


def test_no_sliding_has_no_force():
    own = film(LAWS["eyring"], limited=True)
    none = np.zeros(2)
    assert np.all(many_sliding_forces(own, (none, none, none), none, 0.0) == 0.0)
