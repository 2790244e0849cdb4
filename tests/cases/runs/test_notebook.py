"""What notebooks show of results: `_repr_html_`, with the numbers of the results themselves, without IPython."""

from __future__ import annotations

import re
import sys
from dataclasses import replace
from xml.etree import ElementTree

from oilfilm import ehl
from oilfilm.cases import load_case, run_case
from oilfilm.cases.batch.engine import run_batch
from oilfilm.cases.batch.results import load_results
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.runs.contact import run_contact
from oilfilm.ehl.units import from_si, notebook_html, value_with_error

from ..batch.test_batch import HerePool

SWEEP = """case = "6208_full_ceramic"
[fixed]
"ehl.film_maps" = "none"
[sweep]
"operation.radial_load_N" = [1000, 2000]
"""


def cells(html):
    """Text of every cell, by rows; an error if a tag is not closed."""
    tree = ElementTree.fromstring(f"<div>{html.replace('<br>', '<br/>')}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in tree.iter("tr")]


def test_values_are_shown_in_the_unit_of_their_keys():
    facts = {"film_minimum_um": (2.5e-7, 1e-8), "load_N": None, "a < b": "<&>"}
    assert cells(notebook_html("T", facts, {"speed_rpm": [1.0471975511965976]})) == [
        ["film minimum", "0.250 ± 0.010 µm"],
        ["load", "–"],
        ["a < b", "<&>"],
        ["speedr/min"],
        ["10"],
    ]


def test_a_contact_shows_its_films_with_their_bars():
    case = load_case("ball_on_disc")
    results = run_contact(replace(case, solver=ehl.SolverOptions(points=65)))
    solution = results.solution
    film = from_si("film_um", solution.film_minimum), from_si("film_um", solution.film_minimum_uncertainty)
    for shown in (solution, results):
        rows = dict(row for row in cells(shown._repr_html_()) if len(row) == 2)
        assert rows["film minimum"] == f"{value_with_error(*film)} µm"
    failed = replace(solution, converged=False, message="too few")
    rows = dict(cells(failed._repr_html_()))
    assert rows["film minimum"] == "–" and rows["converged"] == "False: too few"


def test_a_bearing_shows_balls_films_and_torque():
    results = run_case(replace(load_case("6208_full_ceramic"), film_maps="none"), 1)
    rows = cells(results._repr_html_())
    assert len([row for row in rows if row[2:3] == ["inner"]]) == 9
    assert ["friction torque", f"{1e3 * results.torque.total:.5g} N mm"] in rows
    assert any(re.fullmatch(r"0\.\d+ ± 0\.\d+", row[-1]) for row in rows)
    state = results.quasistatic
    rows = cells(state._repr_html_())
    assert rows[-9][:3] == ["1", "0", f"{state.inner_load[0]:.5g}"]
    rows = cells(results.torque._repr_html_())
    assert f"{results.torque.chosen} (taken)" in {row[0] for row in rows}


def test_a_batch_shows_its_points(tmp_path):
    batch = run_batch(sweep_from_text(SWEEP, "sweep.toml"), tmp_path / "out", HerePool)
    assert ["points", "2, 0 of them taken over"] in cells(batch._repr_html_())
    rows = cells(load_results(batch)._repr_html_())
    assert [row[1] for row in rows if row[-1] == "converged" and len(row) > 2] == ["1000", "2000"]
    assert "IPython" not in sys.modules
