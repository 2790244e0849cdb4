"""Traction curves of squalane: shape, limiting value and order of measured ones; no measured curve was at hand.

Viscosity and density at 298 K: Tait and Doolittle with the constants of Liu, Long, Li and Guo (2023), Table 1. Shear
thinning: Carreau with n = 0.463 and G = 6.94 MPa, quoted from memory after Bair (2006), unverified. Without a bound on
the stress that law gives 0.23 at 10 % slide and 1 GPa, isothermal, which no oil does; the limiting stress 0.05 p is
assumed, within the 0.035 to 0.088 of the oils in Arana et al. (2019). What measured curves of smooth contacts have in
common (Bjorling et al., 2013; Jacod, Venner and Lugt, 2001; both by their abstracts): a linear rise, a maximum or
plateau of some hundredths, the higher the pressure the steeper and the higher.
"""

from __future__ import annotations

import numpy as np
import pytest

import ehl
from bearing import library_lubricant
from ehl.rheology import Rheology, ShearLaw
from ehl.traction import ContactKinematics, integrate_traction

CARREAU = Rheology(
    law=ShearLaw.CARREAU_YASUDA, carreau_modulus=6.94e6, carreau_exponent=0.463, limiting_coefficient=0.05
)
RATIOS = np.array([1e-8, 2e-8, 0.003, 0.01, 0.03, 0.1])


@pytest.fixture(scope="module")
def curves():
    """Coefficient over slide-roll ratio for two loads on a ball of 9.5 mm, rolling at 1 m/s."""
    laws = {"viscosity_law": ehl.ViscosityLaw.TAIT_DOOLITTLE, "density_law": ehl.DensityLaw.TAIT}
    oil = library_lubricant("squalane", 298.15, **laws)
    found = []
    for load in (20.0, 80.0):
        contact = ehl.ContactConditions(
            load=load,
            radius_x=9.5e-3,
            radius_y=9.5e-3,
            reduced_modulus=226e9,
            entrainment_speed=1.0,
            lubricant=oil,
        )
        solution = ehl.solve_contact(contact, ehl.SolverOptions(points=129))
        assert solution.converged
        motions = [ContactKinematics(entrainment_speed=1.0, sliding_x=ratio) for ratio in RATIOS]
        forces = [integrate_traction(solution, motion, CARREAU).sliding_force_x for motion in motions]
        found.append((solution, -np.array(forces) / load))
    return found


def test_small_slides_shear_a_newtonian_oil(curves):
    """Twice the slide, twice the traction; 2 %: thinning begins where the stress nears G."""
    for _, curve in curves:
        assert curve[1] / curve[0] == pytest.approx(2.0, rel=0.02)


def test_curves_bend_to_some_hundredths(curves):
    """Largest pressures of 0.6 and 1 GPa: a knee within some per cent of slide, and 0.015 to 0.05 at 10 %."""
    for _, curve in curves:
        assert np.all(np.diff(curve) > 0.0)
        assert curve[-1] < 0.5 * curve[2] * RATIOS[-1] / RATIOS[2]
        assert 0.015 < curve[-1] < 0.05


def test_more_pressure_makes_curves_steeper_and_higher(curves):
    (light, low), (heavy, high) = curves
    assert heavy.hertz_pressure > 1.5 * light.hertz_pressure
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
