"""`tools/verification/run.py`: page, sweep and exit codes; the page itself checks its numbers."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
from math import nan
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner
from verification.asymptotes import asymptotes
from verification.contacts import NAMED, from_groups, moes
from verification.draws import LARGEST_EXPONENT, LARGEST_PRESSURE, draws
from verification.limits import approach_formula
from verification.names import SectionName
from verification.page import Check, ForeignFileError, Section, Table, markdown, statements
from verification.rigid import half_kapitza, reynolds_over_sommerfeld
from verification.robustness import QUICK_OPTIONS, Finished, read_finished, strongest, sweep
from verification.robustness_page import robustness_section
from verification.run import app
from verification.sections import MAKERS, document

from oilfilm.ehl.closed_form.film import moes_film_nijenbanning
from oilfilm.ehl.conditions import moes_groups
from oilfilm.ehl.scaling import scale_contact

ROOT = Path(__file__).parents[2]
PAGES = ROOT / "docs" / "validation"


def call(*arguments):
    return CliRunner().invoke(app, list(arguments))


def silent(done, total, state):
    pass


def test_a_section_of_the_page(tmp_path):
    result = call("--quick", "--section", "same", "--section", "rigid", "-o", str(tmp_path), "--json")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["converged"] and not found["messages"]
    assert len(found["checks"]) >= 5 and all(check["passed"] for check in found["checks"])
    page = (tmp_path / "verification.md").read_text(encoding="utf-8")
    assert page.startswith("# Verification of the contact solver\n")
    assert page.count("\n## ") == 3  # checks, and the two sections in the order asked for
    assert page.index("posed in different ways") < page.index("Rigid surfaces")
    assert json.loads((tmp_path / "verification.json").read_text(encoding="utf-8")) == found


def test_a_statement_that_does_not_hold_ends_with_code_1(monkeypatch):
    checks = (Check(name="order", value=1.2, least=1.7), Check(name="limit", value=1.0, most=2.0))
    made_up = Section(title="Made up", text="Text.", checks=checks)
    monkeypatch.setattr("verification.sections.run_sections", lambda *arguments, **options: iter([made_up]))
    result = call("--quick", "--section", "same", "--json")
    assert result.exit_code == 1
    assert not json.loads(result.stdout)["converged"]
    assert "these statements do not hold:\n  order: 1.2, wanted" in result.stderr
    assert "limit" not in result.stderr


def test_the_quick_diagram_knows_the_powers_of_rigid_films(tmp_path):
    result = call("--quick", "--section", "moes", "-o", str(tmp_path), "--json")
    assert result.exit_code == 0, result.output
    assert all(check["passed"] for check in json.loads(result.stdout)["checks"])


def test_pictures_are_written(tmp_path):
    assert call("--quick", "--section", "hertz", "-o", str(tmp_path), "-q").exit_code == 0
    page = (tmp_path / "verification.md").read_text(encoding="utf-8")
    (name,) = re.findall(r"\]\((images/\S+)\)", page)
    assert (tmp_path / name).stat().st_size > 10_000


def test_every_section_has_a_maker():
    assert set(MAKERS) == set(SectionName)


def test_json_alone_writes_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert json.loads(call("--quick", "--section", "same", "--json").stdout)["converged"]
    assert not list(tmp_path.iterdir())


def test_a_foreign_page_is_not_replaced(tmp_path):
    (tmp_path / "verification.md").write_text("# Mine\n", encoding="utf-8")
    result = call("--quick", "--section", "same", "-o", str(tmp_path))
    assert result.exit_code == 2 and "not written by oilfilm" in result.stderr
    assert (tmp_path / "verification.md").read_text(encoding="utf-8") == "# Mine\n"


@pytest.mark.parametrize(
    "arguments",
    [("--section", "no"), ("--robustness", "0"), ("--seed", "7"), ("--robustness", "3", "--section", "same")],
)
def test_bad_options(arguments, tmp_path):
    assert call(*arguments, "-o", str(tmp_path)).exit_code == 2
    assert not list(tmp_path.iterdir())


def test_a_statement_that_does_not_hold_is_told():
    checks = (Check(name="one", value=2.0, most=1.0), Check(name="other", value=0.5, least=0.0, most=1.0))
    section = Section(title="T", text="text", checks=checks, tables=(Table(caption="C:", head=("a",), rows=(("b",),)),))
    found = document([section])
    assert not found["converged"]
    assert found["messages"] == ["one: 2, wanted at most 1"]
    page = markdown("Title", "", [section])
    assert "| one | **2** | at most 1 |" in page and "| other | 0.5 | 0 to 1 |" in page


def test_a_check_without_a_number_fails():
    check = Check(name="unknown", value=nan, least=0.0)
    assert not check.passed
    section = Section(title="T", text="", checks=(check,))
    assert document([section])["checks"][0]["value"] is None
    json.dumps(document([section]), allow_nan=False)


def test_si_conditions_have_the_groups_they_were_made_from():
    conditions = from_groups(moes(120.0, 7.0, 0.2, 0.3), rotation=0.25)
    assert_allclose(moes_groups(conditions), (120.0, 7.0), rtol=1e-12)
    contact = scale_contact(conditions)
    assert_allclose(contact.rotation * contact.semi_axis_ratio, 0.25, rtol=1e-12)  # at the end of the ellipse
    assert_allclose(contact.hertz_pressure, scale_contact(moes(120.0, 7.0, 0.2, 0.3)).hertz_pressure, rtol=1e-12)


def test_named_contacts_have_their_own_names():
    assert len({(contact.name, contact.box) for contact in NAMED}) == len(NAMED)


def test_asymptotes_are_those_of_the_whole_formula():
    """Far into a regime the blend of the four is that one; elastic-piezoviscous only slowly."""
    assert_allclose(moes_film_nijenbanning(1e-3, 0.0, 0.3), asymptotes(1e-3, 0.0, 0.3)["RI"], rtol=1e-3)
    assert_allclose(moes_film_nijenbanning(1e6, 0.0, 0.3), asymptotes(1e6, 0.0, 0.3)["EI"], rtol=1e-2)
    assert_allclose(moes_film_nijenbanning(1e4, 1e4, 0.3), asymptotes(1e4, 1e4, 0.3)["RP"], rtol=2e-2)
    assert_allclose(moes_film_nijenbanning(1e6, 20.0, 0.3), asymptotes(1e6, 20.0, 0.3)["EP"], rtol=5e-2)


def test_half_kapitza_carries_the_load():
    """The closed form against half of Kapitza's pressure, integrated on polar nodes; the rest goes with 1/radius."""
    conditions = moes(1.0, 0.0, 0.4)
    contact, film = scale_contact(conditions), half_kapitza(conditions)
    r, angle = np.linspace(0.0, 2000.0 * film**0.5, 200_001), np.linspace(-0.5 * np.pi, 0.5 * np.pi, 721)
    ray = np.trapezoid(r**2 / (film + 0.5 * r**2) ** 2, r) + 4.0 / r[-1]
    load = contact.speed / (3.0 + 0.8) / np.sqrt(0.4) * np.trapezoid(np.cos(angle), angle) * ray
    assert_allclose(load, contact.load, rtol=1e-4)


