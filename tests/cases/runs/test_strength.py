"""Strength in the summary: rings of the warm ceramic bearing, tension under its films, what steel leaves null."""

from __future__ import annotations

from dataclasses import replace

import pytest

from oilfilm.bearing import load_material
from oilfilm.cases import load_case, run_case
from oilfilm.cases.format.case import case_from_text
from oilfilm.postprocess import summary
from oilfilm.postprocess.bearing.plots import write_bearing_plots
from oilfilm.postprocess.bearing.summary import strength_messages, strength_rows

STEEL = """\
schema_version = 1
[bearing]
name = "6208"
[lubricant]
viscosity_mPa_s = 26.1
pressure_viscosity_1_GPa = 18.0
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 3000.0
[fit]
inner_ring_interference_um = 20.0
[ehl]
film_maps = "none"
"""


@pytest.fixture(scope="module")
def warm():
    return run_case(load_case("6208_full_ceramic_warm"))


def test_rings_of_the_warm_ceramic_bearing(warm):
    found = summary(warm)
    ring = found["strength"]["inner_ring"]
    assert ring["hoop_tension_MPa"] == pytest.approx(ring["hoop_by_fit_MPa"] + ring["hoop_by_rotation_MPa"])
    assert ring["seat_pressure_MPa"] == pytest.approx(found["clearance"]["inner_pressure_MPa"])
    assert ring["strength_share"] == pytest.approx(ring["hoop_tension_MPa"] / ring["bending_strength_MPa"])
    ends = [ring[f"failure_probability{end}"] for end in ("_low", "", "_high")]
    assert ends == sorted(ends) and ends[0] > 0.0
    assert found["strength"]["outer_ring"]["hoop_tension_MPa"] == 0.0
    for way in ("warm", "cold"):
        allowed = [ring[f"allowed_{way}_track{end}_K"] for end in ("_low", "", "_high")]
        assert allowed == sorted(allowed) and allowed[0] > 300.0
    power = found["torque_N_mm"]["total"] * 1e-3 * 10000.0 * 3.14159 / 30.0
    assert 0.05 < ring["friction_gradient_K"] / power < 0.5
    assert " K colder than its seat (least strength)" in strength_rows(warm)["inner ring"]
    assert ring["friction_tension_MPa"] < 0.5 * 1.02 * ring["friction_gradient_K"]  # E alpha 1.02 MPa/K
    told = [message for message in found["messages"] if message.startswith("strength: ")]
    assert any("no standard rates ceramic rings" in message for message in told)
    assert sum("Weibull modulus of silicon nitride is assumed" in message for message in told) == 1
    assert not any("beyond 20%" in message for message in told)


def test_a_cold_medium_names_rings_that_may_crack(warm):
    """Alumina from 20 C to 77 K contracts by 0.78 per mille: 375 MPa, beyond its least strength of 250."""
    cold = replace(warm.quasistatic, operation=replace(warm.quasistatic.operation, temperature=77.15))

    def told(name):
        rings = tuple(replace(ring, material=load_material(name)) for ring in warm.strength.rings)
        results = replace(warm, quasistatic=cold, strength=replace(warm.strength, rings=rings))
        return [message for message in strength_messages(results) if "may crack" in message]

    assert told("silicon nitride") == []
    assert len(told("alumina")) == 1 and "375 MPa" in told("alumina")[0]


def test_map_over_temperature_and_speed(warm):
    """13 temperatures from that of measurement, 4 speeds from rest."""
    found = summary(warm)["strength"]["inner_ring_map"]
    assert (found["temperature_C"][0], found["inner_speed_rpm"][0]) == (20.0, 0.0)
    shape = (len(found["temperature_C"]), len(found["inner_speed_rpm"]))
    for key in ("hoop_tension_MPa", "failure_probability", "failure_probability_low", "failure_probability_high"):
        assert (len(found[key]), len(found[key][0])) == shape == (13, 4)
    # cold and at rest the ring is loose
    assert found["hoop_tension_MPa"][0][0] == 0.0
    assert found["hoop_tension_MPa"][-1][-1] > found["hoop_tension_MPa"][-1][0]


