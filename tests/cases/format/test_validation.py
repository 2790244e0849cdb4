"""Messages of case files: each error with its line, what was found, what is allowed, the nearest valid name."""

from __future__ import annotations

import pytest

from oilfilm.cases import CaseError, load_case
from oilfilm.cases.format.document import validate_text

BEARING = """\
schema_version = 1
title = "test"
[bearing]
ball_diameter_mm = 12.0
pitch_diameter_mm = 60.0
balls = 9
inner_groove_radius_mm = 6.17
outer_groove_radius_mm = 6.29
diametral_clearance_um = 13.0
ring_material = "silicon nitride"
ball_material = "silicon nitride"
[lubricant]
viscosity_mPa_s = 26.1
pressure_viscosity_1_GPa = 18.0
[operation]
inner_speed_rpm = 10000.0
radial_load_N = 3000.0
[ehl]
points = 257
"""
CONTACT = """\
schema_version = 1
[contact]
load_N = 15.0
radius_x_mm = 12.5
radius_y_mm = 12.5
reduced_modulus_GPa = 110.0
entrainment_speed_m_s = 0.09
[lubricant]
viscosity_mPa_s = 26.1
pressure_viscosity_1_GPa = 18.0
"""


def messages(text):
    with pytest.raises(CaseError) as caught:
        validate_text(text, "case.toml")
    return list(caught.value.messages)


def line_of(text, key):
    return 1 + next(i for i, line in enumerate(text.splitlines()) if line.startswith(key))


def replaced(text, key, new):
    return "\n".join(new if line.startswith(f"{key} ") else line for line in text.splitlines()) + "\n"


@pytest.mark.parametrize("text", [BEARING, CONTACT])
def test_the_texts_of_this_file_are_valid(text):
    validate_text(text, "case.toml")


BEARING_ERRORS = [
    ("balls", 'balls = "nine"', 'bearing.balls: found "nine"; allowed: a whole number >= 3'),
    ("balls", "balls = true", "bearing.balls: found true; allowed: a whole number"),
    ("balls", "balls = 9.0", "bearing.balls: found 9.0; allowed: a whole number"),
    ("balls", "balls = 16", "at most 15 balls of 12 mm"),
    ("balls", "ball = 9", "bearing.ball: unknown key; did you mean 'balls'?"),
    ("ball_diameter_mm", "ball_diameter = 12.0", "keys end in their unit; did you mean 'ball_diameter_mm'?"),
    ("ball_diameter_mm", "ball_diameter_mm = nan", "found nan; allowed: a number >= 0.001"),
    ("ball_diameter_mm", "ball_diameter_mm = inf", "found inf"),
    ("ball_diameter_mm", "ball_diameter_mm = 1e300", "found 1e+300; allowed: a number >= 0.001 and <= 10000"),
    ("ball_diameter_mm", "ball_diameter_mm = -12", "found -12"),
    ("ball_diameter_mm", "ball_diameter_mm = 1979-05-27", "found 1979-05-27"),
    ("inner_groove_radius_mm", "inner_groove_radius_mm = 5.9", "above the ball radius, 6 mm"),
    ("pitch_diameter_mm", "pitch_diameter_mm = 11.0", "more than the ball diameter, 12 mm"),
    ("diametral_clearance_um", "diametral_clearance_um = 950.0", "from -460 to 920 um"),
    ("ring_material", 'ring_material = "silicon nitrid"', "did you mean 'silicon nitride'?"),
    ("radial_load_N", "radial_load_kN = 3", "did you mean 'radial_load_N'?"),
    ("radial_load_N", "load_N = 3", "unknown key; did you mean 'axial_load_N'?"),
    ("radial_load_N", "force_N = [0, 3000]", "a list of 3 numbers"),
    ("radial_load_N", "force_N = [0, 3000, true]", "a list of 3 numbers"),
    ("radial_load_N", 'displacement_um = [0, "loose", 0]', 'or the word "free"'),
    ("inner_speed_rpm", 'inner_speed_rpm = "fast"', 'found "fast"'),
    ("points", "points = 256", "found 256; allowed: 2^k + 1: 33, 65"),
    ("points", "points = 257.0", "2^k + 1"),
    ("points", "tolerance = 0", "1e-05"),
    ("points", "domain = [4.5, 1.5, 3.0]", "x_in < -1"),
    (
        "points",
        "film_maps = [0.0, 41.0]",
        "found 41.0, where no ball is; allowed: azimuths of balls; the nearest is 40",
    ),
    ("points", 'film_maps = "some"', '"all", "loaded", "none"'),
    ("points", "temperature_C = 20.0", "temperature_C belongs in [operation]"),
    ("viscosity_mPa_s", "viscosity_Pa_s = 0.02", "did you mean 'viscosity_mPa_s'?"),
    ("viscosity_mPa_s", "viscosity_mPa_s = 0", "found 0; allowed: a number > 0"),
    ("pressure_viscosity_1_GPa", 'viscosity_law = "yasutomi"', "has no constants; allowed: with yasutomi_glass_temper"),
    ("title", "title = 3", "title: found 3; allowed: text in quotes"),
    ("title", 'assumed = ["bearing.clearance_um"]', "did you mean 'bearing.diametral_clearance_um'?"),
    ("schema_version", "schema_version = 2", "schema_version: found 2; allowed: 1"),
    ("schema_version", "schema_version = true", "schema_version: found true; allowed: 1"),
]


