"""The summary: keys as published, units, null with a reason, never NaN."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.torque.breakdown import TorqueBreakdown
from oilfilm.bearing.torque.integrated import IntegratedTorque, SolvedShear
from oilfilm.bearing.torque.models import summed
from oilfilm.postprocess import summary

BEARING_KEYS = {
    "oilfilm",
    "case",
    "converged",
    "messages",
    "ring",
    "cage_speed_rpm",
    "balls",
    "contacts",
    "life",
    "frequencies_Hz",
    "kinematic_frequencies_Hz",
    "torque_N_mm",
    "timing_s",
}
CONTACT_KEYS = {
    "ball",
    "azimuth_deg",
    "race",
    "loaded",
    "load_N",
    "contact_angle_deg",
    "semi_axis_rolling_mm",
    "semi_axis_transverse_mm",
    "hertz_pressure_GPa",
    "entrainment_speed_m_s",
    "slide_roll_ratio",
    "spin_roll_ratio",
    "hirano_ratio",
    "film_central_um",
    "film_central_uncertainty_um",
    "film_minimum_um",
    "film_minimum_uncertainty_um",
    "pressure_maximum_GPa",
    "traction_coefficient",
    "lambda_ratio",
    "converged",
    "residual",
    "mass_imbalance",
}
SINGLE_KEYS = {
    "load_N",
    "moes_M",
    "moes_L",
    "radius_ratio",
    "hertz_pressure_GPa",
    "film_central_um",
    "film_minimum_um",
    "film_central_uncertainty_um",
    "film_minimum_uncertainty_um",
    "film_central_dimensionless",
    "film_minimum_dimensionless",
    "film_central_uncertainty_dimensionless",
    "film_minimum_uncertainty_dimensionless",
    "approach_dimensionless",
    "pressure_centre_dimensionless",
    "pressure_maximum_GPa",
    "traction_coefficient",
    "resolved",
    "domain",
    "points",
    "residual",
    "mass_imbalance",
    "cycles",
    "fft_equivalents",
    "wall_s",
    "converged",
    "finest_grid",
}


def test_bearing_keys(bearing_results):
    document = summary(bearing_results)
    assert document.keys() >= BEARING_KEYS
    assert all(contact.keys() >= CONTACT_KEYS for contact in document["contacts"])
    assert document["ring"].keys() >= {"displacement_um", "tilt_mrad", "stiffness"}
    assert document["ring"]["stiffness"].keys() == {"order", "matrix", "units"}
    assert (
        np.shape(document["ring"]["stiffness"]["matrix"]) == (5, 5) == np.shape(document["ring"]["stiffness"]["units"])
    )
    assert document["frequencies_Hz"].keys() == document["kinematic_frequencies_Hz"].keys()
    assert document["frequencies_Hz"].keys() == {"cage", "ball_pass_outer", "ball_pass_inner", "ball_spin"}
    assert document["torque_N_mm"].keys() >= {"total", "models"}
    assert len(document["contacts"]) == 18
    assert len(document["balls"]) == 9


def test_numbers_in_named_units(bearing_results):
    """6208 under 3000 N at 10000 rpm, papers.md: Qi 1596.3 N, a 1.7819 and b 0.15645 mm, 2.734 GPa, 15.08 m/s."""
    inner, outer = summary(bearing_results)["contacts"][:2]
    assert_allclose(inner["load_N"], 1596.3, rtol=5e-3)
    assert_allclose(inner["semi_axis_transverse_mm"], 1.7819, rtol=5e-3)
    assert_allclose(inner["semi_axis_rolling_mm"], 0.15645, rtol=5e-3)
    assert_allclose(inner["hertz_pressure_GPa"], 2.734, rtol=5e-3)
    assert_allclose(outer["hertz_pressure_GPa"], 2.543, rtol=5e-3)
    assert_allclose(inner["entrainment_speed_m_s"], 15.08, rtol=5e-3)
    solution = bearing_results.solutions[0]
    assert_allclose(inner["isothermal_film_minimum_um"], solution.film_minimum * 1e6)
    assert_allclose(inner["film_minimum_um"], inner["inlet_heat_share_minimum"] * solution.film_minimum * 1e6)
    assert_allclose(summary(bearing_results)["cage_speed_rpm"], 4000.0, rtol=5e-3)


def test_unloaded_contacts_are_null_and_do_not_count(bearing_results):
    document = summary(bearing_results)
    unloaded = [c for c in document["contacts"] if not c["loaded"]]
    assert {c["race"] for c in unloaded} == {"inner"}
    assert all(c["load_N"] == 0.0 and c["film_central_um"] is None for c in unloaded)
    assert document["converged"]
    assert any("inner race, balls 3–8: film null, unloaded" in m for m in document["messages"])


def test_mass_balance_of_every_contact_with_a_film(bearing_results):
    """That of the film's last cycle; null without a film, and said so."""
    document = summary(bearing_results)
    for contact, film in zip(document["contacts"], bearing_results.solutions, strict=True):
        if film is None:
            assert contact["residual"] is None and contact["mass_imbalance"] is None
        else:
            assert contact["residual"] == film.record.residual[-1]
            assert contact["mass_imbalance"] == film.record.mass_imbalance
    assert any(m.startswith("contacts: residual and mass_imbalance null") for m in document["messages"])


