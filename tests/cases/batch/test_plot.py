"""The key `plot` of sweep files: which numbers a batch draws."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace
from io import StringIO

import pytest
from matplotlib.figure import Figure
from rich.console import Console
from typer.testing import CliRunner

from oilfilm.cases.batch.engine import run_batch
from oilfilm.cases.batch.results import load_results
from oilfilm.cases.batch.sweep import read_sweep, sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.shipped import shipped_sweeps
from oilfilm.postprocess.batch.packed_columns import InMemory, columns_of
from oilfilm.postprocess.batch.plots import draw_batch, draw_together, quantities, write_diagram
from oilfilm.postprocess.batch.results import (
    BatchPoint,
    BatchResults,
    Varied,
    families,
    result_names,
    thinnest_film,
    varied_keys,
)
from oilfilm.postprocess.batch.store import PointStore, read_batch, record_of
from oilfilm.postprocess.batch.summary import batch_summary, batch_table
from oilfilm.postprocess.files import write_json
from oilfilm.postprocess.report.batch import listed_points

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
    return load_results(run_batch(sweep_from_text(TEXT, "sweep.toml"), folder, HerePool))


@pytest.mark.slow
def test_the_lines_of_the_figure_are_the_numbers_asked_for(results):
    """Sliding moments of Table 3, N mm: printed values are half of the true ones."""
    shown = quantities(results)
    assert shown == list(results.plot)
    figure = Figure()
    draw_together(figure, results, list(varied_keys(results).values()), shown)
    assert [axes.get_title() for axes in figure.axes] == ["radial load 500 N", "radial load 1000 N"]
    true, printed = (line.get_ydata() for line in figure.axes[0].get_lines()[:2])
    assert printed == pytest.approx([1.7574, 0.9400, 0.9400], abs=1e-4)
    assert true == pytest.approx(2.0 * printed, rel=1e-4)
    assert figure.axes[0].get_ylabel() == "torque [N mm]"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["SKF, sliding", "SKF, as printed, sliding"]


def test_known_names_are_columns_of_the_table(results):
    """All that has a number in the table and is torque or main result can be drawn; nothing else is."""
    known, table = result_names("run"), columns_of(InMemory(results)).names
    torques = {name for name in table if name.startswith("torque_N_mm.models.")}
    assert torques <= set(known)
    assert {"film_minimum_um", "self_heating.temperature_C", "torque_N_mm.models.integrated.total"} <= set(known)
    assert len(known) == len(set(known))


@pytest.mark.parametrize("kind", ["contact", "slip", "dynamics", "vibration", "table"])
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


def made_up(keys):
    """Points of a made-up sweep with a film that follows from the three keys, life by load alone."""
    points = []
    for number, (speed, load, temperature) in enumerate(keys, 1):
        film = {"film_minimum_um": speed / (load * temperature), "film_minimum_uncertainty_um": 0.0}
        ball = {"loaded": True, "load_N": load, "hertz_pressure_GPa": 1.0, "converged": True, **film}
        life = {"basic_reference_rating_Mrev": 1e9 / load**3}
        values = {
            "operation.temperature_C": temperature,
            "operation.radial_load_N": load,
            "operation.inner_speed_rpm": speed,
        }
        point = BatchPoint(
            number=number,
            block="sweep",
            values=values,
            case={},
            key=str(number),
            resumed=False,
            status="done",
            message="",
            summary={"contacts": [ball], "life": life, "converged": True},
        )
        points.append(point)
    return BatchResults(version="1", title="made up", case="case", sweep="", keys=tuple(values), points=tuple(points))


THREE = made_up([(n, f, t) for n in (1e3, 2e3, 4e3) for f in (100.0, 300.0, 900.0) for t in (40.0, 60.0, 80.0)])


def test_three_keys_are_told_apart():
    """Over the speed a line for each load and temperature, by colour and by style."""
    keys = list(varied_keys(THREE).values())
    assert keys[0].label == "inner speed [r/min]"
    assert quantities(THREE) == ["film_minimum_um", "basic_reference_rating_Mrev", "hertz_pressure_maximum_GPa"]
    figure = Figure()
    draw_batch(figure, THREE, keys, quantities(THREE))
    lines = [line for line in figure.axes[0].get_lines() if len(line.get_xdata()) == 3]
    looks = {(str(line.get_color()), line.get_linestyle(), line.get_marker()) for line in lines}
    assert len(looks) == 9
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "temperature [°C]" in words and "radial load [N]" in words and "900" in words
    assert figure.axes[0].get_yscale() == "log"
    assert "further keys" not in figure.get_supxlabel()


def test_a_fourth_key_shares_the_styles_or_is_named():
    fourth = Varied(label="clearance [µm]", values=tuple(map(float, range(27))))
    keys = [*varied_keys(THREE).values()]
    assert len(families([*keys, fourth])) == 4  # 27 styles are too many
    two = replace(keys[2], values=tuple(float(v == 80.0) for v in keys[2].values))
    assert families([keys[0], keys[1], two, replace(fourth, values=two.values)])[2].count == 2


@pytest.mark.parametrize(
    ("loads", "temperatures", "lines", "hidden"),
    [(3, 5, 15, ""), (5, 3, 15, ""), (5, 5, 0, "further keys vary"), (8, 2, 16, ""), (2, 40, 0, "further keys vary")],
)
def test_any_number_of_values_can_be_drawn(loads, temperatures, lines, hidden):
    """As colours and styles in turn where one of them has few values, else as points; of what is not told the name."""
    sweep = made_up(
        [
            (speed, 100.0 * 1.4**load, 40.0 + temperature)
            for speed in (1e3, 2e3, 4e3)
            for load in range(loads)
            for temperature in range(temperatures)
        ]
    )
    figure = Figure()
    draw_batch(figure, sweep, list(varied_keys(sweep).values()), ["film_minimum_um"])
    drawn = [line for line in figure.axes[0].get_lines() if len(line.get_xdata()) > 1]
    looks = {(str(line.get_color()), line.get_linestyle(), line.get_marker()) for line in drawn}
    assert len(drawn) == len(looks) == lines
    assert (hidden in figure.get_supxlabel()) if hidden else ("further" not in figure.get_supxlabel())


@pytest.mark.parametrize("over", [("temperature_C", "radial_load_N"), ()])
def test_diagrams_of_a_finished_batch(tmp_path, over):
    with closing(PointStore(tmp_path / "points.sqlite")) as store:
        for point in THREE.points:
            store.put(record_of(point.key, point.summary))
    write_json(batch_summary(THREE), tmp_path / "summary.json")
    read = read_batch(tmp_path)
    assert [point.values for point in read.points] == [point.values for point in THREE.points]
    for name in ("picture.png", "picture.pdf"):
        assert write_diagram(read, tmp_path / name, over).stat().st_size > 1000
    with pytest.raises(ValueError, match=r"did you mean 'operation\.radial_load_N'"):
        write_diagram(read, tmp_path / "picture.png", ("radial_load",))
    with pytest.raises(ValueError, match=r"allowed: a file that ends in \.png, \.pdf, \.svg"):
        write_diagram(read, tmp_path / "picture.jpg")


def test_lives_are_hours_without_powers_of_ten():
    """In the terminal, where they go before the largest load, and in the report."""
    life = {"basic_reference_rating_h": 27_123_456.0, "modified_reference_rating_h": 1.2345e9}
    points = tuple(replace(point, summary={**(point.summary or {}), "life": life}) for point in THREE.points)
    results = replace(THREE, points=points)
    terminal = Console(width=80, file=StringIO())
    terminal.print(batch_table(batch_summary(results)))
    text = terminal.file.getvalue()
    assert "L10mh" in text and "1234000000" in text and "Q max" not in text
    assert max(len(line.rstrip()) for line in text.splitlines()) <= 80
    page = listed_points(batch_summary(results))
    assert "modified rating life L10mh<small>h</small>" in page
    assert "<td>1234000000</td>" in page and "<td>27120000</td>" in page


def test_the_thinnest_film_is_unknown_where_one_failed():
    thick = {"loaded": True, "converged": True, "film_minimum_um": 9.0, "load_N": 50.0}
    failed = {"loaded": True, "converged": False, "film_minimum_um": None, "load_N": 1.0}
    assert thinnest_film([thick, failed]) is None
    assert thinnest_film([thick, {**failed, "converged": None}]) == thick  # no film was asked for


def test_the_thinnest_film_is_unknown_where_a_heavier_contact_has_none():
    """Beyond the loads of the film atlas; that of the lightest contact would stand for the bearing."""
    light = {"loaded": True, "converged": None, "film_minimum_um": 0.078, "load_N": 37.0}
    heavy = {"loaded": True, "converged": None, "film_minimum_um": None, "load_N": 2030.0}
    assert thinnest_film([heavy, light]) is None
    assert thinnest_film([{**heavy, "film_minimum_um": 0.046}, light])["load_N"] == 2030.0


def test_sizes_that_grow_together_are_one_key():
    """The seven keys of the 6206, 6207 and 6208."""
    sweep = read_sweep("6206_to_6208_axial")
    assert len(sweep.keys) == 7
    assert [key.label for key in varied_keys(sweep).values()] == ["ball diameter [mm]"]


def test_sweeps_of_sliding_friction_draw_sliding_friction():
    found = {name: read_sweep(name).plot for name in shipped_sweeps() if name.startswith("6206")}
    assert len(found) == 5
    assert all("torque_N_mm.models.skf.sliding" in plot for plot in found.values())
    assert not any("torque_N_mm.models.skf.total" in plot for plot in found.values())
