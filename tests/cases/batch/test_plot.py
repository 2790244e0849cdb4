"""The key `plot` of sweep files: which numbers a batch draws."""

from __future__ import annotations

import pytest
from matplotlib.figure import Figure
from typer.testing import CliRunner

from cases.batch.engine import run_batch
from cases.batch.results import gathered
from cases.batch.sweep import read_sweep, sweep_from_text
from cases.cli.main import app
from cases.format.shipped import shipped_sweeps
from postprocess.batch.plots import draw_together, quantities, varied_keys
from postprocess.batch.summary import results_as_columns
from postprocess.main_results import result_names

from .test_batch import HerePool

TEXT = """\
case = "6206_radial_500N"
plot = ["torque_N_mm.models.skf.sliding", "torque_N_mm.models.skf_as_printed.sliding"]
[sweep]
"operation.radial_load_N" = [500.0, 1000.0]
"operation.inner_speed_rpm" = [500.0, 5000.0, 15000.0]
"""


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plot")
    return gathered(run_batch(sweep_from_text(TEXT, "sweep.toml"), folder, HerePool))


def test_the_lines_of_the_figure_are_the_numbers_asked_for(results):
    """Sliding moments of Table 3, N mm: printed values are half of the true ones."""
    shown = quantities(results)
    assert shown == list(results.plot)
    figure = Figure()
    draw_together(figure, results, varied_keys(results), shown)
    assert [axes.get_title() for axes in figure.axes] == ["radial load 500 N", "radial load 1000 N"]
    true, printed = (line.get_ydata() for line in figure.axes[0].get_lines()[:2])
    assert printed == pytest.approx([1.7574, 0.9400, 0.9400], abs=1e-4)
    assert true == pytest.approx(2.0 * printed, rel=1e-4)
    assert figure.axes[0].get_ylabel() == "torque [N mm]"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["SKF, sliding", "SKF, as printed, sliding"]


def test_known_names_are_columns_of_the_table(results):
    """All that has a number in the table and is torque or main result can be drawn; nothing else is."""
    known, table = result_names("run"), results_as_columns(results)
    torques = {name for name in table if name.startswith("torque_N_mm.models.")}
    assert torques <= set(known)
    assert {"film_minimum_um", "self_heating.temperature_C", "torque_N_mm.models.integrated.total"} <= set(known)
    assert len(known) == len(set(known))


@pytest.mark.parametrize("kind", ["contact", "slip", "dynamics", "table"])
def test_other_kinds_have_names_of_their_own(kind):
    assert result_names(kind)
    assert not any(name.startswith("torque") for name in result_names(kind))


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        ('"torque_N_mm.models.skf.slidng"', "did you mean 'torque_N_mm.models.skf.sliding'"),
        ('"skf.sliding"', "did you mean 'torque_N_mm.models.skf.sliding'"),
        ('"slip_factor_minimum"', "allowed: main results"),
        ('"cage_speed_rpm", "cage_speed_rpm"', "twice"),
        ('"film_minimum_um", "torque_N_mm", "torque_N_mm.total"', "all in one unit"),
        ("7", "plot"),
    ],
)
def test_unknown_numbers_are_told(tmp_path, monkeypatch, names, expected):
    monkeypatch.chdir(tmp_path)
    lines = TEXT.splitlines()
    (tmp_path / "wrong.toml").write_text("\n".join([lines[0], f"plot = [{names}]", *lines[2:]]))
    for command in ("batch", "validate"):
        answer = CliRunner().invoke(app, [command, "wrong.toml"])
        assert answer.exit_code == 2
        assert "wrong.toml:2: " in answer.output
        assert expected in " ".join(answer.output.split())
    assert not (tmp_path / "wrong_results").exists()


def test_sizes_that_grow_together_are_one_key():
    """The seven keys of the 6206, 6207 and 6208."""
    sweep = read_sweep("6206_to_6208_axial")
    assert len(sweep.keys) == 7
    assert [key.label for key in varied_keys(sweep)] == ["ball diameter [mm]"]


def test_sweeps_of_sliding_friction_draw_sliding_friction():
    found = {name: read_sweep(name).plot for name in shipped_sweeps() if name.startswith("6206")}
    assert len(found) == 5
    assert all("torque_N_mm.models.skf.sliding" in plot for plot in found.values())
    assert not any("torque_N_mm.models.skf.total" in plot for plot in found.values())
