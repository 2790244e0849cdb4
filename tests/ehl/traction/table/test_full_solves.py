"""The films of traction tables beside full solves: equal where nothing is left out, thinner and warmer where it is."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.ehl import Lubricant, SolverOptions
from oilfilm.ehl.oil.lubricant import ThermalProperties
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction_table.full_solves import SLIDE_RATIOS, full_solves
from oilfilm.ehl.traction_table.table import TableContact, TableRange

OIL = Lubricant(
    viscosity=0.04,
    pressure_viscosity=15e-9,
    temperature=313.15,
    thermal=ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.035, expansion=7e-4),
)
STEEL = SolidThermal(conductivity=46.0, density=7850.0, specific_heat=470.0)
LIMITS = TableRange(load=(40.0, 60.0), speed=(2.0, 3.0))
OPTIONS = SolverOptions(points=65)


def contact(rheology, solids=None):
    return TableContact(
        radius_x=8e-3,
        radius_y=12e-3,
        reduced_modulus=2.3e11,
        lubricant=OIL,
        rheology=rheology,
        temperature=313.15,
        solids=solids,
    )


def test_nothing_is_left_out_of_a_newtonian_film_without_heat():
    for one in full_solves(contact(Rheology()), LIMITS, 2, options=OPTIONS):
        assert one.converged
        assert one.film_ratio == 1.0
        assert_allclose(one.in_full, one.by_film, rtol=1e-12)


def test_gentle_thinning_is_what_the_film_tells():
    """An Eyring stress that hardly matters: the stress in the middle of the film against that of the whole film."""
    gentle = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e8)
    for one in full_solves(contact(gentle), LIMITS, 2, options=OPTIONS):
        assert one.converged
        assert_allclose(one.film_ratio, 1.0, atol=2e-3)
        assert_allclose(one.in_full, one.by_film, rtol=0.02)


def test_heat_takes_friction():
    oil = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
    warm = full_solves(contact(oil, (STEEL, STEEL)), LIMITS, 2, options=OPTIONS)
    cold = full_solves(contact(oil), LIMITS, 2, options=OPTIONS)
    for with_heat, without in zip(warm, cold, strict=True):
        assert with_heat.load == without.load
        assert with_heat.in_full < without.in_full < without.by_film
        assert with_heat.by_film < without.by_film
        assert without.film_ratio < 1.0


def test_the_limiting_stress_cuts_both():
    limited = Rheology(
        law=ShearLaw.REE_EYRING,
        eyring_stress=5e8,
        limiting_coefficient=0.014,
        limiting_minimum=1.0,
        limiting_temperature_slope=0.02,  # 0.01 at 20 K above the reference temperature
        reference_temperature=293.15,
    )
    for one in full_solves(contact(limited), LIMITS, 2, options=OPTIONS):
        assert one.in_full < 0.0101
        assert_allclose(one.in_full, one.by_film, rtol=0.03)


def test_places_fill_the_range_once_each():
    told = []
    found = full_solves(contact(Rheology()), LIMITS, 3, options=OPTIONS, progress=lambda *state: told.append(state))
    assert [state[:2] for state in told] == [(1, 3), (2, 3), (3, 3)]
    for values, ends in (
        ([one.load for one in found], LIMITS.load),
        ([one.speed for one in found], LIMITS.speed),
        ([one.slide_ratio for one in found], SLIDE_RATIOS),
    ):
        thirds = np.floor(3.0 * np.log(np.array(values) / ends[0]) / np.log(ends[1] / ends[0]))
        assert sorted(thirds) == [0, 1, 2]