def test_null_has_a_reason(bearing_results, contact_results):
    for results in (bearing_results, contact_results):
        messages = " ".join(summary(results)["messages"])
        assert "traction_coefficient: null" in messages
    messages = " ".join(summary(bearing_results)["messages"])
    assert "life: null" in messages
    assert "torque_N_mm: null" in messages


def test_a_film_not_asked_for_has_its_reason(bearing_results):
    """Balls 1 and 2 solved, the others left out: told ball by ball, unless there was no chance to solve them."""
    some = (*bearing_results.solutions[:4], *[None] * 14)
    partial = replace(bearing_results, solutions=some)
    messages = summary(partial)["messages"]
    assert "inner race, ball 9: film null, not asked for by [ehl] film_maps" in messages
    assert "outer race, balls 3–9: film null, not asked for by [ehl] film_maps" in messages
    lost = replace(bearing_results.quasistatic, converged=False, message="no equilibrium")
    for other in (replace(partial, quasistatic=lost), replace(partial, interrupted=True), bearing_results):
        assert not any("not asked for" in message for message in summary(other)["messages"])


def test_lambda_of_the_formula_stands_beside_that_of_the_film(bearing_results):
    """Film of the formula over the root of the squares of 0.03 and 0.04 um, with films solved or not."""
    surface = {"inner_ring_roughness_um": 0.03, "outer_ring_roughness_um": 0.0, "ball_roughness_um": 0.04}
    found = summary(replace(bearing_results, case={**bearing_results.case, "surface": surface}))["contacts"]
    loaded = [contact for contact in found if contact["film_formulas_um"]["hamrock_dowson_minimum"] is not None]
    assert loaded
    for contact in loaded:
        film, roughness = (
            contact["film_formulas_um"]["hamrock_dowson_minimum"],
            0.05 if contact["race"] == "inner" else 0.04,
        )
        assert contact["lambda_ratio_formula"] == pytest.approx(film / roughness, rel=1e-12)
    assert all(contact["lambda_ratio_formula"] is None for contact in summary(bearing_results)["contacts"])


@pytest.mark.parametrize(("roughness", "races"), [((0.0, 0.1, 0.0), ["inner"]), ((0.0, 0.0, 0.0), ["inner", "outer"])])
def test_no_roughness_no_lambda_ratio(bearing_results, roughness, races):
    names = ("inner_ring_roughness_um", "outer_ring_roughness_um", "ball_roughness_um")
    case = {**bearing_results.case, "surface": dict(zip(names, roughness, strict=True))}
    document = summary(replace(bearing_results, case=case))
    told = [m.split("null at the ")[1].split()[0] for m in document["messages"] if m.startswith("contacts.lambda")]
    assert told == races
    for contact in document["contacts"][:2]:
        assert (contact["lambda_ratio"] is None) == (contact["race"] in races)


