"""Twenty bearings that no shipped case has, each by one command from a new case: film map, one torque, life in hours,
temperature and stiffness, none null without its reason.

Steel, hybrid and all of ceramics; by designation and by size; 500 to 20 000 r/min; P/C from 0.01 to 0.5; misaligned,
preloaded, on a vertical axis.
"""

from __future__ import annotations

import json
from math import isfinite

import pytest
from typer.testing import CliRunner

from oilfilm.cases.cli.main import app

pytestmark = pytest.mark.slow
QUICK = {"ehl.tolerance": "0.02"}
TILTED = {"operation.tilt_mrad": "[0.0, 1.0]"}
# options of `oilfilm init`, keys that the case then gets
BEARINGS = {
    "6205 in a motor": ("--bearing 6205 --speed 3000 --radial 140", {}),
    "6206 at half its rating": ("--bearing 6206 --speed 500 --radial 9700", QUICK),
    "6305 C3 at high speed": ("--bearing 6305C3 --speed 18000 --radial 400 --axial 200", QUICK),
    "6010 misaligned": ("--bearing 6010 --speed 1500 --radial 1500", QUICK | TILTED),
    "6220 slow": ("--bearing 6220 --speed 500 --radial 12000", QUICK),
    "6004-2RS with grease": ("--bearing 6004-2RS --speed 6000 --radial 300", QUICK),
    "61910 thin": ("--bearing 61910 --speed 5000 --radial 700", QUICK),
    "6405 heavy": ("--bearing 6405 --speed 2000 --radial 8000", QUICK),
    "6208 vertical": ("--bearing 6208 --speed 3000 --radial 0 --axial 600", QUICK),
    "6308 hybrid": ("--bearing 6308hybrid --speed 10000 --radial 1200 --axial 300", QUICK),
    "6207 of silicon nitride": ("--bearing 6207fullceramic --speed 4000 --radial 900", QUICK),
    "7014C": ("--bearing 7014C --speed 20000", QUICK),
    "7014C hybrid": ("--bearing HCB7014C --speed 16000 --radial 300 --axial 1500", QUICK),
    "7012AC pair": ("--bearing 7012ACDB --speed 12000", QUICK),
    "7206B": ("--bearing 7206B --speed 4000 --radial 1000 --axial 2500", QUICK),
    "71910C pair, medium preload": ("--bearing 71910CDFM --speed 10000 --radial 200", QUICK),
    "7310B misaligned": ("--bearing 7310B --speed 1500 --radial 3000 --axial 9000", QUICK | TILTED),
    "by its size": ("--bore 28 --outside 58 --width 16 --speed 8000 --radial 170", QUICK),
    "by its size, rated, 25 degrees": (
        "--bore 45 --outside 85 --width 19 --angle 25 --C 38 --C0 28 --speed 15000 --axial 1200",
        QUICK,
    ),
    "6000 light and fast": ("--bearing 6000 --speed 20000 --radial 46", QUICK),
}


def with_keys(text, keys):
    """A case file with more keys, each at the head of its table."""
    for key, value in keys.items():
        table, _, name = key.partition(".")
        assert f"[{table}]\n" in text
        text = text.replace(f"[{table}]\n", f"[{table}]\n{name} = {value}\n", 1)
    return text


def faults(document):
    """What is missing of a run's summary, or not a number that one may act on."""
    found = []
    notes = " ".join(document["messages"])
    carrying = 0.02 * max(contact["load_N"] for contact in document["contacts"])  # less may have no film
    for contact in document["contacts"]:
        if contact["load_N"] > carrying and not (contact["film_minimum_um"] or 0.0) > 0.0:
            found.append(f"ball {contact['ball']} {contact['race']}: no film")
    torque = document["torque_N_mm"]
    numbers = {
        "torque": torque["total"],
        "temperature": document["case"]["operation"]["temperature_C"],
        "heat balance": document["self_heating"]["temperature_C"],
        "axial stiffness": document["ring"]["stiffness"]["matrix"][0][0],
        "radial stiffness": document["ring"]["stiffness"]["matrix"][1][1],
    }
    balance = numbers["heat balance"]
    if balance is not None and abs(balance - numbers["temperature"]) > 0.5:
        found.append(f"two temperatures: {numbers['temperature']} and {balance}")
    life = document["life"]
    if "silicon nitride" not in document["case"]["bearing"]["ring_material"]:
        numbers |= {key: life[key] for key in ("basic_reference_rating_h", "modified_reference_rating_h")}
    elif "life" not in notes:
        found.append("life: null without its reason")
    for name, value in numbers.items():
        if value is None or not isfinite(value) or value <= 0.0:
            found.append(f"{name}: {value}")
    if torque["model"] != "integrated":
        found.append(f"torque by {torque['model']}")
    return found


@pytest.mark.parametrize("name", BEARINGS)
def test_a_new_case_gives_every_number_by_one_command(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    options, keys = BEARINGS[name]
    answer = CliRunner().invoke(app, ["init", "own", *options.split()])
    assert answer.exit_code == 0, answer.output
    path = tmp_path / "own.toml"
    path.write_text(with_keys(path.read_text(encoding="utf-8"), keys), encoding="utf-8")
    answer = CliRunner().invoke(app, ["run", "own", "--json", "-q"])
    document = json.loads(answer.stdout)
    print(
        name,
        f"exit {answer.exit_code}",
        f"torque {document['torque_N_mm']['total']} N mm",
        f"at {document['case']['operation']['temperature_C']} C",
        f"(balance {document['self_heating']['temperature_C']} C)",
        f"L10h {document['life']['basic_reference_rating_h']}",
        faults(document),
    )
    assert faults(document) == []
    assert answer.exit_code == 0, answer.stderr