@pytest.mark.parametrize(("key", "new", "expected"), BEARING_ERRORS, ids=[new for _, new, _ in BEARING_ERRORS])
def test_bearing_error(key, new, expected):
    text = replaced(BEARING, key, new)
    found = messages(text)
    line = line_of(text, new)
    assert any(message.startswith(f"case.toml:{line}: ") and expected in message for message in found), found


def test_of_an_unknown_bearing_only_the_name_is_reported():
    text = "schema_version = 1\n[bearing]\nname = '7280B'\n[lubricant]\nname = 'iso vg 32'\n"
    found = messages(text + "[operation]\ninner_speed_rpm = 1.0\nradial_load_N = 1.0\ntemperature_C = 40.0\n")
    assert len(found) == 1
    assert "unknown bearing" in found[0]


def test_minimum_dissipation_is_refused_with_the_reason():
    found = messages(BEARING + '[model]\nball_kinematics = "minimum dissipation"\n')
    assert any(
        "jumps between the two race controls" in message and "traction equilibrium" in message for message in found
    )


ADDED_BEARING_ERRORS = [
    ("[operation]", "force_N = [0.0, 3000.0, 0.0]", "radial_load_N", "found together with force_N"),
    ("[operation]", "displacement_um = [0, 5, 0]", "displacement_um", "together with a load of 3000.0 N along y"),
    ("[operation]", 'tilt = "held"\nmoment_N_mm = [1.0, 0.0]', "tilt", "together with a moment"),
    ("[operation]", "tilt_mrad = [1, 0]\nmoment_N_mm = [2.0, 0.0]", "tilt_mrad", "a moment of 2.0 N mm about y"),
    ("[operation]", 'tilt_mrad = [1, 0]\ntilt = "free"', "tilt =", "together with tilt_mrad"),
    ("[bearing]", "free_contact_angle_deg = 20.0", "free_contact_angle_deg", "9.643 deg with this clearance"),
    ("[bearing]", "bore_mm = 49.0", "bore_mm", "less than the inner raceway's diameter, 48 mm"),
    ("[bearing]", "outside_diameter_mm = 71.0", "outside_diameter_mm", "more than the outer raceway's diameter, 72 mm"),
    ("[lubricant]", "kinematic_viscosity_mm2_s = 30.0", "kinematic_viscosity_mm2_s", "together with viscosity_mPa_s"),
    ("[lubricant]", 'name = "iso vg 47"', "name", "did you mean 'iso vg 46'?"),
    ("[lubricant]", 'viscosity_law = "barus"\nroelands_z = 0.6', "roelands_z", 'allowed with "roelands" only'),
]


@pytest.mark.parametrize(("table", "new", "key", "expected"), ADDED_BEARING_ERRORS, ids=lambda x: None)
def test_conflict(table, new, key, expected):
    text = BEARING.replace(table, f"{table}\n{new}")
    found = messages(text)
    assert any(m.startswith(f"case.toml:{line_of(text, key)}: ") and expected in m for m in found), found


def test_a_misspelt_table():
    assert "did you mean 'operation'?" in messages(BEARING.replace("[operation]", "[operations]"))[0]


def test_clearance_and_angle_may_stand_together_if_they_agree():
    validate_text(BEARING.replace("[bearing]", "[bearing]\nfree_contact_angle_deg = 9.65"), "case.toml")


def test_all_errors_of_a_file_at_once():
    text = replaced(BEARING, "balls", "balls = 9.5")
    text = replaced(text, "inner_groove_radius_mm", "inner_groove_radius_mm = 5.0")
    text = replaced(text, "points", "points = 100")
    text = replaced(text, "viscosity_mPa_s", "viscosity = 3")
    text = replaced(text, "radial_load_N", "radial_load_N = nan")
    assert [message.split(":")[1] for message in messages(text)] == ["6", "7", "13", "17", "19"]


