"""Type of a bearing against its clearance, models beyond their range, one temperature of a summary."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from oilfilm.bearing.geometry import BearingType
from oilfilm.cases import run_case
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.runs.heating import with_temperature
from oilfilm.postprocess import summary

CASE = """
schema_version = 1
[bearing]
name = "6205"
[lubricant]
name = "VG68"
contamination_factor = 0.5
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 700.0
temperature_C = 70.0
[ehl]
film_maps = "none"
"""
HEATED = "[friction]\nheat_transfer_W_K = 1.2\nambient_C = 25.0\n"
GEOMETRY = """\
ball_diameter_mm = 7.94
pitch_diameter_mm = 39.0
balls = 9
inner_groove_radius_mm = 4.09
outer_groove_radius_mm = 4.17
ring_material = "bearing steel"
ball_material = "bearing steel"
"""


def case(text):
    return case_from_text(text, "case.toml")


def found(text):
    return summary(run_case(case(text)))


def test_no_clearance_makes_a_deep_groove_bearing_one_of_angular_contact():
    """C5 gives the 6205 a free contact angle above 20 degrees; SKF and Palmgren keep their constants."""
    wide = case(CASE.replace('"6205"', '"6205 C5"'))
    assert wide.bearing.free_contact_angle > 0.3
    assert wide.bearing.type is BearingType.DEEP_GROOVE
    assert not wide.bearing.angular_contact
    tight, loose = (found(CASE.replace('"6205"', f'"6205 {name}"')) for name in ("C2", "C5"))
    for model in ("skf", "palmgren"):
        one, other = (s["torque_N_mm"]["models"][model]["total"] for s in (tight, loose))
        assert one == pytest.approx(other, rel=1e-6)


def test_the_type_of_a_bearing_without_a_name_follows_its_angle_and_a_clearance_is_told():
    text = CASE.replace('name = "6205"\n', GEOMETRY + "{}\n")
    small = case(text.format("diametral_clearance_um = 10.0"))
    assert small.bearing.type is BearingType.DEEP_GROOVE
    by_angle = case(text.format("free_contact_angle_deg = 25.0"))
    assert by_angle.bearing.type is BearingType.ANGULAR_CONTACT
    assert not any("bearing.type" in note for note in by_angle.warnings)
    by_clearance = case(text.format("diametral_clearance_um = 40.0"))
    assert by_clearance.bearing.type is BearingType.ANGULAR_CONTACT
    assert any("bearing.type is not given" in note for note in by_clearance.warnings)
    given = case(text.format('diametral_clearance_um = 40.0\ntype = "deep groove"'))
    assert given.bearing.type is BearingType.DEEP_GROOVE
    assert replace(given.bearing, type=None).angular_contact


def test_ratings_computed_for_life_serve_the_friction_models():
    sized = CASE.replace('name = "6205"\n', GEOMETRY + "bore_mm = 25.0\noutside_diameter_mm = 52.0\n")
    sized = sized.replace("balls = 9\n", "balls = 9\ndiametral_clearance_um = 12.0\n")
    both = found(sized.replace("radial_load_N = 700.0", "radial_load_N = 700.0\naxial_load_N = 200.0"))
    models = both["torque_N_mm"]["models"]
    rated = found(CASE.replace("radial_load_N = 700.0", "radial_load_N = 700.0\naxial_load_N = 200.0"))
    for model in ("skf", "palmgren"):
        assert models[model]["total"] == pytest.approx(rated["torque_N_mm"]["models"][model]["total"], rel=0.02)
        assert any(model in message and "computed from the geometry" in message for message in both["messages"])
    assert any("'62', nearest by the dimensions" in message for message in both["messages"])


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("3000.0", "46800.0", "n d_m = 1.8 million mm/min is beyond the 1 million"),
        ("temperature_C = 70.0", "temperature_C = -20.0", "a viscosity of"),
        ("700.0", "70.0", "the load of 0.005 C is below the 0.01 C"),
        ('"6205"', '"6205 hybrid"', "the model is for steel"),
    ],
)
def test_a_model_says_where_it_is_beyond_its_range(old, new, expected):
    messages = found(CASE.replace(old, new))["messages"]
    assert any(message.startswith(f"torque_N_mm.models.skf: {expected}") for message in messages), messages
    assert not any("torque_N_mm.models.skf" in message for message in found(CASE)["messages"])


@pytest.mark.slow
def test_the_first_warning_says_that_there_are_two_temperatures():
    result = found(CASE + HEATED)
    first = result["warnings"][0]
    assert first in result["messages"]
    assert first.startswith("two temperatures: loads, clearance, films, torque and life are those of")


@pytest.mark.slow
def test_a_case_can_be_computed_at_the_temperature_of_its_balance():
    own = CASE.replace("temperature_C = 70.0", 'temperature_C = 70.0\ntemperature = "self-heated"')
    result = found(own + HEATED)
    assert result["messages"][0].startswith("operation.temperature: computed at")
    balanced = result["self_heating"]["temperature_C"]
    assert result["case"]["operation"]["temperature_C"] == pytest.approx(balanced, abs=0.01)
    warm = result["self_heating"]
    assert warm["torque_model"] == result["torque_N_mm"]["model"] == "integrated"
    assert result["torque_N_mm"]["total"] == warm["torque_N_mm"]
    flows, parts = result["heat_flows_W"], result["temperatures_C"]
    assert warm["power_W"] == pytest.approx(flows["shaft-ambient"] + flows["housing-ambient"], rel=1e-9)
    # films of the search and of the run are behind the same layers: one balance
    outer = 0.25 * parts["outer_ring_unloaded"], 0.25 * parts["outer_ring_loaded"]
    films = 0.5 * parts["balls"] + 0.25 * parts["inner_ring"]
    assert films + outer[0] - 0.01 < balanced < films + outer[1] + 0.01


def test_films_are_solved_at_the_temperature_that_their_own_torque_asks_for():
    """The total of solved films is the torque that heats: within 0.1 K, and films, clearance and life are of it."""
    own = CASE.replace("temperature_C = 70.0", 'temperature = "self-heated"').replace(
        'film_maps = "none"', 'films = "solved"\npoints = 65'
    )
    result = found(own + HEATED)
    warm = result["self_heating"]
    assert result["converged"] and warm["converged"]
    assert result["torque_N_mm"]["total"] == warm["torque_N_mm"]
    assert result["case"]["operation"]["temperature_C"] == pytest.approx(warm["temperature_C"], abs=1e-6)
    flows = result["heat_flows_W"]
    assert warm["power_W"] == pytest.approx(flows["shaft-ambient"] + flows["housing-ambient"], rel=1e-9)
    speed = result["case"]["operation"]["inner_speed_rpm"] * pi / 30.0
    assert warm["power_W"] == pytest.approx(1e-3 * result["torque_N_mm"]["total"] * speed, rel=1e-9)
    assert any(message.startswith("operation.temperature: computed at") for message in result["messages"])
    assert result["case"]["operation"]["temperature"] == "self-heated"
    assert "operation.temperature_C" not in result["case"]["assumed"]  # but computed


@pytest.mark.slow
def test_films_whose_torque_moves_the_temperature_to_and_fro_are_not_converged():
    """Films that 33 points do not resolve jump with the temperature, which none of the rounds leaves where it is."""
    own = CASE.replace("temperature_C = 70.0", 'temperature = "self-heated"').replace(
        'film_maps = "none"', 'films = "solved"\npoints = 33'
    )
    result = found(own + HEATED)
    warm = result["self_heating"]
    assert not result["converged"] and warm["converged"] is False
    assert warm["temperature_C"] is None
    (told,) = (message for message in result["warnings"] if message.startswith("self_heating"))
    assert "the temperature still moves by" in told
    assert "after 5 rounds of films" in told


@pytest.mark.slow
def test_no_balance_below_150_degrees_is_none():
    own = CASE.replace("temperature_C = 70.0", 'temperature = "self-heated"').replace("3000.0", "30000.0")
    result = found(own + HEATED.replace("1.2", "0.05"))
    assert not result["converged"] and result["self_heating"]["converged"] is False
    assert result["self_heating"]["temperature_C"] is None
    assert any("friction exceeds the cooling up to 150 C" in message for message in result["messages"])


def test_without_a_balance_the_temperature_stays_and_one_message_says_so():
    own = CASE.replace("temperature_C = 70.0", 'temperature_C = 70.0\ntemperature = "self-heated"')
    hot = case((own + HEATED).replace("heat_transfer_W_K = 1.2", "heat_transfer_W_K = 0.001"))
    once = with_temperature(hot)
    assert with_temperature(once) is once
    assert once.operation.temperature == pytest.approx(343.15)
    assert sum("operation.temperature: not self-heated" in note for note in once.warnings) == 1


def test_fits_take_the_temperature_of_the_balance_too():
    seats = "[fit]\ninner_ring_interference_um = 10.0\n"
    own = CASE.replace("temperature_C = 70.0", 'temperature = "self-heated"')
    result = found(own + HEATED + seats)
    assert result["clearance"]["operating_um"] == pytest.approx(result["self_heating"]["clearance_um"], abs=1e-3)


def test_a_set_of_two_warms_itself_by_the_loads_of_both_rows():
    """Preloaded rows without an external load: one row alone would carry nothing."""
    pair = CASE.replace('"6205"', '"7205C"').replace("radial_load_N = 700.0", "radial_load_N = 0.0")
    rows = "".join(
        f'[[rows]]\naxial_position_mm = {x}\nloaded_by = "{sense}"\npreload_class = "medium"\n'
        for x, sense in ((-8.0, "+x"), (8.0, "-x"))
    )
    own = pair.replace("temperature_C = 70.0", 'temperature = "self-heated"')
    result = found(own + HEATED.replace("ambient", 'heating_torque = "coulomb"\nambient') + rows)
    assert result["self_heating"]["torque_N_mm"] > 1.0
    assert sum("rows.preload_class: medium is taken as" in message for message in result["messages"]) == 1


def test_the_total_says_what_would_solve_its_films():
    """Where nothing has maps, and where all have them."""
    keys = {
        'film_maps = "none"': 'contacts; [ehl] films = "solved" with film_maps = "all" solves them',
        'film_maps = "all"\nfilms = "atlas"': 'contacts; [ehl] films = "solved" solves them',
    }
    for key, expected in keys.items():
        messages = found(CASE.replace('film_maps = "none"', key))["messages"]
        assert any(m.startswith("torque_N_mm.total: the integrated") and expected in m for m in messages)


def test_the_torque_of_seals_is_in_the_total_and_told():
    """2RS1 of the 6205, lips on d_1 = 34.4 mm: K_S1 d_s^2.25 + K_S2 = 0.023 34.4^2.25 + 2 N mm."""
    sealed = CASE.replace('"6205"', '"6205-2RS1"').replace('film_maps = "none"', "points = 33")
    result = found(sealed + "[friction]\ntraction = 'coulomb'\ncoefficient = 0.05\n")
    assert result["torque_N_mm"]["model"] == "integrated"
    assert any("with the contact seals, 67.9 N mm" in message for message in result["messages"])
    assert result["torque_N_mm"]["parts"]["seal"] == pytest.approx(67.9, abs=0.05)


def test_self_heating_is_needed_for_its_temperature():
    from oilfilm.cases import CaseError

    own = CASE.replace("temperature_C = 70.0", 'temperature = "self-heated"')
    with pytest.raises(CaseError, match="heat_transfer_W_K"):
        case(own)
