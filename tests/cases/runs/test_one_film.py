"""One film in every result: table, CSV, netCDF, VTK and pictures have the operating film."""

from __future__ import annotations

import csv
from io import StringIO

import numpy as np
import pytest
import vtkmodules.all as vtk
from matplotlib.figure import Figure
from rich.console import Console
from vtkmodules.util.numpy_support import vtk_to_numpy

import oilfilm
from oilfilm.cases import load_case
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.runs.bearing import run_case
from oilfilm.ehl.units import value_with_error
from oilfilm.postprocess import write_results
from oilfilm.postprocess.bearing.plots import draw_per_azimuth
from oilfilm.postprocess.bearing.write import bearing_table
from oilfilm.postprocess.scene.vtk import FILM

FILMS = ("central", "minimum")


COARSE = {"film_maps": [0.0], "points": 65}


# of the first heat takes a quarter; of the second a flow leaves less than half, by the law of starvation
@pytest.fixture(
    scope="module", params=[("6208_full_ceramic", {}), ("6208_oil_supply", {"starvation": "none"})], ids=lambda p: p[0]
)
def run(request, tmp_path_factory):
    name, changes = request.param
    document = {**load_case(name).document, "ehl": COARSE | changes}
    results = run_case(case_of_document(document))
    folder = tmp_path_factory.mktemp("results") / "out"
    write_results(results, folder)
    return results, folder


def printed(results):
    console = Console(width=100, record=True, file=StringIO())
    console.print(bearing_table(results))
    return console.export_text()


def test_every_result_has_the_operating_film(run):
    results, folder = run
    contact = oilfilm.postprocess.summary(results)["contacts"][0]
    films = [contact[f"film_{name}_um"] for name in FILMS]
    bars = [contact[f"film_{name}_uncertainty_um"] for name in FILMS]
    assert contact["film_origin"] == "solved"
    for name, film in zip(FILMS, films, strict=True):
        assert film <= contact[f"isothermal_film_{name}_um"] <= contact[f"flooded_film_{name}_um"]
        assert film < 0.95 * contact[f"flooded_film_{name}_um"]

    # 1. terminal
    pairs = list(zip(films, bars, strict=True))
    texts = [" ".join(value_with_error(*pair, most=most) for pair in pairs) for most in (1, 2, 3, 4)]
    assert any(text in " ".join(printed(results).split()) for text in texts)

    # 2. CSV
    with (folder / "contacts.csv").open(encoding="utf-8") as lines:
        row = next(csv.DictReader(lines))
    assert [float(row[f"{name} film [um]"]) for name in FILMS] == pytest.approx(films, rel=1e-9)

    # 3. netCDF: numbers and field
    with oilfilm.open_results(folder) as tree:
        group = tree["contacts/ball01/inner"]
        assert [1e6 * float(group[f"film_{name}"]) for name in FILMS] == pytest.approx(films, rel=1e-6)
        assert [float(tree["contacts"][f"film_{name}_um"][0]) for name in FILMS] == pytest.approx(films, rel=1e-9)
        h = group["h"].values
        x, y = group["x"].values, group["y"].values
    assert 1e6 * h[abs(x).argmin(), abs(y).argmin()] == pytest.approx(films[0], rel=1e-6)
    assert 1e6 * h.min() == pytest.approx(films[1], rel=1e-6)

    # 4. VTK
    reader = vtk.vtkXMLStructuredGridReader()
    reader.SetFileName(str(next((folder / "vtk").glob("ball01_inner.vts"))))
    reader.Update()
    grid = reader.GetOutput()
    assert vtk_to_numpy(grid.GetPointData().GetArray(FILM)).min() == pytest.approx(films[1], rel=1e-6)
    facts = [vtk_to_numpy(grid.GetFieldData().GetArray(f"{name} film [um]"))[0] for name in FILMS]
    assert facts == pytest.approx(films, rel=1e-6)

    # 5. picture: the numbers in the map, and the points below
    figure = Figure()
    draw_per_azimuth(figure, results, "film")
    assert "operating film" in figure.get_suptitle()
    texts = [value_with_error(*pair, most=3) for pair in pairs]
    assert "\n".join(texts) in [text.get_text() for text in figure.axes[0].texts]
    points = [line.get_ydata() for line in figure.axes[-1].lines]
    assert any(np.isclose(films[0], values, rtol=1e-9).any() for values in points)


def test_instruments_read_the_operating_film(run):
    """The breakdown voltage goes with the minimum film."""
    results, _ = run
    contact = oilfilm.postprocess.summary(results)["contacts"][0]
    isothermal = oilfilm.ehl.traction.instruments.film_instruments(results.solutions[0])
    thinner = contact["film_minimum_um"] / (1e6 * results.solutions[0].film_minimum)
    assert contact["breakdown_voltage_V"] == pytest.approx(thinner * isothermal.breakdown_voltage)