def test_direct_solution_of_the_rigid_contact_converges():
    """Reynolds' condition adds less than half to the film; halving the mesh twice moves it by 2 and by 1 % at most."""
    coarse, middle, fine = (reynolds_over_sommerfeld(1.0, cells, reach=100.0) for cells in (16, 32, 64))
    assert 1.0 < fine < 1.5
    assert abs(fine / middle - 1.0) < 0.01 < abs(middle / coarse - 1.0)


def test_direct_solution_of_a_long_rigid_contact_needs_no_more_than_sommerfeld():
    """Entrained along its long axis the oil leaves sideways: the pressure ends in the middle, as half of Kapitza's."""
    assert_allclose(reynolds_over_sommerfeld(100.0, 64), 1.0, atol=0.03)


def test_approach_of_a_heavily_loaded_contact_is_hertz():
    assert_allclose(approach_formula(1e7, 5.0), 1.0, atol=1e-3)
    assert approach_formula(20.0, 10.0) < approach_formula(200.0, 10.0) < 1.0


def test_draws_keep_their_ranges_and_repeat():
    some = draws(60, 8117)
    assert draws(20, 8117) == some[:20]
    assert draws(20, 8118) != some[:20]
    for draw in some:
        contact = scale_contact(draw.conditions)
        assert contact.hertz_pressure <= LARGEST_PRESSURE
        assert contact.hertz_pressure * draw.conditions.lubricant.pressure_viscosity <= LARGEST_EXPONENT
        assert 5.0 <= contact.moes_load <= (10_000.0 if contact.radius_ratio < 0.3 else 3000.0)
        assert contact.moes_lubricant <= 30.0 and 0.005 <= contact.radius_ratio <= 5.0
    assert {draw.kind for draw in some} == {"straight", "at an angle", "rotating"}