def test_a_wide_error_bar_is_told(bearing_results):
    solution = bearing_results.solutions[0]
    film = replace(solution.film_minimum_dimensionless, uncertainty=0.4 * solution.film_minimum_dimensionless.value)
    doubtful = replace(solution, film_minimum_dimensionless=film)
    solutions = (doubtful, *bearing_results.solutions[1:])
    told = [m for m in summary(replace(bearing_results, solutions=solutions))["messages"] if "error bar of" in m]
    assert told == ["inner race, ball 1 (ψ = 0°): error bar of the minimum film is 40% of it; try more points"]
    assert not any("error bar of" in m for m in summary(bearing_results)["messages"])


def test_nan_never_appears(bearing_results):
    state = replace(bearing_results.quasistatic, cage_speed=float("nan"), tilt=np.array([np.inf, 0.0]))
    document = summary(replace(bearing_results, quasistatic=state))
    assert document["cage_speed_rpm"] is None
    assert document["ring"]["tilt_mrad"][0] is None
    assert any(m.startswith("ring.tilt_mrad[0]: null") for m in document["messages"])
    json.dumps(document, allow_nan=False)


def test_balls_that_found_no_balance_do_not_count_as_converged(bearing_results):
    """The torque is then that of another motion, which nobody asked for."""
    parts = {"rolling": 0.01, "sliding": 0.0, "spin": 0.0, "curvature": 0.0}
    torque = IntegratedTorque(**parts, shaft_power=1.0, heat=1.1, per_ball=np.full(9, 0.01 / 9))
    models = {"integrated": summed(parts, "no traction equilibrium found")}
    for balanced in (torque, None):
        shear = SolvedShear(hypothesis=torque, balanced=balanced)
        found = TorqueBreakdown(models=models, coefficient=0.05, shear=shear)
        assert replace(bearing_results, torque=found).converged is (balanced is not None)


def test_failures_are_named(bearing_results):
    bad = replace(bearing_results.solutions[2], converged=False, resolved=False, message="stalled at 1e-3")
    solutions = tuple(bad if s is bearing_results.solutions[2] else s for s in bearing_results.solutions)
    document = summary(replace(bearing_results, solutions=solutions))
    assert not document["converged"]
    assert any("balls 2, 9" in m and "stalled at 1e-3" in m for m in document["messages"])
    thin = replace(bad, converged=True, message="converged but unresolved: too thin")
    solutions = tuple(thin if s is bearing_results.solutions[2] else s for s in bearing_results.solutions)
    document = summary(replace(bearing_results, solutions=solutions))
    assert document["converged"]
    assert any("balls 2, 9" in m and "unresolved" in m for m in document["messages"])


def test_single_contact(contact_results):
    document = summary(contact_results)
    assert document.keys() >= SINGLE_KEYS
    assert document["load_N"] == 15.0
    assert document["pressure_centre_dimensionless"] == pytest.approx(1.0)
    solution = contact_results.solution
    assert document["finest_grid"]["film_central_um"] == pytest.approx(
        solution.film_central_dimensionless.finest * solution.film_scale * 1e6
    )
    json.dumps(document, allow_nan=False)


def test_moes_input_has_no_lengths(moes_results):
    document = summary(moes_results)
    assert document.keys() >= SINGLE_KEYS
    nulls = ("load_N", "film_central_um", "film_minimum_um", "film_central_uncertainty_um")
    assert all(document[key] is None for key in nulls)
    assert document["moes_M"] == 20.0
    assert document["film_central_dimensionless"] > 0.0
    assert document["hertz_pressure_GPa"] > 0.0
    assert any("Moes" in message for message in document["messages"])


def test_formulas_stand_beside_solved_films(bearing_results):
    formulas = summary(bearing_results)["contacts"][0]["film_formulas_um"]
    assert formulas.keys() == {
        "hamrock_dowson_central",
        "hamrock_dowson_minimum",
        "chittenden_central",
        "nijenbanning_central",
    }
    assert all(0.1 < value < 3.0 for value in formulas.values())
