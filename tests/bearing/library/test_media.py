"""Media that are no oils: values against tables of others, ends of ranges, what they say of themselves."""

import sys
import warnings

import pytest

from oilfilm.bearing.library.lubricants import PROPERTIES, list_lubricants, list_media, load_lubricant, lubricant_data
from oilfilm.ehl import ViscosityLaw

pytestmark = pytest.mark.filterwarnings("ignore:lubricant")


@pytest.mark.parametrize(
    ("name", "celsius", "viscosity", "density", "conductivity", "specific_heat"),
    [
        # release of IAPWS on viscosity (R12-08, table 4: 889.735 uPa s at 998 kg/m3); 25 C, 1 atm, NIST's webbook
        ("water", 25.0, 8.90e-4, 997.05, 0.6065, 4181.3),
        ("water", 80.0, 3.54e-4, 971.8, 0.670, 4197.0),
        # saturated liquids of NIST's webbook at their boiling points
        ("LN2", -195.8, 1.61e-4, 806.1, 0.1448, 2042.0),
        ("LOX", -182.96, 1.95e-4, 1141.2, 0.1510, 1699.0),
        ("LH2", -252.88, 1.36e-5, 70.8, 0.1006, 9670.0),
        ("r134a", 25.0, 1.95e-4, 1206.7, 0.0811, 1425.0),
    ],
)
def test_liquids_have_the_values_of_tables(name, celsius, viscosity, density, conductivity, specific_heat):
    oil = load_lubricant(name, celsius + 273.15)
    assert oil.viscosity == pytest.approx(viscosity, rel=0.015)
    assert oil.density == pytest.approx(density, rel=2e-3)
    assert oil.thermal.conductivity == pytest.approx(conductivity, rel=0.015)
    assert oil.thermal.specific_heat == pytest.approx(specific_heat, rel=1e-2)
    assert oil.viscosity_law is ViscosityLaw.ISOVISCOUS
    assert not oil.piezoviscous


def test_sulphuric_acid_is_that_of_the_handbook():
    """30 % at 20 C: 1.2185 g/cm3 and 2.01 mPa s (CRC Handbook, concentrative properties)."""
    acid = load_lubricant("sulphuric acid 30 %", 293.15)
    assert acid.viscosity == pytest.approx(2.01e-3, rel=0.03)
    assert acid.density == pytest.approx(1218.5, rel=1e-3)


def test_every_medium_has_sources_and_falls_in_viscosity():
    media = {name: lubricant_data(name) for name in list_media()}
    assert [(name, key) for name, data in media.items() for key in PROPERTIES if not data[key]["source"]] == []
    for name, data in media.items():
        low, high = (end + 273.15 for end in data["range_C"])
        ends = [load_lubricant(name, low + share * (high - low)).viscosity for share in (0.01, 0.5, 0.99)]
        assert ends == sorted(ends, reverse=True), name


def test_media_are_no_oils():
    assert set(list_media()).isdisjoint(list_lubricants())
    assert set(list_media()) < set(list_lubricants("water"))


def test_beyond_its_range_a_medium_is_held_and_says_so():
    with pytest.warns(UserWarning, match="outside"):
        boiling = load_lubricant("liquid nitrogen", 273.15)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        end = load_lubricant("liquid nitrogen", 273.15 - 160.0)
    assert boiling.viscosity == end.viscosity


def test_hot_water_says_the_pressure_it_needs():
    with pytest.warns(UserWarning, match="liquid only above 0.477 MPa"):
        load_lubricant("water", 150.0 + 273.15)


def test_coolprop_waits_for_a_medium():
    code = "import sys, oilfilm.bearing.library.lubricants as l; l.load_lubricant('iso vg 32', 313.15); "
    code += "l.list_media(); assert not any(m.startswith('CoolProp') for m in sys.modules)"
    import subprocess

    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
