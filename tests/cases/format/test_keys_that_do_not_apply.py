"""Keys that say nothing where they stand, laws without constants, files that are not there: told with line and key."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from oilfilm.cases import CaseError
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.document import validate_text

from ..made_up_tables import made_up_tables

BEARING = """\
schema_version = 1
[bearing]
name = "6208"
bore_mm = 40.0
outside_diameter_mm = 80.0
width_mm = 18.0
basic_static_rating_kN = 19.0
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 6000.0
radial_load_N = 2000.0
[ehl]
film_maps = "none"
[friction]
coefficient = 0.05
"""
SURFACE = "[surface]\ninner_ring_roughness_um = 0.1\nouter_ring_roughness_um = 0.1\nball_roughness_um = 0.02\n"
OIL = "viscosity_mPa_s = 20.0\npressure_viscosity_1_GPa = 18.0\n"
HEAT = "coefficient = 0.05\nheat_transfer_W_K = 1.0\n"


def added(key, *lines):
    """The case with lines after that of a key."""
    (line,) = [line for line in BEARING.splitlines() if line.startswith(key)]
    return BEARING.replace(line, "\n".join((line, *lines)))


def line_of(text, key):
    return 1 + next(i for i, line in enumerate(text.splitlines()) if line.startswith(key))


def messages(text):
    with pytest.raises(CaseError) as caught:
        validate_text(text, "case.toml")
    return list(caught.value.messages)


WRONG = [
    (added("coefficient", "ambient_C = 25.0"), "ambient_C", "found without heat_transfer_W_K"),
    (added("coefficient", 'heating_torque = "palmgren"'), "heating_torque", "allowed: with friction.heat_transfer_W_K"),
    (added("coefficient", "cooling_oil_C = 30.0"), "cooling_oil_C", "found without heat_transfer_W_K"),
    (added("coefficient", "supply_loss = 0.1"), "supply_loss", "found without supply_mL_min"),
    (added('name = "iso', 'rheology = "newtonian"', "eyring_stress_MPa = 5.0"), "eyring_stress_MPa", "newtonian"),
    (added('name = "iso', "carreau_modulus_MPa = 5.0"), "carreau_modulus_MPa", 'without rheology = "carreau-yasuda"'),
    (added('name = "iso', "yasuda_exponent = 2.0"), "yasuda_exponent", 'allowed with "carreau-yasuda" only'),
    (added('name = "6208', 'skf_series = "99"'), "skf_series", "allowed: 2, 3, 42"),
    (added('name = "6208', 'skf_series = "72 B"'), "skf_series", 'found "72 B" for a deep groove bearing'),
    (added('name = "iso', 'viscosity_law = "tait-doolittle"'), "viscosity_law", "allowed: with the oils squalane"),
    (added('name = "iso', 'density_law = "tait"'), "density_law", 'the oil "iso vg 32" has no constants'),
    (
        added("coefficient", 'traction = "table"', 'traction_table = "nowhere.zip"'),
        "traction_table",
        '"nowhere.zip" cannot be read',
    ),
    (
        added("coefficient", 'traction = "table"', 'traction_table = "a\\u0000b"'),
        "traction_table",
        "control characters",
    ),
    (
        added("coefficient", "heat_transfer_W_K = 1.0", 'heating_torque = "starved"') + SURFACE,
        "[friction]",
        "friction.supply_mL_min: missing; needed, or lubricant.inlet_film_um",
    ),
    (
        added("coefficient", "heat_transfer_W_K = 1.0", 'heating_torque = "starved"', "supply_mL_min = 1.0"),
        "heating_torque",
        'surface: missing; needed with heating_torque = "starved"',
    ),
]


@pytest.mark.parametrize(("text", "key", "expected"), WRONG, ids=[expected for _, _, expected in WRONG])
def test_what_does_not_apply_is_refused_with_its_line(text, key, expected):
    found = messages(text)
    assert len(found) == 1
    assert found[0].startswith(f"case.toml:{line_of(text, key)}: ")
    assert expected in found[0]


def test_an_angular_contact_bearing_has_other_series():
    """And a deep groove bearing keeps its series when a large clearance gives it a large angle."""
    text = added('name = "6208', 'skf_series = "72 B"')
    validate_text(text.replace('"6208"', '"7008"'), "case.toml")
    wide = added('name = "6208', 'skf_series = "62"', "diametral_clearance_um = 40.0")
    validate_text(wide, "case.toml")


def test_keys_with_what_they_belong_to_are_valid():
    for text in (
        added("coefficient", "heat_transfer_W_K = 1.0", "ambient_C = 25.0", 'heating_torque = "skf"'),
        added("coefficient", "supply_mL_min = 1.0", "supply_loss = 0.1") + SURFACE,
        added("coefficient", "ambient_C = 20.0", 'heating_torque = "integrated"', "supply_loss = 0.03"),  # the defaults
        added('name = "iso', 'rheology = "ree-eyring"', "eyring_stress_MPa = 5.0"),
        added('name = "iso', "eyring_stress_MPa = 5.0"),
        added('name = "iso', 'rheology = "carreau-yasuda"', "carreau_modulus_MPa = 5.0", "carreau_exponent = 0.5"),
        added('name = "iso')
        .replace("iso vg 32", "squalane")
        .replace("[operation]", 'density_law = "tait"\n[operation]'),
    ):
        validate_text(text, "case.toml")


def test_shear_constants_of_a_named_oil_may_rest_while_another_law_is_asked_for():
    """The oil has its own law; the case takes Newton's. Constants that its own law does not have are refused."""
    mine = f'[lubricants.mine]\n{OIL}rheology = "carreau-yasuda"\ncarreau_modulus_MPa = 7.0\ncarreau_exponent = 0.5\n'
    text = BEARING.replace('"iso vg 32"', '"mine"\nrheology = "newtonian"') + mine
    assert case_from_text(text, "case.toml").rheology.law.value == "newtonian"
    wrong = text.replace('rheology = "carreau-yasuda"\n', "")
    assert any("lubricants.mine.carreau_modulus_MPa: found together" in message for message in messages(wrong))


