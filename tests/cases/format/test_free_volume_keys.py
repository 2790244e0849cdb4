"""Constants of free volume of one's own oil: squalane as printed is the library's; Yasutomi's laws; what is refused."""

from __future__ import annotations

import json

import pytest

from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.document import validate_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.ehl.oil.free_volume import (
    ExpansivityForm,
    YasutomiGlass,
    log_viscosity_yasutomi,
    pressure_viscosity_yasutomi,
)
from oilfilm.ehl.oil.lubricant import density, viscosity

CONTACT = """\
schema_version = 1
[contact]
load_N = 18.8
radius_x_mm = 9.525
radius_y_mm = 9.525
reduced_modulus_GPa = 227.0
entrainment_speed_m_s = 1.0
temperature_C = 25.0
[lubricant]
"""
LAWS = 'viscosity_law = "tait-doolittle"\ndensity_law = "tait"\n'
CONSTANTS = """\
tait_bulk_modulus_GPa = 1.312
tait_bulk_modulus_derivative = 11.74
doolittle_factor = 5.258
doolittle_occupied_share = 0.6633
"""
SQUALANE = CONTACT + LAWS + "viscosity_mPa_s = 27.6\ndensity_kg_m3 = 864.0\n" + CONSTANTS
GLASS = """\
viscosity_mPa_s = 30.0
viscosity_law = "yasutomi"
yasutomi_glass_temperature_C = -28.2
yasutomi_glass_rise_K = 134.2
yasutomi_glass_pressure_1_GPa = 1.929
yasutomi_slope = 16.01
yasutomi_width_K = 20.69
"""
FIRST = "yasutomi_expansivity_1_GPa = 0.160\nyasutomi_expansivity_factor = 4.815\n"
IMPROVED = "yasutomi_expansivity_1_GPa = 11.0\nyasutomi_expansivity_exponent = -0.5\n"


def oil(text):
    return case_from_text(text, "case.toml").conditions.lubricant


def messages(text):
    with pytest.raises(CaseError) as caught:
        case_from_text(text, "case.toml")
    return list(caught.value.messages)


def test_squalane_as_printed_is_that_of_the_library():
    """Constants to the bit, coefficient from them; at 0.5 and 1 GPa the viscosities that the printed constants give."""
    own, library = oil(SQUALANE), oil(CONTACT + 'name = "squalane"\n' + LAWS)
    assert own.tait == library.tait
    assert own.doolittle == library.doolittle
    assert own.pressure_viscosity == library.pressure_viscosity == pytest.approx(23.45e-9, rel=1e-3)
    for p in (0.0, 0.3e9, 0.5e9, 1.0e9):
        assert viscosity(p, own) == pytest.approx(float(viscosity(p, library)), rel=1e-12)
        assert density(p, own) == pytest.approx(float(density(p, library)), rel=1e-12)
    assert viscosity(0.5e9, own) == pytest.approx(39.18, rel=1e-3)
    assert viscosity(1.0e9, own) == pytest.approx(10033.0, rel=1e-3)


def test_constants_of_a_named_oil_and_over_those_of_the_library():
    """In [lubricants.NAME]; in [lubricant] they replace the library's, with its viscosity and density."""
    named = CONTACT + 'name = "mine"\n' + LAWS + "[lubricants.mine]\nviscosity_mPa_s = 27.6\ndensity_kg_m3 = 864.0\n"
    assert oil(named + CONSTANTS).tait == oil(SQUALANE).tait
    resting = (named + CONSTANTS).replace(LAWS, "") + "pressure_viscosity_1_GPa = 20.0\n"
    assert oil(resting).viscosity_law.value == "roelands"  # an oil may have constants that no law takes
    other = oil(CONTACT + 'name = "iso vg 32"\n' + LAWS + CONSTANTS)
    assert other.doolittle == oil(SQUALANE).doolittle
    assert other.viscosity == oil(CONTACT + 'name = "iso vg 32"\n').viscosity
    stiffer = CONTACT + 'name = "squalane"\n' + LAWS + CONSTANTS.replace("1.312", "1.5")
    assert oil(stiffer).tait.bulk_modulus == 1.5e9
    assert oil(stiffer).pressure_viscosity < oil(SQUALANE).pressure_viscosity


