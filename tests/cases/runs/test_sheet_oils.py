"""Oils as data sheets print them, of every kind of base oil: film, temperature, torque and life without a number made
by hand.

Values were read in public places, which name the sheets; the base oils of the greases are those that their maker names
(from memory). S: table of fluids of "Machine Design Guides" (public repository, data/fluids.js), which prints the
addresses of its sheets, here beside them. T: table of equivalent oils of a public repository ("Tabela de similaridade",
data/database.js). C: bearing grease selection chart of SKF, as a public repository has it. F: a fit of a flight
simulator to the sheet of that oil. P: script of a public repository that compares oils of makers.
"""

from __future__ import annotations

from typing import NamedTuple

import pytest

from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.runs.bearing import run_case
from oilfilm.ehl.oil.assumed_heat import line_through
from oilfilm.postprocess import summary


class Sheet(NamedTuple):
    """What is printed: mm^2/s at 40 and 100 degrees Celsius, viscosity index, kg/m^3 at 15."""

    base: str
    cold: float
    hot: float | None = None
    index: float | None = None
    density: float | None = None


SHEETS = {
    # S perma-tec.com/_Resources/Lubricants/Shell/Shell_Tellus_S2_M_32_TDS_de.pdf
    "Shell Tellus S2 M 32": Sheet("mineral", 32.0, 5.4, density=875.0),
    # S pdf4pro.com/view/shell-tellus-s2-m-46-shell-livedocs-com-5751db.html
    "Shell Tellus S2 M 46": Sheet("mineral", 46.0, 6.8, density=879.0),
    # S mobil.com/en-CA/Passenger-Vehicle-Lube/pds/io-ca-Mobil-DexronVI-ATF
    "Mobil Dexron-VI ATF": Sheet("mineral", 29.5, 5.83, density=829.0),
    # S www.mobil.com/en-gb/commercial-vehicle-lube/pds/eu-xx-mobilube-hd-75w-90
    "Mobilube HD 75W-90": Sheet("mineral", 101.0, 16.0, density=880.0),
    "Chevron Capella WF 32": Sheet("mineral", 29.5, 4.37, 7.0),  # P, naphthenic
    "Harmony AW 100": Sheet("mineral", 97.6, 11.8, 110.0),  # P
    "Mobil DTE 26": Sheet("mineral", 68.0, index=98.0),  # T, as those below
    "Shell Turbo T 32": Sheet("mineral", 32.0, index=110.0),
    "Shell Corena S2 P 46": Sheet("mineral", 46.0, index=98.0),
    "Mobilgear 600 XP 150": Sheet("mineral", 150.0, index=97.0),
    "Castrol Alpha SP 220": Sheet("mineral", 220.0, index=95.0),
    "Mobilgear SHC XMP 220": Sheet("PAO", 220.0, index=152.0),
    "Shell Omala S4 GXV 220": Sheet("PAO", 220.0, index=153.0),
    "Texaco Pinnacle EP 220": Sheet("PAO", 220.0, index=155.0),
    "Mobil Glygoyle 220": Sheet("PAG", 220.0, index=220.0),
    "Shell Omala S4 WE 220": Sheet("PAG", 220.0, index=235.0),
    "Total Carter SY 220": Sheet("PAG", 220.0, index=230.0),
    "Mobil Jet Oil II": Sheet("ester", 27.6, 5.1),  # F
    "SKF LGMT 2": Sheet("mineral", 110.0),  # C, as those below: base oils of greases, one viscosity alone
    "SKF LGEP 2": Sheet("mineral", 200.0),
    "SKF LGHP 2": Sheet("mineral", 96.0),
    "SKF LGWA 2": Sheet("mineral", 185.0),
    "SKF LGLT 2": Sheet("PAO", 18.0),
    "SKF LGGB 2": Sheet("ester", 110.0),
    "SKF LGET 2": Sheet("PFPE", 400.0),
}
KEYS = ("kinematic_viscosity_40C_mm2_s", "kinematic_viscosity_100C_mm2_s", "viscosity_index", "density_15C_kg_m3")


def case_of(sheet, operation):
    base, *numbers = sheet
    given = "".join(f"{key} = {value}\n" for key, value in zip(KEYS, numbers, strict=True) if value is not None)
    text = f"""
schema_version = 1
[bearing]
name = "6206"
[operation]
inner_speed_rpm = 4000.0
radial_load_N = 900.0
{operation}
[ehl]
film_maps = "none"
[lubricant]
base_oil = "{base}"
contamination_factor = 0.5
{given}"""
    return case_from_text(text, "case.toml")


@pytest.mark.parametrize("name", SHEETS)
def test_film_torque_and_life_of_a_sheet(name):
    sheet = SHEETS[name]
    celsius = 100.0 if sheet.base == "PFPE" else 60.0  # at 60 their films lie beyond the film atlas
    document = summary(run_case(case_of(sheet, f"temperature_C = {celsius}")))
    assert document["converged"], document["warnings"]
    heavy = max(document["contacts"], key=lambda contact: contact["load_N"])
    assert 0.03 < heavy["film_central_um"] < 3.0
    # the interval of the coefficient of pressure is the largest part of the bar
    part = heavy["film_central_pressure_viscosity_uncertainty_um"]
    assert 0.08 < part / heavy["film_central_um"] < 0.6
    assert part < heavy["film_central_uncertainty_um"] < 1.5 * part
    assert 5.0 < document["torque_N_mm"]["total"] < 500.0
    assert document["life"]["modified_reference_rating_h"] > 100.0
    assert any(f"estimated as {sheet.base} oil" in message for message in document["messages"])


WARM = """temperature_C = 60.0
temperature = "self-heated"
[friction]
heat_transfer_W_K = 1.2
ambient_C = 25.0"""
SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in SHEETS if name not in ("Mobil Jet Oil II", "SKF LGMT 2")]


@pytest.mark.parametrize("name", ["Mobil Jet Oil II", "SKF LGMT 2", *SLOW])
def test_temperature_of_a_sheet(name):
    """Thick oils run warm, thin ones less so; no command asks for a property of heat."""
    document = summary(run_case(case_of(SHEETS[name], WARM)))
    heating = document["self_heating"]
    assert heating["converged"], document["warnings"]
    assert 30.0 < heating["temperature_C"] < 130.0


@pytest.mark.parametrize(("name", "printed"), [("Shell Tellus S2 M 32", 338.0), ("Shell Tellus S2 M 46", 580.0)])
def test_a_third_viscosity_of_a_sheet_lies_on_the_line(name, printed):
    """At 0 degrees Celsius; sheets round the others to two digits."""
    sheet = SHEETS[name]
    line = line_through((313.15, 373.15), (1e-6 * sheet.cold, 1e-6 * sheet.hot))
    assert 1e6 * line.at(273.15) == pytest.approx(printed, rel=0.01)
