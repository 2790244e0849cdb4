"""Sliding forces at thousands of motions against the sums of each."""

import numpy as np
import pytest

from ehl.oil._rheology_kernels import shear_stress
from ehl.oil.rheology import Rheology, ShearLaw, kernel_rheology
from ehl.traction.film_quadrature import FilmQuadrature, sliding_forces
from ehl.traction.many_motions import many_sliding_forces

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


@pytest.mark.parametrize("name", LAWS)
def test_forces_by_blocks_are_plain_sums(name):
    """Of 37 motions, a block and part of another, from rest to 30 m/s."""
    rheology = LAWS[name]
    own = film(rheology, limited=rheology.limiting_coefficient is not None)
    x, y, area, gap, eta, limit, spread_x, spread_y = own.nodes
    law = kernel_rheology(rheology)[:4]
    rng = np.random.default_rng(7)
    slide = rng.choice([-1.0, 1.0], (3, 37)) * 10.0 ** rng.uniform(-7.0, 1.5, (3, 37))
    slide[:, 0] = 0.0
    found = sliding_forces(own, tuple(slide), np.full(37, 1000.0), 20.0)
    height = 20.0 * np.minimum(y * y, own.half_width**2)
    for (slide_x, slide_y, spin), forces in zip(slide.T, found, strict=True):
        at_x, at_y = slide_x - spin * y - 1000.0 * height, slide_y + spin * x
        slope = spin + np.where(np.abs(y) < own.half_width, 2.0 * 1000.0 * 20.0 * y, 0.0)
        size = np.sqrt(at_x**2 + at_y**2 + slope**2 * spread_y + spin**2 * spread_x)
        tau = [shear_stress(*numbers, *law) for numbers in zip(size / gap, eta, limit, strict=True)]
        t_x, t_y = area * tau * at_x / size, area * tau * at_y / size
        wanted = np.array([-t_x.sum(), -t_y.sum(), (y * t_x - x * t_y).sum(), (height * t_x).sum()])
        parts = np.array([np.abs(part).sum() for part in (t_x, t_y, y * t_x - x * t_y, height * t_x)])
        assert np.all(np.abs(forces - wanted) <= 1e-8 * parts + 1e-300)


def test_no_sliding_has_no_force():
    own = film(LAWS["eyring"], limited=True)
    none = np.zeros(2)
    assert np.all(many_sliding_forces(own, (none, none, none), none, 0.0) == 0.0)
