"""`oilfilm table`: its file, plots, summary and exit codes; the physics is tested in tests/ehl/traction."""

from __future__ import annotations

import json
import math
import tomllib
from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm.bearing.friction.tables import load_tables
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.cases.batch.shared_tables import bodies_and_oil
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_of_document, load_case
from oilfilm.cases.format.traction import tables_of_file
from oilfilm.cases.runs.traction_table import run_table
from oilfilm.ehl.traction_table.build import TableOptions
from oilfilm.ehl.traction_table.table import FullSolve
from oilfilm.postprocess.traction.results import TractionResults, full_solve_entry, traction_summary

from ...reference.ehl.traction import largest_force
from ..made_up_tables import made_up_tables


def call(*arguments):
    return CliRunner().invoke(app, ["table", *arguments])


EASY = {"tolerance": 0.5, "check_films": 2, "check_motions": 20, "rounds": 1, "nodes": (4, 4, 15, 7, 9)}


@pytest.fixture
def quick(monkeypatch):
    """Few films and motions, an easy tolerance."""

    def few(**chosen):
        return TableOptions(**{**chosen, **EASY})

    monkeypatch.setattr("oilfilm.cases.runs.traction_table.TableOptions", few)


# its loads and speeds are those of which the film atlas has fields; its heaviest contacts and no light ones
LOADED = """schema_version = 1
[bearing]
name = "7012AC"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 6000.0
axial_load_N = 3000.0
temperature_C = 60.0
[ehl]
film_maps = "none"
[friction]
table_films = "atlas"
"""


def test_films_of_the_atlas_are_told(quick, monkeypatch, tmp_path):
    solved = []
    monkeypatch.setattr("oilfilm.cases.cli.compute._film_sampler", lambda path: nullcontext(solved.append))
    path = tmp_path / "loaded.toml"
    path.write_text(LOADED)
    found = call(str(path), "--json")
    assert found.exit_code == 0, found.stderr
    messages = json.loads(found.stdout)["messages"]
    for race in ("inner", "outer"):
        assert f"{race} race: converged; 20 of 20 films by the film atlas" in messages  # two in doubt
    assert not solved


def test_the_table_that_a_case_names_is_made_without_it(quick, monkeypatch, tmp_path):
    """Missing or of an older format, other commands refuse it in one line that tells the command which makes it."""
    path = tmp_path / "own.zip"
    case = tmp_path / "own.toml"
    case.write_text(f'{LOADED}traction = "table"\ntraction_table = "{path}"\n')

    def refused(finding):
        for command in (["run", str(case), "--json"], ["validate", str(case)]):
            found = CliRunner().invoke(app, command)
            assert found.exit_code == 2
            (line,) = found.stderr.strip().splitlines()
            assert finding in line
            assert f"`oilfilm table CASE -o {path}`" in line

    refused("there is no such file")
    assert call(str(case), "-o", str(path), "-q").exit_code == 0
    equilibrium = load_case(case)  # takes it
    assert set(equilibrium.traction.source.laws) == set(Race)
    made = path.read_bytes()
    monkeypatch.setattr("oilfilm.ehl.traction_table.storage.FORMAT_VERSION", 11)
    refused("format version 10, this program reads 11")
    found = call(str(case), "-o", str(path), "-q")
    assert found.exit_code == 0, found.stderr
    assert path.read_bytes() != made
    assert load_tables(path)[Race.INNER].contact == equilibrium.traction.source.laws[Race.INNER].contact


def test_points_with_films_of_the_atlas_have_tables_of_their_own(tmp_path):
    path = tmp_path / "loaded.toml"
    path.write_text(LOADED)
    other = tmp_path / "solved.toml"
    other.write_text(LOADED.replace('"atlas"', '"solved"'))
    assert bodies_and_oil(load_case(str(path))) != bodies_and_oil(load_case(str(other)))


@pytest.mark.slow
def test_table_by_the_atlas_is_the_solved_one():
    """Both races of a bearing of no shipped case, 100 random motions each."""
    tables = {}
    for films in ("atlas", "solved"):
        document = tomllib.loads(LOADED.replace('"atlas"', f'"{films}"'))
        document["operation"] |= {"axial_load_N": 2200.0, "inner_speed_rpm": 8000.0}
        case = case_of_document(document)
        tables[films] = run_table(case).tables
    rng = np.random.default_rng(11)
    for race, solved in tables["solved"].items():
        own = tables["atlas"][race]
        for _ in range(100):
            load, speed = (np.exp(rng.uniform(*np.log(ends))) for ends in (solved.range.load, solved.range.speed))
            ratio, angle = 10.0 ** rng.uniform(-3.0, 0.0), rng.uniform(0.0, 2.0 * np.pi)
            spin = rng.uniform(-0.3, 0.3) * speed / solved.contact.radius_x
            motion = (ratio * speed * np.cos(angle), 0.5 * ratio * speed * np.sin(angle), spin)
            one, other = (np.array(table.forces(load, speed, *motion)[:2]) for table in (own, solved))
            assert np.hypot(*(one - other)) < 0.01 * largest_force(solved, load, speed)


