"""Films of oils that thin under shear, with heat, and by laws of free volume, from case files."""

from __future__ import annotations

from dataclasses import replace

import pytest

from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.contact import FilmModel
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.bearing import run_case
from oilfilm.cases.runs.contact import run_contact
from oilfilm.postprocess import summary

CONTACT = """
schema_version = 1
[contact]
load_N = 20.0
radius_x_mm = 12.7
radius_y_mm = 12.7
material_1 = "bearing steel"
material_2 = "bearing steel"
entrainment_speed_m_s = 3.0
slide_roll_ratio = 0.5
[lubricant]
name = "iso vg 32"
[ehl]
points = 65
film_model = "newtonian"
"""


def solved(text):
    return summary(run_contact(case_from_text(text, "case.toml")))


@pytest.fixture(scope="module")
def films():
    return {m.value: solved(CONTACT.replace('"newtonian"', f'"{m.value}"')) for m in FilmModel}


def test_sliding_thins_the_film(films):
    """Half the entrainment speed in sliding, Eyring's stress 4.3 MPa: some per cent of the film, with heat, too."""
    assert all(film["converged"] for film in films.values())
    newtonian, thinned = films["newtonian"]["film_central_um"], films["shear-thinning"]["film_central_um"]
    assert 0.6 * newtonian < thinned < 0.99 * newtonian
    assert films["thermal"]["film_central_um"] < 0.99 * newtonian
    assert films["thermal"]["film_central_um"] != pytest.approx(thinned, rel=1e-3)


def test_the_model_is_reported(films):
    notes = {name: " ".join(film["messages"]) for name, film in films.items()}
    assert "generalized" not in notes["newtonian"]
    assert "uniform temperature" in notes["shear-thinning"]
    assert "with heat" in notes["thermal"]
    assert "sheared at the temperatures the film was solved with" in notes["thermal"]


def test_traction_coefficient_of_a_sliding_contact(films):
    """Between a part of the limiting coefficient, 0.047, and that."""
    assert 0.01 < films["newtonian"]["traction_coefficient"] < 0.047


def test_heat_takes_traction_and_is_reported(films):
    """Warm oil shears more easily, by 4 % here, near the limiting stress; without heat there is no temperature."""
    assert films["thermal"]["traction_coefficient"] < 0.98 * films["shear-thinning"]["traction_coefficient"]
    assert films["thermal"]["film_temperature_maximum_C"] > 45.0
    assert films["newtonian"]["film_temperature_maximum_C"] is None
    assert films["shear-thinning"]["film_temperature_maximum_C"] is None


def test_free_volume_laws_of_a_library_oil():
    text = CONTACT.replace("iso vg 32", "squalane").replace("[ehl]", 'viscosity_law = "tait-doolittle"\n[ehl]')
    text = text.replace("slide_roll_ratio", "temperature_C = 25.0\nslide_roll_ratio")
    assert solved(text)["converged"]
    with pytest.raises(CaseError, match="tait-doolittle"):
        solved(CONTACT.replace("[ehl]", 'viscosity_law = "tait-doolittle"\n[ehl]'))


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (('material_1 = "bearing steel"', "reduced_modulus_GPa = 226.0"), "reduced_modulus_GPa with film_model"),
        (('material_2 = "bearing steel"', 'material_2 = "phenolic"'), "thermal_conductivity_W_m_K"),
    ],
)
def test_what_heat_needs(change, expected):
    text = CONTACT.replace('"newtonian"', '"thermal"').replace(*change)
    if "reduced" in change[1]:
        text = text.replace('material_2 = "bearing steel"\n', "")
    with pytest.raises(CaseError, match=expected):
        case_from_text(text, "case.toml")


OWN = "viscosity_mPa_s = 20.0\npressure_viscosity_1_GPa = 20.0\n"


def of_own(keys=""):
    text = CONTACT.replace('"newtonian"', '"thermal"').replace('name = "iso vg 32"', OWN + keys)
    return case_from_text(text, "case.toml").conditions.lubricant.thermal


def test_heat_properties_that_are_left_out_are_those_of_the_base_oil():
    """One key alone is enough; what is given has no range."""
    mineral, ester = of_own(), of_own('base_oil = "ester"')
    assert mineral.expansion == 6.5e-4
    assert mineral.ranges.viscosity_temperature > 0.0
    assert ester.conductivity > mineral.conductivity
    given = of_own("thermal_conductivity_W_m_K = 0.15")
    assert given == replace(mineral, conductivity=0.15, ranges=replace(mineral.ranges, conductivity=0.0))
    by_index = of_own("viscosity_index = 160")
    assert by_index.viscosity_temperature < mineral.viscosity_temperature
    assert by_index.ranges.viscosity_temperature == 0.0


@pytest.mark.parametrize(
    "keys",
    [
        OWN + "viscosity_index = 100\nviscosity_temperature_1_K = 0.04",
        'name = "iso vg 32"\nbase_oil = "ester"',
        OWN + 'base_oil = "whale"',
    ],
)
def test_a_class_of_oils_stands_for_what_is_not_known(keys):
    with pytest.raises(CaseError, match=r"lubricant\.(viscosity_index|base_oil): found"):
        case_from_text(CONTACT.replace('name = "iso vg 32"', keys), "case.toml")


def test_moes_groups_have_no_lengths_to_shear():
    text = CONTACT[: CONTACT.index("load_N")] + "moes_M = 20.0\nmoes_L = 10.0\n" + CONTACT[CONTACT.index("[lub") :]
    with pytest.raises(CaseError, match="Moes' groups"):
        case_from_text(text.replace('"newtonian"', '"shear-thinning"'), "case.toml")


def test_a_bearing_with_a_thinning_oil():
    text = """
schema_version = 1
[bearing]
name = "7008"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 10000.0
axial_load_N = 300.0
[ehl]
points = 65
film_model = "shear-thinning"
"""
    results = run_case(case_from_text(text, "case.toml"))
    assert results.converged
    assert any("uniform temperature" in message for message in results.messages)


def test_an_isoviscous_oil_shears_as_one_whatever_its_coefficient():
    """Eyring's stress 2 Lambda/alpha is not of an oil whose viscosity does not rise with the pressure."""
    own = 'viscosity_mPa_s = 40.0\nviscosity_law = "isoviscous"\ndensity_law = "incompressible"\n'
    soft = CONTACT.replace('name = "iso vg 32"\n', own)
    soft = soft.replace('material_1 = "bearing steel"\nmaterial_2 = "bearing steel"', "reduced_modulus_GPa = 1.0")
    plain = solved(soft)
    given = solved(soft.replace(own, own + "pressure_viscosity_1_GPa = 20.0\n"))
    assert plain["converged"]
    assert plain["traction_coefficient"] > 0.0
    for key in ("moes_L", "film_central_um", "film_minimum_um", "traction_coefficient", "rolling_moment_N_mm"):
        assert given[key] == plain[key], key
