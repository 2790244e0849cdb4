"""A batch of the program before points stood in SQLite files, kept as it was written: a JSON file a point."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import pytest
from typer.testing import CliRunner

from oilfilm.cases.batch.engine import PointSelection, run_batch
from oilfilm.cases.batch.results import load_results
from oilfilm.cases.batch.sweep import read_sweep
from oilfilm.cases.cli.main import app
from oilfilm.postprocess import open_results
from oilfilm.postprocess.batch.store import read_batch

from .test_batch import HerePool

ARCHIVE = Path(__file__).with_name("batch_of_files.zip")
LOADS = [10.0, 15.0, 20.0]


@pytest.fixture
def old(tmp_path):
    """The folder, with three points of the ball on disc on 33 nodes, two of which did not converge."""
    with zipfile.ZipFile(ARCHIVE) as archive:
        archive.extractall(tmp_path / "old")
    assert len(list((tmp_path / "old" / "points").glob("*.json"))) == 3
    return tmp_path / "old"


def test_its_points_are_read_with_their_summaries(old):
    results = read_batch(old)
    assert [point.values["contact.load_N"] for point in results.points] == LOADS
    assert [point.converged for point in results.points] == [True, False, False]
    first = results.points[0].summary
    written = json.loads((old / "points" / f"{results.points[0].key}.json").read_text())["summary"]
    assert first == written and first["film_minimum_um"] > 0.0
    assert open_results(old)["film_minimum_um"].values[0] == pytest.approx(first["film_minimum_um"])


def test_commands_read_it(old):
    runner = CliRunner()
    folder = str(old)
    for words, code in ((["report", folder], 0), (["diagram", folder], 0), (["compare", folder, folder], 1)):
        answer = runner.invoke(app, words)  # compare: there are points that did not converge
        assert answer.exit_code == code, (words, answer.stderr)


def test_its_points_are_not_taken_over_and_not_lost(old):
    sweep = read_sweep(old / "sweep.toml")
    batch = run_batch(sweep, old, HerePool, PointSelection(resume=True))
    assert not batch.resumed  # of another program
    assert [point.status for point in load_results(batch).points] == ["done"] * 3
    assert len(list((old / "points").glob("*.json"))) == 3
