"""Oils as data sheets print them, of every kind of base oil: film, torque and life without a number made by hand.

The numbers are typical of such sheets: index in place of a viscosity, density left out, base oils of greases.
"""

from __future__ import annotations

import pytest

from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.runs.bearing import run_case
from oilfilm.postprocess import summary

SHEETS = [  # base oil; mm^2/s at 40 and 100 degrees Celsius; kg/m^3 at 15; viscosity index
    ("mineral", 10.1, 2.6, None, None),
    ("mineral", 32.0, 5.4, 870.0, None),
    ("mineral", 46.0, None, 879.0, 98.0),
    ("mineral", 68.0, 8.6, None, None),
    ("mineral", 150.0, 14.7, 890.0, None),
    ("mineral", 220.0, 19.4, 899.0, None),
    ("mineral", 460.0, 30.4, 905.0, None),
    ("mineral", 125.0, 12.0, 900.0, None),
    ("PAO", 32.0, 6.3, 835.0, None),
    ("PAO", 65.0, 11.6, None, None),
    ("PAO", 220.0, 28.5, 860.0, None),
    ("PAO", 460.0, None, 860.0, 160.0),
    ("ester", 27.6, 5.1, 1003.0, None),
    ("ester", 12.5, 3.2, 950.0, None),
    ("ester", 47.0, 9.2, 920.0, None),
    ("ester", 23.0, 4.7, 930.0, None),
    ("PAG", 220.0, 41.0, 1070.0, None),
    ("PAG", 320.0, None, 1074.0, 230.0),
    ("PFPE", 160.0, 18.0, 1940.0, None),
    ("PFPE", None, 45.0, 1850.0, 320.0),
]
KEYS = ("kinematic_viscosity_40C_mm2_s", "kinematic_viscosity_100C_mm2_s", "density_15C_kg_m3", "viscosity_index")


@pytest.mark.parametrize("sheet", SHEETS, ids=[f"{base} {cold or hot}" for base, cold, hot, *_ in SHEETS])
def test_film_torque_and_life_of_a_sheet(sheet):
    base, *numbers = sheet
    given = "".join(f"{key} = {value}\n" for key, value in zip(KEYS, numbers, strict=True) if value is not None)
    temperature = 100.0 if base == "PFPE" else 60.0  # at 60 their films lie beyond the film atlas
    text = f"""
schema_version = 1
[bearing]
name = "6206"
[operation]
inner_speed_rpm = 4000.0
radial_load_N = 900.0
temperature_C = {temperature}
[ehl]
film_maps = "none"
[lubricant]
base_oil = "{base}"
contamination_factor = 0.5
{given}"""
    document = summary(run_case(case_from_text(text, "case.toml")))
    assert document["converged"], document["warnings"]
    heavy = max(document["contacts"], key=lambda contact: contact["load_N"])
    assert 0.03 < heavy["film_central_um"] < 3.0
    assert 5.0 < document["torque_N_mm"]["total"] < 500.0
    assert document["life"]["modified_reference_rating_h"] > 100.0
    assert any(f"estimated as {base} oil" in message for message in document["messages"])
