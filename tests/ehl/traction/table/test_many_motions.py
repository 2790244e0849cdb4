"""Sliding forces at thousands of motions against the sums of each."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from oilfilm.ehl.oil._kernels import shear_stress
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, kernel_rheology
from oilfilm.ehl.traction.film_quadrature import FilmQuadrature, sliding_forces
from oilfilm.ehl.traction_table.film import vectorised_sliding_forces

from ....reference.ehl.traction import over_strip

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
    several, each = (f(own, tuple(slide), rolling, 20.0) for f in (vectorised_sliding_forces, sliding_forces))
    assert np.all(np.abs(several - each) < 6e-4 * np.abs(each).max(axis=0))


@pytest.mark.parametrize("width", [0.0, 1e-4])
def test_thin_oil_on_one_line_counts_once(width):
    """Nodes of low pressure beside a light contact, whose ellipse may be narrower than one row of them."""
    own = film(LAWS["limited"], limited=True)
    own.nodes[1] *= width / 1e-3
    own.nodes[4] = 1e-3
    size = 10.0 ** np.random.default_rng(9).uniform(-7.0, 0.5, (3, 100))
    slide = tuple(size * np.array([[1.0], [1.0], [300.0]]))
    several, each = (f(own, slide, np.full(100, 1000.0), 20.0) for f in (vectorised_sliding_forces, sliding_forces))
    assert np.all(np.abs(several - each) <= 6e-4 * np.abs(each).max(axis=0))


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
        at_y, size = over_strip(at_x, at_y, slope * np.sqrt(12.0 * spread_y), spin**2 * spread_x)
        tau = [shear_stress(*numbers, *law) for numbers in zip(size / gap, eta, limit, strict=True)]
        t_x, t_y = area * tau * at_x / size, area * tau * at_y / size
        wanted = np.array([-t_x.sum(), -t_y.sum(), (y * t_x - x * t_y).sum(), (height * t_x).sum()])
        parts = np.array([np.abs(part).sum() for part in (t_x, t_y, y * t_x - x * t_y, height * t_x)])
        assert np.all(np.abs(forces - wanted) <= 1e-8 * parts + 1e-300)


@pytest.mark.parametrize("s_y", [1e-3, 0.3, 1.0])
def test_a_limiting_stress_is_averaged_over_a_strip(s_y):
    """Means of s_x/s and s_y/s where s_x changes by 2: the first exactly, the second to 8 % up to z = 0.9."""
    for s_x in np.linspace(-3.0, 3.0, 13):
        at_y, size = over_strip(s_x, s_y, 2.0, 0.0)
        along = quad(lambda s: s / np.hypot(s, s_y), s_x - 1.0, s_x + 1.0, points=[0.0])[0] / 2.0
        across = s_y * (np.arcsinh((s_x + 1.0) / s_y) - np.arcsinh((s_x - 1.0) / s_y)) / 2.0
        assert_allclose(s_x / size, along, atol=1e-7)
        assert 0.0 < at_y / size < across * (1.0 + 1e-9)
        assert 1.0 / size > 0.9 or at_y / size > 0.92 * across


def test_no_sliding_has_no_force():
    own = film(LAWS["eyring"], limited=True)
    none = np.zeros(2)
    assert np.all(vectorised_sliding_forces(own, (none, none, none), none, 0.0) == 0.0)