CONTACT_ERRORS = [
    ("load_N", "[surface]", "surface: not used by a single contact; allowed in a bearing case"),
    ("load_N", "[ehl]\nfilm_maps = 'all'", "ehl.film_maps: not used by a single contact"),
    ("load_N", "load = 15", "keys end in their unit; did you mean 'load_N'?"),
    ("load_N", "load_N = 0", "a number > 0"),
    ("entrainment_speed_m_s", "entrainment_speed_m_s = -0.09", "found -0.09; allowed: a number > 0"),
    (
        "reduced_modulus_GPa",
        'material_1 = "bearing steel"',
        "needed: reduced_modulus_GPa, or material_1 and material_2",
    ),
    ("load_N", "moes_M = 20.0", "missing; needed: moes_M and moes_L"),
    (
        "viscosity_mPa_s",
        "# nothing",
        "needed: viscosity_mPa_s, kinematic_viscosity_mm2_s, those of a data sheet (kinematic_viscosity_40C_mm2_s,",
    ),
    ("viscosity_mPa_s", "viscosity_mPa_s = 0.01", "found 0.01; allowed: a viscosity and coefficient with 0 < z <= 2"),
    ("pressure_viscosity_1_GPa", "pressure_viscosity_1_GPa = 99.0", "Roelands' identity gives z ="),
]


@pytest.mark.parametrize(("key", "new", "expected"), CONTACT_ERRORS, ids=[new for _, new, _ in CONTACT_ERRORS])
def test_contact_error(key, new, expected):
    found = messages(replaced(CONTACT, key, new))
    assert any(expected in message for message in found), found


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "case.toml:1: the file is empty"),
        ("# only a comment\n", "case.toml:1: the file is empty"),
        ("a = 1\nb = \n", "case.toml:2: not valid TOML"),
        ("a = 1\na = 2\n", "case.toml:2: not valid TOML"),
        ("a = [1,\n", "not valid TOML"),
        ("a = " + "[" * 20000, "nested too deeply"),
        ("a = " + "9" * 5000, "number of more than 200 characters"),
        (BEARING.replace("schema_version = 1\n", ""), "case.toml:1: schema_version: missing"),
        (BEARING + "[contact]\nload_N = 1\n", "contact: found together with [bearing]"),
        ('case = "6208"\n[sweep]\n', "case.toml:1: a sweep; run it with 'oilfilm batch'"),
    ],
)
def test_whole_file(text, expected):
    found = messages(text)
    assert any(expected in message for message in found), found


def test_messages_are_short_lines_without_control_characters():
    text = BEARING.replace('"test"', '"' + "x" * 5000 + '"').replace("12.0", '"' + "\\u0007" * 300 + '"')
    for message in messages(text):
        assert len(message) < 250
        assert message.isprintable()


def test_moes_lubricant_parameter_needs_a_scale_of_pressure():
    """L = G (2U)^(1/4) with G = alpha E' says nothing about an oil without alpha."""
    text = 'schema_version = 1\n[contact]\nmoes_M = 20.0\nmoes_L = {}\n[lubricant]\nviscosity_law = "isoviscous"\n{}\n'
    for key in ("", "pressure_viscosity_1_GPa = 0.0"):
        found = messages(text.format(10.0, key))
        assert any("contact.moes_L: found 10.0 without a pressure_viscosity_1_GPa above 0" in m for m in found), found
        validate_text(text.format(0.0, key), "case.toml")
    validate_text(text.format(10.0, "pressure_viscosity_1_GPa = 20.0"), "case.toml")


def test_an_oil_of_the_library_ends_at_a_temperature():
    own = BEARING.replace("radial_load_N", "temperature_C = 450.0\nradial_load_N")
    named = own.replace("viscosity_mPa_s = 26.1\npressure_viscosity_1_GPa = 18.0", 'name = "iso vg 68"')
    (error,) = messages(named)
    assert "operation.temperature_C: found 450.0; allowed with an oil of the library: -100 to below 426.85" in error
    validate_text(own, "case.toml")


def test_a_roughness_that_is_left_out_is_typical_and_named():
    case = load_case("6208_life").with_values({"surface.ball_roughness_um": 0.004})
    surface = case.document["surface"]
    assert surface["ball_roughness_um"] == 0.004
    assert surface["inner_ring_roughness_um"] == surface["outer_ring_roughness_um"] == 0.05
    assert {"surface.inner_ring_roughness_um", "surface.outer_ring_roughness_um"} <= set(case.document["assumed"])
    assert "surface.ball_roughness_um" not in case.document["assumed"]
    (told,) = [warning for warning in case.warnings if "roughness" in warning]
    assert "races" in told and "balls" not in told
    ceramic = load_case("6208_full_ceramic").document["surface"]
    assert ceramic["inner_ring_roughness_um"] == 0.05 > ceramic["ball_roughness_um"]