def test_constants_over_the_temperature():
    """T_R, b, a and e arrive; the share and modulus of 40 degrees differ from those of another temperature."""
    at_60 = SQUALANE.replace("temperature_C = 25.0", "temperature_C = 60.0") + "tait_temperature_C = 40.0\n"
    fixed = case_from_text(at_60, "case.toml")
    assert any("of 40 C are taken at 60 C" in message for message in fixed.warnings)
    more = "tait_bulk_modulus_temperature_1_K = 0.0064\ntait_expansion_1_K = 8e-4\n"
    more += "doolittle_occupied_expansion_1_K = -1e-3\n"
    case = case_from_text(at_60 + more, "case.toml")
    assert not any("are taken at" in message for message in case.warnings)
    oil_at_60 = case.conditions.lubricant
    assert oil_at_60.tait.reference_temperature == 313.15
    assert (oil_at_60.tait.bulk_modulus_temperature, oil_at_60.tait.expansion) == (0.0064, 8e-4)
    assert oil_at_60.doolittle.occupied_expansion == -1e-3
    assert oil_at_60.pressure_viscosity != pytest.approx(fixed.conditions.lubricant.pressure_viscosity, rel=0.01)


@pytest.mark.parametrize("form", ["first", "improved"])
def test_yasutomis_laws(form):
    """Units of every constant: viscosity at pressure by the law itself with constants in SI."""
    text = CONTACT.replace("temperature_C = 25.0", "temperature_C = 92.0") + GLASS
    found = oil(text + (FIRST if form == "first" else IMPROVED))
    constants = (4.815, 0.160e-9) if form == "first" else (11e-9, -0.5)
    glass = YasutomiGlass(
        glass_temperature=273.15 - 28.2,
        glass_rise=134.2,
        glass_pressure_coefficient=1.929e-9,
        expansivity_1=constants[0],
        expansivity_2=constants[1],
        slope=16.01,
        width=20.69,
        form=ExpansivityForm.LOGARITHMIC if form == "first" else ExpansivityForm.POWER,
    )
    assert found.pressure_viscosity == pytest.approx(pressure_viscosity_yasutomi(glass, 365.15), rel=1e-9)
    for p in (0.1e9, 0.4e9):
        from_glass = log_viscosity_yasutomi(p, 365.15, glass) - log_viscosity_yasutomi(0.0, 365.15, glass)
        assert viscosity(p, found) == pytest.approx(0.03 * 2.718281828459045 ** float(from_glass), rel=1e-9)


@pytest.mark.parametrize(
    ("text", "key", "told"),
    [
        (
            SQUALANE.replace("tait_bulk_modulus_derivative = 11.74\n", ""),
            "[lubricant]",
            "tait_bulk_modulus_derivative: m",
        ),
        (SQUALANE.replace("doolittle_factor = 5.258\n", ""), "[lubricant]", "doolittle_factor: missing"),
        (SQUALANE.replace(CONSTANTS, ""), "viscosity_law", "has no constants; allowed: with the oils squalane"),
        (SQUALANE + "tait_expansion_1_K = 8e-4\n", "[lubricant]", "tait_temperature_C: missing"),
        (SQUALANE + "pressure_viscosity_1_GPa = 18.0\n", "pressure_viscosity", "the constants of the law give 23.45"),
        (SQUALANE + "doolittle_occupied_share_K = 1.0\n", "doolittle_occupied_share_K", "unknown key"),
        (SQUALANE.replace("0.6633", "1.2"), "doolittle_occupied_share", "> 0 and < 1"),
        (SQUALANE.replace(LAWS, "pressure_viscosity_1_GPa = 18.0\n"), "tait_bulk_modulus_GPa", "without its law"),
        (CONTACT + GLASS, "[lubricant]", "yasutomi_expansivity_1_GPa: missing"),
        (
            CONTACT + GLASS + IMPROVED + "yasutomi_expansivity_factor = 4.8\n",
            "yasutomi_expansivity_factor",
            "one of them",
        ),
        (
            CONTACT + GLASS + "yasutomi_expansivity_1_GPa = 11.0\n",
            "[lubricant]",
            "needed: yasutomi_expansivity_exponent",
        ),
    ],
)
def test_what_is_incomplete_or_does_not_apply_is_told(text, key, told):
    line = 1 + next(i for i, row in enumerate(text.splitlines()) if row.startswith(key))
    found = messages(text)
    assert any(m.startswith(f"case.toml:{line}: lubricant") and told in m for m in found), found


def test_the_document_of_a_run_reads_again():
    """What a summary says of the case is a case with the same oil."""
    case = case_from_text(SQUALANE, "case.toml")
    keys = case.document["lubricant"]
    assert keys["pressure_viscosity_1_GPa"] == pytest.approx(23.45, rel=1e-3)
    lines = "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
    validate_text(CONTACT + lines, "case.toml")
    assert oil(CONTACT + lines).tait == oil(SQUALANE).tait