def test_a_law_without_constants_in_an_oil_of_ones_own_has_the_line_of_the_oil():
    mine = f'[lubricants.mine]\n{OIL}viscosity_law = "tait-doolittle"\n'
    text = BEARING.replace('"iso vg 32"', '"mine"') + mine
    (found,) = messages(text)
    assert found.startswith(f"case.toml:{line_of(text, 'viscosity_law')}: lubricants.mine.viscosity_law: ")


def test_a_foreign_table_is_told_with_its_line(tmp_path):
    """Also in a sweep, at the key that varies."""
    from oilfilm.bearing.friction.tables import save_race_tables

    path = tmp_path / "made.zip"
    save_race_tables(made_up_tables(case_from_text(BEARING, "case.toml")), path)
    text = added("coefficient", 'traction = "table"', f'traction_table = "{path}"')
    case_from_text(text, "case.toml")
    foreign = text.replace("iso vg 32", "iso vg 46")
    with pytest.raises(CaseError) as caught:
        case_from_text(foreign, "case.toml")
    (found,) = caught.value.messages
    assert found.startswith(f"case.toml:{line_of(foreign, 'traction_table')}: friction.traction_table: ")
    assert "is for another bearing or oil" in found
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    sweep = 'case = "case.toml"\n[sweep]\n"lubricant.name" = ["iso vg 32", "iso vg 46"]\n'
    with pytest.raises(CaseError) as caught:
        sweep_from_text(sweep, "sweep.toml", tmp_path)
    assert any('lubricant.name = "iso vg 46"): friction.traction_table: ' in m for m in caught.value.messages)


@pytest.mark.parametrize(("celsius", "told"), [(25.0, False), (40.0, True)])
def test_constants_of_free_volume_at_another_temperature_are_told(celsius, told):
    text = added("radial_load_N", f"temperature_C = {celsius}").replace("iso vg 32", "squalane")
    text = text.replace("[operation]", 'viscosity_law = "tait-doolittle"\n[operation]')
    found = case_from_text(text, "case.toml").warnings
    assert any("of 25 C are taken at 40 C" in message for message in found) == told
    plain = text.replace('viscosity_law = "tait-doolittle"\n', "")
    assert not any("Doolittle" in message for message in case_from_text(plain, "case.toml").warnings)


def test_the_reason_is_printed_where_only_self_heating_fails(tmp_path):
    (tmp_path / "case.toml").write_text(BEARING.replace("coefficient = 0.05\n", HEAT + 'heating_torque = "yao"\n'))
    found = CliRunner().invoke(app, ["run", str(tmp_path / "case.toml"), "-o", str(tmp_path / "out"), "--quiet"])
    assert found.exit_code == 1, found.output
    after = found.stderr.partition("the results are flagged:\n")[2]
    assert "self_heating: null, not converged: " in after
    assert "friction.oil_fraction" in after


def test_starved_heating_without_a_supply_is_bad_input(tmp_path):
    text = BEARING.replace("coefficient = 0.05\n", HEAT + 'heating_torque = "starved"\n')
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    for command in ("validate", "run"):
        found = CliRunner().invoke(app, [command, str(tmp_path / "case.toml")])
        assert found.exit_code == 2, found.output
        assert "supply_mL_min: missing" in found.stderr


def test_rows_are_preloaded_at_rest_whatever_the_kinematics_in_operation():
    """A pair in traction equilibrium is preloaded as one in half and half."""
    rows = "".join(
        f'[[rows]]\naxial_position_mm = {x}\nloaded_by = "{side}"\npreload_N = 200.0\n'
        for x, side in ((-8.0, "+x"), (8.0, "-x"))
    )
    text = BEARING.replace('"6208"', '"7008"') + 'traction = "coulomb"\n' + rows
    balanced = case_from_text(text, "case.toml")
    assert balanced.model.ball_kinematics.value == "traction equilibrium"
    half = case_from_text(text + '[model]\nball_kinematics = "half and half"\n', "case.toml")
    assert balanced.rows == half.rows
