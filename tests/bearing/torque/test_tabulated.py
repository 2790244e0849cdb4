"""Torque from friction laws: Coulomb's law of the tables' interface against the balance over the ellipse."""

from __future__ import annotations

from math import pi
from types import SimpleNamespace

import numpy as np
import pytest

from oilfilm.bearing import Operation, Race, contact_conditions, reduced_radii, solve_quasistatic
from oilfilm.bearing.contacts.motion import bearing_kinematics
from oilfilm.bearing.friction.coulomb import balanced_friction
from oilfilm.bearing.friction.friction_sources import LawTraction
from oilfilm.bearing.friction.tables import contact_law, law_gradient
from oilfilm.bearing.geometry import contact_modulus
from oilfilm.bearing.torque.breakdown import friction_torque
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.bearing.torque.integrated import law_torque
from oilfilm.ehl import Lubricant
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb
from oilfilm.ehl.traction.shear import ContactShape, EllipseLaw
from oilfilm.ehl.traction_table.table import TableContact, TableError, TableRange, TractionTable, load_coordinate

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
        laws[race] = EllipseLaw(shape, RampedCoulomb(friction=MU, slide_full=ramp))
    return laws


def tabulated_torque(state, contacts, laws):
    return law_torque(state, contacts, LawTraction(laws=laws).at(state, contacts))


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
    assert found.torque.total == pytest.approx(ellipse.power.sum() / state.operation.shaft_speed, rel=0.01)
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
    torque = friction_torque(state, contacts, OIL, FrictionInput(coefficient=MU), shear=shear)
    assert torque.chosen == "integrated"
    assert torque.total == pytest.approx(shear.torque.total)
    assert torque.models["coulomb"].total == pytest.approx(torque.total, rel=0.01)


def test_what_a_law_does_not_tell_apart_is_none_with_a_reason(axial):
    """A table's rolling holds the curvature slip; Coulomb's law has the slip alone; neither has asperities."""
    state, contacts = axial
    rng = np.random.default_rng(48161)
    rough = FrictionInput(coefficient=MU, roughness=(0.1e-6, 0.1e-6), all_models=True)
    laws = {"curvature": {race: random_table(rng) for race in Race}, "rolling": coulomb_laws(state, contacts, 1e-3)}
    for missing, law in laws.items():
        shear = tabulated_torque(state, contacts, law)
        parts = shear.torque.contacts
        assert set(shear.missing_components) == {missing, "asperity", "hysteresis"}
        assert set(parts) == {"rolling", "sliding", "spin", "curvature"} - {missing}
        assert sum(parts.values()) == pytest.approx(shear.torque.heat / state.operation.shaft_speed, rel=1e-12)
        models = friction_torque(state, contacts, OIL, rough, shear=shear).models
        assert not set(shear.missing_components) & set(models["integrated"].components)
        assert models["skf_lambda"].total is None
        assert models["skf_lambda"].note == shear.missing_components["asperity"]


def random_table(rng):
    """A table of random spline coefficients: no oil, but a smooth law."""
    body = TableContact(
        radius_x=5e-3, radius_y=0.12, reduced_modulus=2.2e11, lubricant=OIL, rheology=Rheology(), temperature=313.0,
        curvature_radius=6e-3, curvature_difference=-160.0,
    )  # fmt: skip
    limits = TableRange(load=(1.0, 1000.0), speed=(0.5, 20.0))
    nodes = (4, 4, 7, 5, 6)
    starts = (load_coordinate(1.0), np.log(0.5), -1.0, 0.0, -1.0)
    ends = (load_coordinate(1000.0), np.log(20.0), 1.0, 1.0, 1.0)
    axes = np.array([[a, (n - 1) / (b - a), n] for a, b, n in zip(starts, ends, nodes, strict=True)])
    scalars = rng.normal(scale=0.1, size=(6, 6, 10)) + np.log([0.01, 0.01, 0.1, 5e-7, 1e-4, 1e8, 1e3, 5.0, 1e-3, 1e-3])
    error = TableError(
        largest=0.0, quantile=0.0, rms=0.0, largest_spin=0.0, largest_rolling=0.0, films=0, motions=0, tolerance=0.0
    )
    return TractionTable(
        contact=body, range=limits, points=65, axes=axes, scalars=scalars,
        values=rng.normal(size=(*(n + 2 for n in nodes), 4)), kappa_max=0.05, error=error, films=16, converged=True,
        message="random",
    )  # fmt: skip


@pytest.mark.parametrize("kind", ["table", "coulomb", "four constants", "other"])
def test_compiled_friction_of_many_contacts_is_that_of_each_law(axial, kind):
    """Kernel against its twin, forces and slopes to round-off; a law the kernels do not know goes one by one."""
    state, contacts = axial
    rng = np.random.default_rng(30917)
    if kind == "table":
        by_race = {race: random_table(rng) for race in Race}
    else:
        by_race = coulomb_laws(state, contacts, 1e-3)
        if kind == "four constants":
            by_race = {
                race: EllipseLaw(law.shape, FourConstants(-0.03, 3.6, 46.0, 0.03)) for race, law in by_race.items()
            }
    laws = [by_race[contact.race] for contact in contacts]
    if kind == "other":
        laws = [SimpleNamespace(forces=law.forces) for law in laws]
    numbers = np.array([0, 3, 4, 17, 8])
    motion = rng.normal(size=(numbers.size, 4)) * [0.05, 0.05, 50.0, 500.0]
    found = contact_law(contacts, laws).evaluate(motion, numbers)
    for row, number in enumerate(numbers):
        c = contacts[number].conditions
        gradient, slope = law_gradient(laws[number], np.array([c.load, c.entrainment_speed, c.radius_x]), motion[row])
        assert np.abs(gradient[:2]).max() > 0.0
        np.testing.assert_allclose(found.gradient[row], gradient, rtol=1e-12)
        np.testing.assert_allclose(found.curvature[row], slope, rtol=1e-6, atol=1e-9 * np.abs(slope).max())


def test_slopes_are_derivatives(axial):
    """Forward quotients of 1e-5 of the speed against central ones of a hundredth more, to what curvature leaves."""
    state, contacts = axial
    laws = coulomb_laws(state, contacts, 0.5)  # a ramp wide enough to be smooth
    law = contact_law(contacts, [laws[contact.race] for contact in contacts])
    motion, numbers = np.array([[0.02, 0.01, 30.0, 400.0]]), np.array([2])
    slope = law.evaluate(motion, numbers).curvature[0]
    for j, step in enumerate((1e-5, 1e-5, 1e-2)):
        ends = []
        for sign in (1.0, -1.0):
            moved = motion.copy()
            moved[0, j] += sign * step
            ends.append(law.evaluate(moved, numbers).gradient[0])
        np.testing.assert_allclose(
            slope[:, j], (ends[0] - ends[1]) / (2.0 * step), rtol=1e-3, atol=1e-4 * abs(slope[j, j])
        )