@pytest.mark.slow
def test_table_plots_and_summary(quick, tmp_path):
    path = tmp_path / "table.zip"
    found = call("6208_full_ceramic", "-o", str(path), "--points", "129", "--full-solves", "1", "--json")
    assert found.exit_code == 0, found.stderr
    assert {file.name for file in tmp_path.iterdir()} == {"table.zip", "table_curves.png", "table_map.png"}
    document = json.loads(found.stdout)
    assert document["converged"]
    assert any("assumed" in message for message in document["messages"])
    for race, table in load_tables(path).items():
        told = document["tables"][race.value]
        assert told["films"] == table.films == 16 + table.error.films
        assert told["load_N"] == list(table.range.load)
        assert 0.0 < told["error"]["rms"] < told["error"]["largest"]
        (beside,) = told["full_solves"]
        assert [one.in_full for one in table.full_solves] == [beside["coefficient_in_full"]]
        assert beside["converged"]
        assert 0.5 < beside["coefficient_in_full"] / beside["coefficient_by_table_film"] < 1.0
    assert set(document["tables"]) == {race.value for race in Race}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("ball_on_disc",), "is a single contact"),
        (("6208_full_ceramic", "--points", "100"), "2^k + 1"),
        (("6208_full_ceramic", "--temperatures", "40,60"), "the viscosity at one temperature only"),
        (("6208_oil_temperature", "--temperatures", "60,40"), "two or more rising numbers"),
        (("6208_oil_temperature", "--temperatures", "warm"), "two or more rising numbers"),
        (("6208_full_ceramic", "-o", "no/such/folder/table.zip"), "cannot be written"),
    ],
)
def test_bad_input(arguments, told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = call(*arguments)
    assert found.exit_code == 2
    assert told in found.stderr
    assert list(tmp_path.iterdir()) == []


def tables_at(path, oil):
    """Tables of both races for an oil, from a file with several temperatures."""
    return tables_of_file(path)(oil)


@pytest.mark.slow
def test_tables_over_the_temperature(quick, tmp_path):
    """Saved with all temperatures, read for the oil of a case between them, refused for another oil."""
    path = tmp_path / "table.zip"
    found = call(
        "6208_oil_temperature", "-o", str(path), "--points", "129", "--json", "--temperatures", "40,60", "--quiet"
    )
    assert found.exit_code in (0, 1), found.stderr  # films on so few points need not all converge
    told = json.loads(found.stdout)["tables"]["inner"]
    assert told["temperatures_K"] == [313.15, 333.15]
    assert len(told["largest_error_between"]) == 1
    oil = load_lubricant("iso vg 32", 328.15)
    for table in tables_at(path, oil).values():
        assert table.contact.lubricant == oil
        assert table.contact.temperature == 328.15
    with pytest.raises(ValueError, match="made for another oil: its viscosity"):
        tables_at(path, load_lubricant("iso vg 68", 328.15))
    with pytest.raises(ValueError, match=r"temperature must lie within 313\.15 to 333\.15 K"):
        tables_at(path, load_lubricant("iso vg 32", 350.0))
    path.write_bytes(path.read_bytes()[:-2000])
    with pytest.raises(ValueError, match="damaged"):
        tables_at(path, oil)


def test_full_solves_that_do_not_converge_are_told():
    """None for what is no number, a message, and the result as a whole is flagged."""
    places = {"load": 50.0, "speed": 10.0, "slide_ratio": 0.01}
    good = FullSolve(**places, by_film=0.02, in_full=0.01, film_ratio=0.9, converged=True)
    lost = FullSolve(**places, by_film=0.02, in_full=math.nan, film_ratio=math.nan, converged=False)
    tables = made_up_tables(load_case("6208_full_ceramic"))
    inner = replace(tables[Race.INNER], full_solves=(good,))
    results = TractionResults(version="1", case={}, tables=tables | {Race.INNER: inner})
    assert traction_summary(results)["converged"]
    inner = replace(inner, full_solves=(good, lost))
    told = traction_summary(replace(results, tables=tables | {Race.INNER: inner}))
    assert not told["converged"]
    assert any("inner race: the full solve at 50 N" in message for message in told["messages"])
    assert full_solve_entry(lost) == {
        "load_N": 50.0,
        "entrainment_speed_m_s": 10.0,
        "slide_roll_ratio": 0.01,
        "coefficient_by_table_film": 0.02,
        "coefficient_in_full": None,
        "film_ratio": None,
        "converged": False,
    }
