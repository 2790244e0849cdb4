"""Two results side by side, cuts through films, and interferograms."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from matplotlib.figure import Figure
from rich.console import Console
from typer.testing import CliRunner

from oilfilm.cases.cli.main import app
from oilfilm.postprocess import open_results, summary
from oilfilm.postprocess.bearing.write import write_bearing_netcdf
from oilfilm.postprocess.compare import compare, comparison_table, relative
from oilfilm.postprocess.contact import plots
from oilfilm.postprocess.contact.plots import Optics, intensity, write_interferogram, write_line_cut
from oilfilm.postprocess.contact.summary import ContactResults
from oilfilm.postprocess.contact.write import write_contact_netcdf
from oilfilm.postprocess.files import SUMMARY_FILE, write_json
from oilfilm.postprocess.netcdf_write import FIELDS_FILE
from oilfilm.postprocess.open_results import open_contact


def write_results(results, folder):
    """The numbers and fields of a run, without its pictures."""
    document = summary(results)
    is_contact = isinstance(results, ContactResults)
    write = write_contact_netcdf if is_contact else write_bearing_netcdf
    write(results, folder / FIELDS_FILE, document)
    write_json(document, folder / SUMMARY_FILE)


@pytest.fixture(scope="module")
def folder(bearing_results, tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    write_results(bearing_results, folder)
    return folder


@pytest.fixture
def changed(folder, tmp_path):
    """The same results but for a load, its films, a torque and an input."""
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    document["case"]["operation"] = {"radial_load_N": 2000.0}
    contact = document["contacts"][0]
    contact["load_N"] *= 0.9
    contact["film_minimum_um"] += 0.5 * contact["film_minimum_uncertainty_um"]
    contact["film_central_um"] *= 1.5
    contact["points"] = [1, 2]
    document["ring"]["displacement_um"][2] = 1e-14
    document["torque_N_mm"]["total"] = 40.0
    (tmp_path / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    return tmp_path


def test_equal_results_are_equal(folder):
    found = compare(folder, folder)
    assert found.inputs == found.results == ()
    assert found.largest == 0.0
    assert all(d.first == d.second for d in found.main)


def test_the_order_of_what_is_assumed_does_not_matter(folder, tmp_path):
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    for name, assumed in (("one", ["a.b_mm", "c.d_N"]), ("two", ["c.d_N", "e.f", "a.b_mm"])):
        document["case"]["assumed"] = assumed
        (tmp_path / name).mkdir()
        (tmp_path / name / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    (found,) = compare(tmp_path / "one", tmp_path / "two").inputs
    assert (found.path, found.first, found.second) == ("assumed[e.f]", None, "listed")


def test_every_difference_is_found_and_nothing_else(folder, changed):
    found = compare(folder, changed)
    assert [d.path for d in found.inputs] == ["operation.radial_load_N"]
    results = {d.path: d for d in found.results}
    assert set(results) == {
        "contacts.ball 1 inner.load_N",
        "contacts.ball 1 inner.film_minimum_um",
        "contacts.ball 1 inner.film_central_um",
        "torque_N_mm.total",
    }
    assert results["contacts.ball 1 inner.load_N"].relative == pytest.approx(-0.1)
    assert results["contacts.ball 1 inner.film_minimum_um"].covered is True
    assert results["contacts.ball 1 inner.film_central_um"].covered is False
    assert results["torque_N_mm.total"].relative is None
    assert found.largest == float("inf")
    json.dumps(found.document(), allow_nan=False)


def test_round_off_is_no_difference(folder, tmp_path):
    """A part of a torque that is zero but for round-off beside the other parts, and one that is small but real."""
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    for name, sliding, spin in (("one", 2e-13, 1e-3), ("two", -3e-13, 2e-3)):
        parts = {"rolling": 200.0, "sliding": sliding, "spin": spin, "total": 200.0}
        (tmp_path / name).mkdir()
        text = json.dumps(document | {"torque_N_mm": {"models": {"integrated": parts}}})
        (tmp_path / name / SUMMARY_FILE).write_text(text, encoding="utf-8")
    (found,) = compare(tmp_path / "one", tmp_path / "two").results
    assert found.path == "torque_N_mm.models.integrated.spin"
    assert found.relative == pytest.approx(1e-3 / (0.01 * 200.0))  # a small part counts as a hundredth of the largest


@pytest.mark.parametrize(
    ("change", "listed"),
    [
        (lambda d: d["ring"].update(tilt_mrad=[3e-14, -2e-13]), False),  # zero but for round-off in all components
        (lambda d: d["ring"].update(tilt_mrad=[3e-7, 0.0]), True),
        (lambda d: d["contacts"][0].update(load_N=d["contacts"][0]["load_N"] * (1.0 + 1e-14)), False),
        (lambda d: d["contacts"][0].update(load_N=d["contacts"][0]["load_N"] * (1.0 + 1e-6)), True),
    ],
)
def test_changes_of_round_off_are_not_listed_and_small_ones_are(change, listed, folder, tmp_path):
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    document["ring"]["tilt_mrad"] = [-1e-15, 2e-14]
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        (tmp_path / name / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
        change(document)
    assert len(compare(tmp_path / "one", tmp_path / "two").results) == listed


def test_errors_of_the_solution_and_what_stands_twice_are_not_listed(folder, tmp_path):
    """Imbalances of 1e-13 differ by 100 % from result to result; the power balance stands in two blocks."""
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    balance = {"imbalance": 3e-13, "relative_error": 2e-13, "heat_W": 5.0}
    document |= {"energy_error": 1e-15, "energy_balance_error": 1e-6, "power_balance": balance}
    document["torque_N_mm"] |= {"power_balance": balance}
    folders = [tmp_path / name for name in ("one", "two")]
    for factor, place in zip((1.0, -2.0), folders, strict=True):
        for name in balance:
            balance[name] *= factor
        for name in ("energy_error", "energy_balance_error"):
            document[name] *= factor
        place.mkdir()
        (place / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    assert [found.path for found in compare(*folders).results] == ["torque_N_mm.power_balance.heat_W"]


def test_error_bars_of_any_quantity_are_found(folder, tmp_path):
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    for name, stiffness, rolling in (("one", 100.0, 50.0), ("two", 103.0, 46.0)):
        contact = document["contacts"][0]
        contact.update({"stiffness_N_um": stiffness, "stiffness_uncertainty_N_um": 3.0})
        parts = {"rolling": rolling, "rolling_uncertainty": 1.0, "total": 200.0}
        document["torque_N_mm"] = {"models": {"integrated": parts}}
        (tmp_path / name).mkdir()
        (tmp_path / name / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    found = {d.path: d for d in compare(tmp_path / "one", tmp_path / "two").results}
    first = found["contacts.ball 1 inner.stiffness_N_um"]
    assert first.over_bars == pytest.approx(3.0 / np.hypot(3.0, 3.0)) and first.covered is True
    second = found["torque_N_mm.models.integrated.rolling"]
    assert second.over_bars == pytest.approx(-4.0 / np.hypot(1.0, 1.0)) and second.covered is False
    assert set(found) == {first.path, second.path}  # the bars themselves are no results


def test_relative_differences():
    assert relative(1.0, 1.0) == 0.0
    assert relative(-1.0, 1.0) == 2.0
    assert relative(0.0, 2.0) == 1.0
    assert relative(2.0, 1.0) == -0.5
    assert relative(150.0, 1500.0) == 9.0
    assert relative(0.0, 1e-6, scale=1.0) == pytest.approx(1e-4)
    assert relative(True, 1.5) is None
    assert relative(None, 1.0) is None


def test_the_table_fits_the_terminal(folder, changed):
    console = Console(width=80, record=True, file=open("/dev/null", "w", encoding="utf-8"))  # noqa: SIM115
    console.print(comparison_table(compare(folder, changed)))
    lines = console.export_text().splitlines()
    assert max(map(len, lines)) <= 80
    assert any("radial_load_N" in line for line in lines)
    assert any("film_central_um" in line and line.split()[-1] == "+50" for line in lines)  # 1.5 times as thick [%]
    console.file.close()


def test_exit_codes(folder, changed, tmp_path):
    def code(*words):
        return CliRunner().invoke(app, ["compare", *map(str, words)]).exit_code

    assert code(folder, folder) == 0
    assert code(folder, changed) == 0
    assert code(folder, changed, "--within", "0.5") == 1
    assert code(folder, tmp_path / "nowhere") == 2
    document = json.loads((changed / SUMMARY_FILE).read_text(encoding="utf-8"))
    (changed / SUMMARY_FILE).write_text(json.dumps(document | {"converged": False}), encoding="utf-8")
    assert code(folder, changed) == 1


def test_results_of_two_kinds_are_not_compared(folder, contact_results, tmp_path):
    write_results(contact_results, tmp_path)
    with pytest.raises(ValueError, match=r"of a bearing, .* of a contact"):
        compare(folder, tmp_path)


def rows(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow
def test_a_cut_is_a_row_of_the_field(folder, tmp_path):
    found = rows(write_line_cut(folder, tmp_path / "cut.csv"))
    with open_results(folder) as tree:
        contact = tree["contacts/ball01/inner"]
        middle = int(np.abs(contact["y"].values).argmin())
        assert contact["y"].values[middle] == pytest.approx(0.0, abs=1e-12)
        film = contact["h"].values[:, middle]
    assert [float(row["film [um]"]) for row in found] == pytest.approx(1e6 * film, rel=1e-6)
    assert list(found[0]) == ["x [mm]", "film [um]", "pressure [GPa]"]


@pytest.mark.slow
def test_a_cut_beside_the_centre_has_the_hertz_pressure_there(folder, tmp_path):
    found = rows(write_line_cut(folder, tmp_path / "cut.csv", "ball02/outer", "x", 0.6))
    with open_results(folder) as tree:
        hertz = tree["contacts/ball02/outer"].attrs["hertz_pressure"] / 1e9
    largest = max(float(row["pressure [GPa]"]) for row in found)
    assert largest == pytest.approx(0.8 * hertz, rel=1e-2)  # sqrt(1 - 0.6^2), linear over 0.14


@pytest.mark.slow
def test_wrong_contacts_and_lines_are_told(folder, tmp_path):
    with pytest.raises(ValueError, match="did you mean 'ball01/inner'"):
        open_contact(folder, "ball1/inner")
    with pytest.raises(ValueError, match="outside the box"):
        write_line_cut(folder, tmp_path / "cut.csv", at=50.0)
    with pytest.raises(ValueError, match="axis must be"):
        write_line_cut(folder, tmp_path / "cut.csv", axis="z")


def test_fringes_lie_half_a_wavelength_of_film_apart():
    optics = Optics(wavelengths=(600e-9,), refractive_index=1.5)
    step = 600e-9 / (2.0 * 1.5)
    orders = np.arange(5)
    assert intensity(orders * step, optics) == pytest.approx(1.0)
    assert intensity((orders + 0.5) * step, optics) == pytest.approx(0.0, abs=1e-12)
    assert intensity(np.array([0.25 * step]), optics) == pytest.approx(0.5)
    colours = intensity(np.zeros((3, 4)), Optics(wavelengths=(650e-9, 532e-9, 450e-9)))
    assert colours.shape == (3, 4, 3)


@pytest.mark.parametrize("bad", [{"wavelengths": (1.0,)}, {"wavelengths": (5e-7, 6e-7)}, {"refractive_index": 0.5}])
def test_optics_that_do_not_exist(bad):
    with pytest.raises(ValueError, match=next(iter(bad))):
        Optics(**bad)


def test_the_foot_of_an_interferogram_has_the_step_of_its_fringes(folder, monkeypatch):
    """lambda/(2 n), from bright to bright."""
    figure = Figure()
    monkeypatch.setattr(plots.plot_style, "write_figure", lambda path, draw: draw(figure))
    write_interferogram(folder, "fringes.png", optics=Optics(wavelengths=(600e-9,), refractive_index=1.5))
    assert figure.get_supxlabel().startswith("from fringe to fringe 200 nm of film")


@pytest.mark.slow
def test_pictures_of_interferograms(folder, moes_results, tmp_path):
    path = write_interferogram(folder, tmp_path / "fringes.png", "ball01/outer")
    assert path.read_bytes()[:4] == b"\x89PNG"
    answer = CliRunner().invoke(
        app, ["interferogram", str(folder), "-o", str(tmp_path / "a.png"), "--wavelength-nm", "1"]
    )
    assert answer.exit_code == 2
    write_results(moes_results, tmp_path / "moes")
    with pytest.raises(ValueError, match="no dimension"):
        write_interferogram(tmp_path / "moes", tmp_path / "b.png")
    answer = CliRunner().invoke(app, ["cut", str(tmp_path / "moes"), "-o", str(tmp_path / "c.csv")])
    assert answer.exit_code == 0, answer.output
    assert list(rows(tmp_path / "c.csv")[0]) == ["x [a]", "film [a^2/Rx]", "pressure [GPa]"]