@pytest.mark.slow
def test_sweep_is_resumed(tmp_path):
    file = tmp_path / "robustness.jsonl"
    first = sweep(3, 5323, file, silent, QUICK_OPTIONS)
    text = file.read_text(encoding="utf-8")
    file.write_text(text + '{"number": 3, "te', encoding="utf-8")  # killed while it wrote
    seen = []
    more = sweep(5, 5323, file, lambda done, total, state: seen.append((done, total)), QUICK_OPTIONS)
    assert more[:3] == first  # the times, too: not solved again
    assert [f.number for f in more] == list(range(5))
    assert seen[0] == (3, 5) and seen[-1] == (5, 5)
    assert file.read_text(encoding="utf-8").startswith(text)
    assert {f.number: f for f in read_finished(file)} == {f.number: f for f in more}
    assert sweep(2, 5323, file, silent, QUICK_OPTIONS) == first[:2]


def test_sweep_refuses_the_file_of_another(tmp_path):
    file = tmp_path / "robustness.jsonl"
    sweep(1, 5323, file, silent, QUICK_OPTIONS)
    with pytest.raises(ForeignFileError, match="--seed 5323"):
        sweep(1, 5324, file, silent, QUICK_OPTIONS)
    file.write_text("something else\n", encoding="utf-8")
    with pytest.raises(ForeignFileError, match="no sweep"):
        sweep(1, 5323, file, silent, QUICK_OPTIONS)


