"""All numbers of made-up bearings and single contacts: summary, files and pictures, as they were; see `tests/kept.py`."""

from __future__ import annotations

from dataclasses import replace

import pytest

from oilfilm.cases import load_case, run_case, run_contact
from oilfilm.cases.format.case import case_from_text
from oilfilm.postprocess import summary
from oilfilm.postprocess.writer import write_results

from ..cases.runs.changed_cases import text
from ..cases.runs.made_up_cases import CASES
from ..kept import drawn, kept

WITH_FILES = ("angular contact", "pair", "supplied")
CONTACTS = ("ball_on_disc", "ball_on_disc_starved", "squalane_ball_on_disc", "coated_steel", "moes_20_10")
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


@pytest.mark.parametrize("stem", CONTACTS)
def test_contacts(stem, tmp_path):
    case = load_case(stem)
    results = run_contact(replace(case, solver=replace(case.solver, points=33, tolerance=None)))
    with drawn() as pictures:
        write_results(results, tmp_path)
    kept(f"contact, {stem}", {"summary": summary(results), "files": tmp_path, "pictures": pictures}, SOLVED)
