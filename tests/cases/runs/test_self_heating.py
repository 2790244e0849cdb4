"""Self-heating in case files: the balance closes, its inputs count, what it cannot do is told."""

from __future__ import annotations

import re
from math import pi

import numpy as np
import pytest

from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.new_case import FirstOperation, case_of_designation
from oilfilm.cases.runs.bearing import run_case
from oilfilm.cases.runs.heating import self_heated
from oilfilm.postprocess import summary

TEXT = """
schema_version = 1
[bearing]
name = "6208"
basic_static_rating_kN = 19.0
bore_mm = 40.0
outside_diameter_mm = 80.0
width_mm = 18.0
inner_ring_material = "bearing steel"
outer_ring_material = "bearing steel"
ball_material = "bearing steel"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 6000.0
radial_load_N = 2000.0
temperature_C = 40.0
[ehl]
film_maps = "none"
[friction]
heat_transfer_W_K = 1.0
"""


def found(text):
    document = summary(run_case(case_from_text(text, "case.toml")))
    return document["self_heating"], document


@pytest.mark.slow
def test_friction_and_cooling_agree():
    """M w is what shaft and housing give off, h split over them by their seats; the oil is thinner at the balance."""
    warm, document = found(TEXT)
    assert document["converged"]
    assert warm["converged"]
    assert warm["torque_model"] == "integrated"
    assert warm["temperature_C"] > 40.0
    parts, flows = document["temperatures_C"], document["heat_flows_W"]
    given_off = ((parts["shaft"] - 20.0) + 2.0 * (parts["housing"] - 20.0)) / 3.0  # seats of 40 and 80 mm
    assert warm["power_W"] == pytest.approx(given_off, rel=1e-9)
    assert warm["power_W"] == pytest.approx(flows["shaft-ambient"] + flows["housing-ambient"], rel=1e-9)
    assert warm["power_W"] == pytest.approx(sum(document["heat_sources_W"].values()), rel=1e-9)
    assert document["energy_error"] < 1e-9
    assert document["runaway_margin"] > 1.0
    films = 0.5 * parts["balls"] + 0.25 * parts["inner_ring"]
    outer = 4.0 * (warm["temperature_C"] - films)  # the film temperature is right to 1e-4 K
    assert parts["outer_ring_unloaded"] < outer < parts["outer_ring_loaded"] + 4e-4
    assert all(c["contact_conductance_W_K"] > 0.0 for c in document["contacts"] if c["loaded"])
    assert warm["power_W"] == pytest.approx(1e-3 * warm["torque_N_mm"] * 6000.0 * pi / 30.0, rel=1e-9)
    assert warm["oil_W"] == 0.0
    assert warm["torque_N_mm"] < document["torque_N_mm"]["total"]
    assert warm["clearance_um"] == pytest.approx(document["clearance"]["operating_um"])
    assert any("agree at" in message for message in document["messages"])
    at_it, again = found(TEXT.replace("temperature_C = 40.0", f"temperature_C = {warm['temperature_C']!r}"))
    assert again["torque_N_mm"]["total"] == pytest.approx(warm["torque_N_mm"], rel=1e-5)
    assert at_it["temperature_C"] == pytest.approx(warm["temperature_C"], abs=1e-3)


@pytest.mark.slow
def test_oil_carries_heat_away():
    warm, _ = found(TEXT)
    cooled, document = found(TEXT + "cooling_oil_mL_min = 200.0\ncooling_oil_C = 30.0\n")
    assert cooled["temperature_C"] < warm["temperature_C"] - 1.0
    assert cooled["oil_W"] > 1.0
    flows = document["heat_flows_W"]
    assert cooled["oil_W"] == pytest.approx(flows["oil-oil_supply"])
    heat = cooled["oil_W"] + flows["shaft-ambient"] + flows["housing-ambient"]
    assert heat == pytest.approx(cooled["power_W"], abs=1e-3)


@pytest.mark.slow
def test_fits_and_rings_of_different_temperature_take_clearance_as_it_warms():
    rings = "[temperatures]\ninner_ring_C = 60.0\nouter_ring_C = 50.0\nball_C = 55.0\n"
    warm, document = found(TEXT + rings + "[fit]\ninner_ring_interference_um = 5.0\n")
    assert warm["converged"]
    assert warm["clearance_um"] < 13.0
    assert warm["clearance_um"] != pytest.approx(document["clearance"]["operating_um"], abs=1e-6)


@pytest.mark.parametrize("model", ["skf", "palmgren", "houpert", "pure_rolling_lines", "coulomb"])
def test_other_models_heat_the_bearing(model):
    warm, _ = found(TEXT + f'heating_torque = "{model}"\npalmgren_load_factor = 0.0005\n')
    assert warm["converged"]
    assert warm["torque_model"] == model
    assert warm["temperature_C"] > 20.0


def test_a_model_without_its_inputs_has_no_balance_and_says_so():
    warm, document = found(TEXT + 'heating_torque = "yao"\n')
    assert not document["converged"]
    assert warm["temperature_C"] is None
    assert any("oil_fraction" in m and m.startswith("self_heating: null") for m in document["messages"])


def test_without_the_key_the_block_is_null():
    warm, document = found(TEXT.replace("heat_transfer_W_K = 1.0", ""))
    assert set(warm.values()) == {None}
    assert document["converged"]
    assert any(message.startswith("self_heating: null") for message in document["messages"])


def test_one_viscosity_follows_the_temperature_by_the_index_of_its_base_oil():
    """Not further from the balance of the library's oil than its index, 79, from that assumed, 95."""
    warm, document = found(
        TEXT.replace('name = "iso vg 32"', "viscosity_mPa_s = 27.6\npressure_viscosity_1_GPa = 25.0")
    )
    own, _ = found(TEXT)
    assert document["converged"]
    assert warm["temperature_C"] == pytest.approx(own["temperature_C"], abs=3.0)
    assert any("viscosity_index = 95 (30 to 130)" in message for message in document["messages"])