def test_interrupted_sweep_keeps_what_is_finished(tmp_path, monkeypatch):
    from verification import robustness

    solve, count = robustness.solve_draw, []

    def interrupted(draw, options):
        count.append(draw)
        if len(count) == 4:
            raise KeyboardInterrupt
        return solve(draw, options)

    monkeypatch.setattr(robustness, "solve_draw", interrupted)
    result = call("--robustness", "9", "--seed", "5323", "--quick", "-o", str(tmp_path))
    assert result.exit_code == 3
    assert "the same command continues" in result.stderr
    assert 1 <= len(read_finished(tmp_path / "robustness.jsonl")) <= 8
    assert not (tmp_path / "robustness.md").exists()


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_an_interrupt_gives_up_the_contacts_under_way(tmp_path):
    """A film cannot be stopped; here each takes far longer than the patience of this test."""
    code = f"""
import os, sys, time
sys.path.insert(0, {str(ROOT / "tools")!r})
from verification import robustness, run
def slow(draw, points):
    os.write(1, b"up\\n")  # in one piece: print of two threads may mix
    time.sleep(600)
robustness.solve_draw = slow
sys.argv = ["run.py", "--robustness", "3", "--quick", "-o", {str(tmp_path)!r}]
run.main()
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout.readline() == b"up\n"
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    assert process.returncode == 3
    assert b"the same command continues" in errors
    assert errors.endswith(b"oilfilm: interrupted\n")


@pytest.mark.slow
def test_sweep_command(tmp_path):
    result = call("--robustness", "4", "--seed", "7741", "--quick", "-o", str(tmp_path), "--json")
    document = json.loads(result.stdout)
    assert result.exit_code == (0 if document["converged"] else 1)
    assert len(document["checks"]) == 6 and document["checks"][1]["passed"]  # nothing unsound goes unsaid
    assert (tmp_path / "images" / "robustness.png").stat().st_size > 10_000
    assert "4 contacts, seed 7741" in (tmp_path / "robustness.md").read_text(encoding="utf-8")


def finished(**changes):
    given = {
        "number": 0,
        "text": "a contact",
        "kind": "straight",
        "moes_load": 100.0,
        "moes_lubricant": 10.0,
        "radius_ratio": 0.5,
        "hertz_pressure": 1e9,
        "points": 257,
        "converged": True,
        "resolved": True,
        "fineness": 40.0,
        "measures": (),
        "residual": 1e-4,
        "seconds": 1.0,
        "message": "converged",
        "films": (0.1, 0.001, 0.05, 0.001),
        "check": (0.1005, 0.0002, 0.0499, 0.0002),
    }
    return Finished(**(given | changes))


def test_outcomes_are_counted():
    draws = [
        finished(),
        finished(points=513, measures=("cycle undone, damping halved",)),
        finished(points=1025, resolved=False, fineness=2.0, message="converged but unresolved"),
        finished(points=1025, converged=False, fineness=30.0, measures=("some attempt",), message="not converged"),
        finished(points=1025, converged=False, resolved=False, fineness=None, message="diverged"),
        finished(points=1025, converged=False, resolved=False, fineness=3.0, message="not converged"),
    ]
    assert [d.resolvable for d in draws] == [True, True, False, True, True, False]
    section = robustness_section(draws, 1)
    share, quiet, time, covered, wrong = section.checks
    assert_allclose(share.value, 2 / 4)
    assert not share.passed and quiet.passed and time.passed and covered.passed and wrong.passed
    outcomes = {row[0]: row[1:] for row in section.tables[0].rows}
    assert outcomes["converged and resolved, resolvable"] == ("1", "1", "0", "2")
    assert outcomes["failed, resolvable"] == ("0", "0", "2", "2")
    assert outcomes["failed, too thin to resolve, or outside the model"] == ("0", "0", "1", "1")
    failures = {message: (count, numbers) for message, count, _, numbers in section.tables[-1].rows}
    assert failures["not converged"] == ("2", "0, 0")
    assert sum(int(count) for count, _ in failures.values()) == 4


def test_films_are_judged_by_the_check():
    """Errors 0.5 % and 0.2 % in bars of 1 % and 2 %; then a central film wrong by 9 %, with a bar of 1 %."""
    right, wrong = finished(), finished(check=(0.11, 0.0002, 0.0499, 0.0002))
    assert_allclose(right.errors, [(0.0005 / 0.1005, 0.001 / 0.1005), (0.0001 / 0.0499, 0.001 / 0.0499)])
    assert finished(check=None).errors == ()
    *_, covered, far = robustness_section([right, wrong], 1).checks
    assert (covered.value, far.value) == (0.75, 1)
    assert not covered.passed and not far.passed


def test_a_draw_that_fails_silently_fails_the_sweep():
    _, quiet, *_ = robustness_section([finished(converged=False, message="converged")], 1).checks
    assert not quiet.passed


def test_the_strongest_measure_is_the_last_attempt():
    assert strongest(()) == "none"
    assert strongest(("cycle undone, damping halved",)) == "damping halved in passing"
    assert strongest(("first attempt", "second attempt", "cycle undone, damping halved")) == "second attempt"


DECIMAL = re.compile(r"(?<![\w.])[-+]?\d+(?:\.(\d+))?(?:e[-+]?\d+)?")
WAVERING = ("p", "off/bar", "difference")  # columns that the last cycles decide


def same_numbers(ours, theirs):
    """To 1 %, or to two of the last digit printed."""
    pairs = list(zip(DECIMAL.finditer(ours), DECIMAL.finditer(theirs), strict=True))
    return all(
        abs(float(a[0]) - float(b[0])) <= max(0.01 * abs(float(b[0])), 2.0 * 10.0 ** -len(b[1] or "")) for a, b in pairs
    )


def test_numbers_of_a_page_are_compared_with_care():
    assert same_numbers("0.4309 ± 0.0005", "0.4310 ± 0.0004")
    assert not same_numbers("0.4309", "0.4360")
    assert not same_numbers("117", "121")


def test_the_page_of_random_contacts_is_that_of_its_file():
    """The page in the docs is made from the draws beside it."""
    drawn = sorted(read_finished(PAGES / "robustness.jsonl"), key=lambda f: f.number)
    assert len(drawn) >= 300
    page = (PAGES / "robustness.md").read_text(encoding="utf-8")
    seed = json.loads((PAGES / "robustness.jsonl").read_text(encoding="utf-8").splitlines()[0])["seed"]
    for table in robustness_section(drawn, seed).tables:
        for row in table.rows:
            assert "| " + " | ".join(row) + " |" in page


def test_an_interrupted_page_keeps_its_finished_sections(tmp_path, monkeypatch):
    finished = Section(title="Kept", text="A section.", tables=(), checks=(), pictures=())

    def interrupted(names, progress, run_bearing, *, quick):
        yield finished
        raise KeyboardInterrupt

    monkeypatch.setattr("verification.sections.run_sections", interrupted)
    for target in ("page", "page_interrupted"):
        answer = CliRunner().invoke(app, ["-q", "-o", str(tmp_path / "page")])
        assert answer.exit_code == 3
        assert f"finished sections in {tmp_path / target}" in answer.stderr.replace("\n", "")
        assert "Kept" in (tmp_path / target / "verification.md").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in SectionName if name is not SectionName.COST])
def test_the_page_in_the_docs_is_up_to_date(name, monkeypatch):
    """Also on another day than that of the page, whose random contacts are drawn again."""
    from verification.sections import run_sections

    text = (PAGES / "verification.md").read_text(encoding="utf-8")
    (seed,) = re.findall(r"drawn by seed (\d+):", text)
    monkeypatch.setattr("verification.elements.seed_of_today", lambda: int(seed))
    (section,) = run_sections([name], silent)
    (kept,) = [one for one in numbers()["sections"] if one["title"] == section.title]
    for table, written in zip(section.tables, kept["tables"], strict=True):
        steady = [column not in WAVERING for column in table.head]
        assert list(table.head) == written["head"]
        for row, known in zip(table.rows, written["rows"], strict=True):
            for ours, theirs, compared in zip(row, known, steady, strict=True):
                assert not compared or same_numbers(ours, theirs), f"{theirs} has become {ours}"
    assert all(check.passed for check in section.checks)


def numbers():
    return json.loads((PAGES / "verification.json").read_text(encoding="utf-8"))


def test_the_rows_of_the_page_are_of_its_numbers():
    """The page prints some of them."""
    text = (PAGES / "verification.md").read_text(encoding="utf-8")
    tables = [table for section in numbers()["sections"] for table in section["tables"]]
    known = [[*table["head"]] for table in tables] + [row for table in tables for row in table["rows"]]
    checks = [Check(**{key: check[key] for key in ("name", "value", "least", "most")}) for check in numbers()["checks"]]
    known += [["statement", "found", "wanted"], *statements(checks)]
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    assert len(lines) > 50
    assert set(lines) <= {"| " + " | ".join(row) + " |" for row in known}