def test_tension_under_the_films(warm):
    """At the heaviest ball; with the hoop tension of the groove in the inner ring, which pulls along the rolling
    direction and makes its tension larger than the ball's; by less than itself, since friction pulls at the ring where
    it presses on the ball.
    """
    found = summary(warm)
    inner, outer, other = found["contacts"][:3]
    for contact in (inner, outer):
        assert 0.05 < contact["surface_tension_ring_GPa"] / contact["hertz_pressure_GPa"] < 0.2
        assert contact["surface_tension_uncertainty_GPa"] < contact["surface_tension_ring_GPa"]
    groove = 1e-3 * found["strength"]["inner_ring"]["groove_tension_MPa"]
    difference = inner["surface_tension_ring_GPa"] - inner["surface_tension_ball_GPa"]
    assert 0.0 < difference < groove
    assert other["surface_tension_ring_GPa"] is None
    assert other["edge_tension_GPa"] < inner["edge_tension_GPa"]
    # film pressure and hoop tension change the largest shear by a few per cent, its eighth power by tenths
    assert 0.6 < outer["fatigue_damage_over_dry"] < inner["fatigue_damage_over_dry"] < 1.5
    largest = found["strength"]["inner_ring"]["surface_tension_maximum_GPa"]
    assert largest == inner["surface_tension_ring_GPa"]


def test_picture(warm, tmp_path):
    assert write_bearing_plots(warm, tmp_path) == ()
    assert (tmp_path / "plots" / "ring_strength.png").is_file()


def test_a_tight_hot_ring_is_told():
    text = load_text("6208_full_ceramic_warm").replace("= -5.0 #", "= 30.0 #").replace("[0.0] #", '"none" #')
    found = summary(run_case(case_from_text(text, "case.toml")))
    share = found["strength"]["inner_ring"]["strength_share"]
    told = next(message for message in found["messages"] if "beyond 20%" in message)
    assert f"{share:.0%} of the bending strength of silicon nitride" in told
    assert any("they need a film" in message for message in found["messages"])


def load_text(stem):
    from oilfilm.cases.format.shipped import shipped_cases

    return shipped_cases()[stem].read_text(encoding="utf-8")


def test_a_ceramic_ring_without_a_fit_is_told_as_loose():
    """Its probability of failure is that of the rotation alone; steel rings have none that could mislead."""
    ceramic = STEEL.replace('"6208"', '"6208 full ceramic"\nwidth_mm = 18.0').replace("3000.0", "1000.0")
    loose = ceramic.replace("[fit]\ninner_ring_interference_um = 20.0\n", "")
    for text, told in ((loose, 1), (ceramic, 0), (STEEL.replace("[fit]\ninner_ring_interference_um = 20.0\n", ""), 0)):
        messages = summary(run_case(case_from_text(text, "case.toml")))["messages"]
        assert sum("are taken as loose on shaft and in housing" in message for message in messages) == told


def test_own_strength_of_a_material():
    """A strength beyond the library's range has no range; one within keeps it."""
    own = '[materials."silicon nitride"]\nyoungs_modulus_GPa = 310.0\npoisson_ratio = 0.26\ndensity_kg_m3 = 3250.0\n'
    text = load_text("6208_full_ceramic_warm").replace("[0.0] #", '"none" #') + own
    weak = case_from_text(text + "bending_strength_MPa = 400.0\n", "case.toml").bearing.inner_ring_material
    assert (weak.bending_strength, weak.bending_strength_range) == (400e6, None)
    assert weak.weibull_modulus_range == (8.0, 19.0)
    near = case_from_text(text + "bending_strength_MPa = 900.0\n", "case.toml")
    library = load_material("silicon nitride", near.operation.temperature)
    assert near.bearing.inner_ring_material.bending_strength_range == library.bending_strength_range


def test_steel_rings_have_a_hoop_tension_and_no_probability():
    found = summary(run_case(case_from_text(STEEL, "case.toml")))
    ring = found["strength"]["inner_ring"]
    assert ring["hoop_tension_MPa"] > 50.0
    assert [ring[key] for key in ("bending_strength_MPa", "failure_probability", "strength_share")] == [None] * 3
    assert found["strength"]["inner_ring_map"] is None
    assert any("failure probabilities null" in message for message in found["messages"])