@pytest.mark.parametrize(
    ("key", "speed"),
    [("heat_transfer_W_K", 9000.0), pytest.param("cooling_oil_mL_min", 24000.0, marks=pytest.mark.slow)],
)
def test_what_is_advised_where_there_is_no_balance_gives_one(key, speed):
    """A 6220 in a bath; a tenth more cooling than the advice names as the least. At 24000 r/min no transfer from
    shaft and housing is enough, for the heat does not get so far, and none is advised."""
    text = case_of_designation("6220", FirstOperation()).replace('film_maps = "all"', 'film_maps = "none"')
    text = re.sub(r"inner_speed_rpm = .*", f"inner_speed_rpm = {speed}", text)
    found = summary(run_case(case_from_text(text, "hot")))
    assert found["self_heating"]["converged"] is False
    advice = next(message for message in found["messages"] if message.startswith("self_heating: null"))
    assert ("heat_transfer_W_K above" in advice) is (speed < 24000.0)
    least = float(re.search(rf"{key} above ([\d.e+]+)", advice).group(1))
    text = re.sub(r"heat_transfer_W_K = .*\n", "", text) if key == "heat_transfer_W_K" else text
    text = text.replace("[friction]\n", f"[friction]\n{key} = {1.1 * least}\n")
    heating = summary(run_case(case_from_text(text, "cooled")))["self_heating"]
    assert heating["converged"] is True
    assert 100.0 < heating["temperature_C"] < 150.0


def test_seals_that_leave_no_balance_leave_the_temperature_that_the_case_gives():
    """Films alone find a balance at 81 C, which contact seals do not let stand: nothing claims it."""
    text = case_of_designation("6001-2RSH", FirstOperation(speed=20e3, radial_load=60.0))
    found = summary(run_case(case_from_text(text.replace('film_maps = "all"', 'film_maps = "none"'), "case.toml")))
    assert not found["converged"]
    assert found["case"]["operation"]["temperature_C"] == 70.0
    messages = found["messages"]
    assert not any("and cooling agree" in message for message in messages)
    assert any(message.startswith("operation.temperature: not self-heated, no balance") for message in messages)
    assert any(message.startswith("self_heating: null, not converged: no balance") for message in messages)


HEATED = """
schema_version = 1
bearing = {{name = "{name}"}}
lubricant = {{name = "{oil}"}}
ehl = {{film_maps = "none"}}
[operation]
inner_speed_rpm = {speed}
axial_load_N = {axial}
radial_load_N = {radial}
temperature_C = {start}
temperature = "self-heated"
[friction]
heat_transfer_W_K = {conductance}
ambient_C = {ambient}
"""
LIGHT = {
    "name": "7014C",
    "oil": "iso vg 68",
    "speed": 9000.0,
    "axial": 300.0,
    "radial": 0.0,
    "conductance": 4.0,
    "ambient": 20.0,
}


@pytest.mark.parametrize("start", [20.0, 60.0, 90.0])
def test_temperatures_do_not_go_by_the_oil_that_the_search_begins_with(start):
    """Up to some 70 C so thick an oil lets the races drive no ball of this light bearing."""
    warm, document = found(HEATED.format(**LIGHT, start=start))
    assert document["converged"] and warm["converged"]
    assert warm["temperature_C"] == pytest.approx(108.146, abs=0.01)


def test_a_temperature_foreseen_is_that_of_a_balance_looked_at():
    """The search of a run ends where its last three states lead, the other one in a state: 1e-4 K each, at most."""
    rng = np.random.default_rng(20261129)
    for name in ("7012AC", "6208", "7014C", "6310"):
        axial, speed, start = rng.uniform((800.0, 3000.0, 20.0), (3000.0, 9000.0, 90.0))
        given = LIGHT | {"name": name, "axial": axial, "speed": speed}
        text = HEATED.format(**given, start=start)
        case = case_from_text(text, "case.toml")
        foreseen, looked_at = self_heated(case, judged=False).balance, self_heated(case).balance
        assert foreseen.converged and looked_at.converged
        assert foreseen.temperature == pytest.approx(looked_at.temperature, abs=1.5e-4)
        assert foreseen.evaluations < looked_at.evaluations


FALLING_AND_RISING = {  # friction over the temperature on the way to the balance
    "6208": ("iso vg 32", 5763.306, 146.6667, 560.2097, 110.0, 28.534137, -30.0),
    "6208 thicker": ("iso vg 68", 4951.403, 138.875, 1065.887, 120.0, 10.29826, -10.0),
}
NAMES = ("oil", "speed", "axial", "radial", "start", "conductance", "ambient")


@pytest.mark.slow
@pytest.mark.parametrize("which", ["6208", "6208 thicker"])
def test_a_bearing_in_the_cold_finds_its_balance(which):
    """From a hot start and, to the same temperature, from near the balance."""
    given = dict(zip(NAMES, FALLING_AND_RISING[which], strict=True)) | {"name": which.split()[0]}
    warm = self_heated(case_from_text(HEATED.format(**given), "case.toml"))
    assert warm.converged
    temperature = warm.balance.temperature
    assert temperature == pytest.approx(
        self_heated(case_from_text(HEATED.format(**given), "case.toml"), judged=False).balance.temperature, abs=1.5e-4
    )
    given["start"] = temperature - 273.15 + 2.0
    again = self_heated(case_from_text(HEATED.format(**given), "case.toml"))
    assert again.balance.temperature == pytest.approx(temperature, abs=3e-4)
