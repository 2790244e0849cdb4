"""Contacts with an oil that thins under shear: limits, signs, and independence of how the iteration went."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.generalized.flow import GeneralizedFlow
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw

from ..reference.ehl.uniform_flow import UniformFlow

OIL = Lubricant(viscosity=0.04, pressure_viscosity=2e-8)
CIRCULAR = ContactConditions(
    load=20.0, radius_x=0.0127, radius_y=0.0127, reduced_modulus=2.2e11, entrainment_speed=1.0, lubricant=OIL
)
WIDE = ContactConditions(
    load=500.0,
    radius_x=4.8e-3,
    radius_y=0.216,
    reduced_modulus=3.3e11,
    entrainment_speed=15.0,
    lubricant=replace(OIL, viscosity=0.0261, pressure_viscosity=1.8e-8),
)

EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
CARREAU = Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=5e5, carreau_exponent=0.46)
COARSE = SolverOptions(points=129)


def solve(conditions, rheology, options=COARSE):
    solution = solve_contact(conditions, options, GeneralizedFlow(conditions=conditions, rheology=rheology))
    assert solution.converged
    return solution


def newtonian(conditions):
    """The Newtonian film, come to rest on the way that films with a flow model take."""
    return solve_contact(conditions, COARSE, UniformFlow())


@pytest.mark.parametrize("slip", [0.0, 1.0])
def test_newtonian_law_is_the_plain_solve(slip):
    conditions = replace(CIRCULAR, slide_roll_ratio=slip)
    film = solve(conditions, Rheology())
    assert_allclose(film.H, newtonian(conditions).H, rtol=1e-9)
    assert_allclose(film.film_central, solve_contact(conditions, COARSE).film_central, rtol=1e-3)


@pytest.mark.parametrize("conditions", [CIRCULAR, WIDE], ids=["circular", "wide"])
@pytest.mark.parametrize("slip", [0.0, 1.5])
def test_high_eyring_stress_is_newtonian(conditions, slip):
    """The first deviation is (tau/tau_0)^2/6; 1e12 Pa leaves (1e9/1e12)^2/6 < 2e-7 at stresses that never occur."""
    conditions = replace(conditions, slide_roll_ratio=slip)
    thin = solve(conditions, replace(EYRING, eyring_stress=1e15))
    assert_allclose(thin.film_central, newtonian(conditions).film_central, rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("conditions", [CIRCULAR, WIDE], ids=["circular", "wide"])
@pytest.mark.parametrize("rheology", [EYRING, CARREAU], ids=["eyring", "carreau"])
def test_thinning_takes_film_away_and_sliding_more(conditions, rheology):
    """Both laws thin the oil in the inlet, a sliding contact more than a rolling one."""
    plain = solve_contact(conditions, COARSE).film_central
    rolling = solve(conditions, rheology).film_central
    sliding = solve(replace(conditions, slide_roll_ratio=1.0), rheology).film_central
    assert sliding < rolling < plain


def test_direction_of_sliding_does_not_matter():
    """Exchanging the bodies leaves the film: positive and negative slip at equal entrainment."""
    ahead, behind = (solve(replace(CIRCULAR, slide_roll_ratio=slip), EYRING) for slip in (0.7, -0.7))
    assert_allclose(ahead.film_central, behind.film_central, rtol=1e-6)


def test_lateral_sliding_and_spin_converge():
    """Sliding at right angles to the flow thins the oil without any rolling of its own; the film stays even in y."""
    lateral = solve(replace(CIRCULAR, lateral_slide_ratio=0.5), EYRING)
    spinning = solve(replace(CIRCULAR, spin=1000.0), EYRING)
    plain = solve_contact(CIRCULAR, COARSE).film_central
    for solution in (lateral, spinning):
        assert 0.8 * plain < solution.film_central < plain
    assert_allclose(lateral.H, lateral.H[:, ::-1], rtol=0.05)


@pytest.mark.slow
def test_film_converges_with_the_mesh():
    """Eyring sliding: three meshes, differences falling about fourfold (twofold at least)."""
    conditions = replace(CIRCULAR, slide_roll_ratio=1.0)
    films = [
        solve(conditions, EYRING, SolverOptions(points=n)).film_central_dimensionless.finest for n in (65, 129, 257)
    ]
    assert abs(films[2] - films[1]) < 0.5 * abs(films[1] - films[0])
    assert np.all(np.isfinite(films))
