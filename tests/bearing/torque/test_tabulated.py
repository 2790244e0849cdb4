"""Torque from friction laws: Coulomb's law of the tables' interface against the balance over the ellipse."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from bearing import Operation, Race, contact_conditions, reduced_radii, solve_quasistatic
from bearing.geometry import contact_modulus
from bearing.torque.breakdown import torque_breakdown
from bearing.torque.coulomb import balanced_friction
from bearing.torque.models import FrictionInput
from bearing.torque.sliding import shaft_speed
from bearing.torque.tabulated import tabulated_torque
from bearing.traction_forces import bearing_kinematics
from ehl import Lubricant
from ehl.hertz import hertz_contact
from ehl.traction import ContactShape, CoulombLaw

OIL = Lubricant(viscosity=0.0174, pressure_viscosity=18e-9)
MU = 0.08


def coulomb_laws(state, contacts, ramp):
    """Coulomb's law of both races, with the shapes of the contacts of ball 1."""
    laws = {}
    for race in Race:
        contact = next(c for c in contacts if c.race is race and c.hertz is not None)
        motion = bearing_kinematics(state, contact)
        radii = reduced_radii(state.bearing, race, contact.contact_angle)
        unit = hertz_contact(1.0, *radii, contact_modulus(state.bearing, race))
        shape = ContactShape(
            semi_axis_x=unit.semi_axis_x,
            semi_axis_y=unit.semi_axis_y,
            radius_x=radii[0],
            curvature_radius=motion.curvature_radius,
            curvature_difference=motion.curvature_difference,
        )
        laws[race] = CoulombLaw(shape=shape, friction=MU, slide_full=ramp)
    return laws


@pytest.fixture(scope="module")
def axial(bearings):
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=100.0 * pi, force=(800.0, 0.0, 0.0)))
    return state, contact_conditions(state, OIL)


def test_coulomb_as_a_law_of_the_tables_is_coulomb_over_the_ellipse(axial):
    """Two quadratures and two ways to round the law at no sliding: 1 % apart; energy closed to 1e-6."""
    state, contacts = axial
    found = tabulated_torque(state, contacts, coulomb_laws(state, contacts, 1e-4))
    ellipse = balanced_friction(state, contacts, MU)
    assert found.balanced is not None
    assert found.torque.total == pytest.approx(ellipse.power.sum() / shaft_speed(state), rel=0.01)
    assert found.torque.imbalance == pytest.approx(0.0, abs=1e-6)
    assert abs(found.hypothesis.imbalance) > 0.01
    assert found.torque.per_ball.sum() == pytest.approx(found.torque.total, rel=1e-12)
    assert np.ptp(found.torque.per_ball) < 1e-6 * found.torque.total


def test_a_law_that_is_too_sharp_for_the_search_is_told(bearings):
    """Coulomb's without a potential under radial load: no balance is claimed where there is none."""
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=500.0, force=(0.0, 3000.0, 0.0)))
    contacts = contact_conditions(state, OIL)
    found = tabulated_torque(state, contacts, coulomb_laws(state, contacts, 1e-9))
    if found.balanced is None:
        assert "no traction equilibrium" in found.note
    else:
        assert found.balanced.imbalance == pytest.approx(0.0, abs=1e-6)


def test_a_table_makes_the_integrated_model(axial):
    state, contacts = axial
    shear = tabulated_torque(state, contacts, coulomb_laws(state, contacts, 1e-4))
    torque = torque_breakdown(state, contacts, OIL, FrictionInput(coefficient=MU), shear=shear)
    assert torque.chosen == "integrated"
    assert torque.total == pytest.approx(shear.torque.total)
    assert torque.models["coulomb"].total == pytest.approx(torque.total, rel=0.01)
