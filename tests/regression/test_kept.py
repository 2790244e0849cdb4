"""All numbers of made-up bearings and contacts: summary, files and pictures, as they were; see `tests/kept.py`."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from oilfilm.cases import load_case, run_case, run_contact
from oilfilm.cases.batch.engine import run_batch
from oilfilm.cases.batch.results import load_results, write_batch
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.document import read_text
from oilfilm.cases.format.shaft_case import load_shaft
from oilfilm.cases.format.shipped import find_case, shipped_cases
from oilfilm.cases.rexs import drive, read_rexs, shaft_text
from oilfilm.cases.runs.stiffness_and_slip import run_slip
from oilfilm.postprocess import summary
from oilfilm.postprocess.batch.summary import batch_summary
from oilfilm.postprocess.report.page import report_page
from oilfilm.postprocess.slip.results import slip_summary
from oilfilm.postprocess.slip.write import write_slip
from oilfilm.postprocess.writer import write_results

from ..cases.batch.test_batch import HerePool
from ..cases.runs.changed_cases import text
from ..cases.runs.made_up_cases import CASES
from ..kept import drawn, kept

GEARBOX = Path(__file__).parents[1] / "data" / "rexs" / "SEW_3-stage_cylindrical_gearbox_1.0.rexs"
SWEEP = """case = "6206_radial_500N"
[fixed]
"ehl.film_maps" = "none"
[sweep]
"operation.radial_load_N" = [500.0, 1000.0]
"operation.inner_speed_rpm" = [500.0, 5000.0]
"""
WITH_FILES = ("angular contact", "pair")
CONTACTS = ("ball_on_disc", "ball_on_disc_starved", "squalane_ball_on_disc", "coated_steel", "moes_20_10")
SHIPPED = ("6205_ceramic_dry_in_vacuum", "6206_axial_500N", "6208_duty_cycle")
SOLVED = 1e-4


@pytest.mark.parametrize("name", CASES)
def test_bearings(name, tmp_path):
    results = run_case(case_from_text(text(CASES[name]), "case"))
    found = {"summary": summary(results)}
    if name in WITH_FILES:
        with drawn() as pictures:
            assert write_results(results, tmp_path) == ()
        found |= {"files": tmp_path, "pictures": pictures}
    kept(f"bearing, {name}", found)


@pytest.mark.parametrize("stem", SHIPPED)
def test_shipped_bearings(stem):
    kept(f"shipped, {stem}", summary(run_case(load_case(stem))))


@pytest.mark.parametrize("stem", CONTACTS)
def test_contacts(stem, tmp_path):
    case = load_case(stem)
    results = run_contact(replace(case, solver=replace(case.solver, points=33, tolerance=None)))
    with drawn() as pictures:
        write_results(results, tmp_path)
    kept(f"contact, {stem}", {"summary": summary(results), "files": tmp_path, "pictures": pictures}, SOLVED)


NEW = (
    *("6208", "6205-2RS C3", "7014C", "7012AC DB", "61808", "16006", "6306-2Z/C3", "7208B", "625", "6020 C4"),
    *("--bore 45 --outside 100 --width 25 --C 55.3 --C0 31.5", "--bore 20 --outside 47 --width 14 --angle 15"),
)
COMMANDS = (
    *("film ball_on_disc --json", "film moes_20_10 --json", "film 6208_full_ceramic --json", "film 6208_with_heat"),
    *("hertz 6208_full_ceramic --json", "hertz 7008_axial", "frequencies 6208_full_ceramic --json"),
    *("frequencies 6304_planar", "list", "schema", f"import {GEARBOX}", "validate 6208_full_ceramic 7008_axial"),
    "run 6206_combined_1000N --json",
)


def answer(words, folder):
    """Both streams of a command and its exit code."""
    found = CliRunner().invoke(app, words.split(), env={"COLUMNS": "100"})
    if "--json" in words:
        return [found.exit_code, json.loads(found.stdout)]
    return [
        found.exit_code,
        f"{found.stdout}\n{found.stderr}".replace(str(folder), "").replace(str(GEARBOX.parent), ""),
    ]


def test_commands(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    kept("commands", {words.split("/")[0]: answer(words, tmp_path) for words in COMMANDS})


def test_new_cases(tmp_path, monkeypatch):
    """Texts and what they say, without and with speed and loads."""
    monkeypatch.chdir(tmp_path)
    found = []
    for number, bearing in enumerate(NEW):
        words = bearing if bearing.startswith("--") else f"--bearing {bearing}"
        for wish in ("", " --speed 7000 --radial 900 --axial 300")[number % 2 :]:
            name = f"case{number}{len(wish)}"
            told = answer(f"init {name} {words}{wish}", tmp_path)
            file = tmp_path / f"{name}.toml"
            found.append([told, file, load_case(file)] if file.exists() else [told])
    kept("new cases", found, floor=1e-15)


def test_shipped_cases():
    """All values as they are read, of every third."""
    shafts = [stem for stem, path in shipped_cases().items() if path.parent.name == "shaft"]
    cases = [load_shaft(stem) if stem in shafts else load_case(stem) for stem in sorted(shipped_cases())[::3]]
    kept("shipped cases", cases, floor=1e-15, without="/text|/path|/name$")


def test_batch(tmp_path):
    """Points, columns, data set, pictures and page of a sweep."""
    batch = run_batch(sweep_from_text(SWEEP, "sweep.toml"), tmp_path, HerePool)
    results = load_results(batch)
    with drawn() as pictures:
        write_batch(results, tmp_path)
    files = {path.name: path for path in tmp_path.iterdir() if path.suffix in (".csv", ".nc")}
    document = batch_summary(results)
    kept("batch", {"summary": document, "files": files, "pictures": pictures, "page": report_page(tmp_path)})


def test_rexs():
    """A drive: its listing, the cases of its shafts, and the sums of their forces."""
    found = drive(read_rexs(GEARBOX))
    texts = [shaft_text(found, number).replace(f"{GEARBOX.parent}", "") for number in (1, 2, 3, 4)]
    kept("drive", {"drive": [found.speeds, found.tangential, found.warnings], "texts": texts})


def test_slip(tmp_path):
    text = read_text(find_case("hirano_7000C")).replace("points = 51\n", "points = 3\ncritical_points = 2\n")
    path = tmp_path / "slip.toml"
    path.write_text(text, encoding="utf-8")
    results = run_slip(load_case(path), "slip", workers=1)
    with drawn() as pictures:
        write_slip(results, tmp_path / "out")
    kept("slip", {"summary": slip_summary(results), "files": tmp_path / "out", "pictures": pictures})
