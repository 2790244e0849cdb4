"""Traction curves of squalane: shape, limiting value and order of measured ones; no measured curve was at hand.

Viscosity and density at 298 K: Tait and Doolittle with the constants of Liu, Long, Li and Guo (2023), Table 1. Shear
thinning: Carreau with n = 0.463 and G = 6.94 MPa, quoted from memory after Bair (2006), unverified. Without a bound on
the stress that law gives 0.23 at 10 % slide and 1.3 GPa, isothermal, which no oil does; the limiting stress 0.05 p is
assumed, within the 0.035 to 0.088 of the oils in Arana et al. (2019). What measured curves of smooth contacts have in
common (Bjorling et al., 2013; Jacod, Venner and Lugt, 2001; both by their abstracts): a linear rise, a maximum or
plateau of some hundredths, the higher the pressure the steeper and the higher. Every property and the comparison stand
in docs/theory/traction.md; the contact is that of the shipped case, the loads give Hertz pressures of 0.8 and 1.3 GPa.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm import ehl
from oilfilm.cases import load_case
from oilfilm.ehl.conditions import ContactKinematics
from oilfilm.ehl.generalized.heated_film import heated_film, heated_forces
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.shear import integrate_traction

CARREAU = Rheology(
    law=ShearLaw.CARREAU_YASUDA, carreau_modulus=6.94e6, carreau_exponent=0.463, limiting_coefficient=0.05
)
STEEL = SolidThermal(conductivity=46.6, density=7850.0, specific_heat=460.0)
LOADS = (18.8, 80.8)  # [N]
RATIOS = np.array([1e-8, 2e-8, 0.003, 0.01, 0.03, 0.1])


def contact(load):
    """That of the shipped case under a load [N], rolling at 1 m/s without sliding."""
    return replace(load_case("squalane_ball_on_disc").conditions, load=load, slide_roll_ratio=0.0)


@pytest.fixture(scope="module")
def curves():
    """Coefficient over slide-roll ratio for two loads."""
    found = []
    for load in LOADS:
        solution = ehl.solve_contact(contact(load), ehl.SolverOptions(points=129))
        assert solution.converged
        motions = [ContactKinematics(entrainment_speed=1.0, sliding_x=ratio) for ratio in RATIOS]
        forces = [integrate_traction(solution, motion, CARREAU).sliding_force_x for motion in motions]
        found.append((solution, -np.array(forces) / load))
    return found


def test_the_shipped_case_shears_as_this_test_does():
    case = load_case("squalane_ball_on_disc")
    assert case.rheology == CARREAU
    assert case.conditions.lubricant.temperature == pytest.approx(298.15)
    assert case.conditions.load == LOADS[0]


def test_small_slides_shear_a_newtonian_oil(curves):
    """Twice the slide, twice the traction; 2 %: thinning begins where the stress nears G."""
    for _, curve in curves:
        assert curve[1] / curve[0] == pytest.approx(2.0, rel=0.02)


def test_curves_bend_to_some_hundredths(curves):
    """Hertz pressures of 0.8 and 1.3 GPa: a knee within some per cent of slide, and 0.015 to 0.05 at 10 %."""
    for _, curve in curves:
        assert np.all(np.diff(curve) > 0.0)
        assert curve[-1] < 0.5 * curve[2] * RATIOS[-1] / RATIOS[2]
        assert 0.015 < curve[-1] < 0.05


def test_more_pressure_makes_curves_steeper_and_higher(curves):
    (light, low), (heavy, high) = curves
    assert light.hertz_pressure == pytest.approx(0.80e9, rel=5e-3)
    assert heavy.hertz_pressure == pytest.approx(1.30e9, rel=5e-3)
    assert high[0] > 2.0 * low[0]
    assert high[-1] > low[-1]


def test_a_limiting_stress_is_the_ceiling(curves):
    """With Lambda = 0.05 the coefficient stays below it, and nears it at 200 % slide."""
    solution, _ = curves[1]
    limited = Rheology(limiting_coefficient=0.05)
    forces = [
        integrate_traction(solution, ContactKinematics(entrainment_speed=1.0, sliding_x=ratio), limited).coefficient
        for ratio in (0.01, 0.1, 2.0)
    ]
    assert forces[0] < forces[1] < forces[2] < 0.05 * 1.02
    assert forces[2] > 0.04


def test_heat_of_sliding_makes_a_maximum_and_a_fall():
    """1.3 GPa, Lambda 0.075: cold curves rise on and on; with heat they fall beyond some ten per cent of slide."""
    conditions, limited = contact(LOADS[1]), replace(CARREAU, limiting_coefficient=0.075)
    film = solve_generalized(conditions, Rheology(), solids=(STEEL, STEEL), options=ehl.SolverOptions(points=129))
    assert film.contact.converged
    ratios = np.geomspace(0.003, 1.5, 24)
    none = np.zeros_like(ratios)
    nodes = heated_film(film, (STEEL, STEEL), limited)
    warm = -heated_forces(nodes, (ratios, none, none), none, 0.0)[:, 0] / conditions.load
    motions = [ContactKinematics(entrainment_speed=1.0, sliding_x=ratio) for ratio in ratios]
    cold = [-integrate_traction(film.contact, motion, limited).sliding_force_x / conditions.load for motion in motions]
    assert np.all(np.diff(cold) > 0.0)
    assert warm[0] == pytest.approx(cold[0], rel=0.01)
    largest = int(np.argmax(warm))
    assert 0.2 < ratios[largest] < 1.4
    assert 0.06 < warm[largest] < 0.0735  # of 0.075; 0.0706 since the limit is the smaller of both stresses
    # by 1.7 and 4.7 %: both curves stay nearer to the limit than with the exponential law
    assert warm[-1] < 0.985 * warm[largest]
    assert warm[-1] < 0.96 * cold[-1]
