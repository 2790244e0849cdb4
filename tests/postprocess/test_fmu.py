"""Tables of batches as functional mock-up units, checked and simulated by FMPy."""

from __future__ import annotations

import math
import zipfile
from itertools import product

import numpy as np
import pytest

from oilfilm.postprocess.batch.results import BatchPoint, BatchResults
from oilfilm.postprocess.fmu import export
from oilfilm.postprocess.fmu.export import table_of

from ..kept import kept

SPEEDS = (500.0, 1000.0, 2000.0, 4000.0, 8000.0)
LOADS = (100.0, 300.0, 900.0, 2700.0)
KEYS = ("operation.inner_speed_rpm", "operation.radial_load_N")


def torque(speed, load):
    """A smooth law that is no power law."""
    return 1.5 + 1e-3 * speed**0.7 * load**0.4 + 2e-9 * speed**2


def temperature(speed, load):
    """It changes its sign."""
    return -20.0 + 0.004 * speed + 0.003 * load


def point(number, speed, load, **changes):
    own = {"number": number, "block": "sweep", "values": dict(zip(KEYS, (speed, load), strict=True)), "case": {}}
    summary = {
        "converged": True,
        "contacts": [],
        "torque_N_mm": {"total": torque(speed, load)},
        "self_heating": {"temperature_C": temperature(speed, load)},
        "ring": {"stiffness": {"matrix": (np.eye(5) * (1e6 + load)).tolist()}},
    }
    own |= {"key": str(number), "resumed": False, "status": "done", "message": "", "summary": summary}
    return BatchPoint(**own | changes)


def batch(points):
    return BatchResults(version="0", title="table", case="c", sweep="", keys=KEYS, points=tuple(points))


@pytest.fixture(scope="module")
def results():
    return batch(point(k, *node) for k, node in enumerate(product(SPEEDS, LOADS)))


@pytest.fixture(scope="module", params=[2, 3])
def unit(request, results, tmp_path_factory):
    file = tmp_path_factory.mktemp("fmu") / "6205 table.fmu"
    lines = export.write_fmu(results, file, request.param)
    return file, lines


def simulated(file, speed, load):
    fmpy = pytest.importorskip("fmpy")
    start = {"inner_speed_rpm": speed, "radial_load_N": load}
    return fmpy.simulate_fmu(str(file), start_values=start, stop_time=1.0)[-1]


def test_unit_is_valid(unit):
    validation = pytest.importorskip("fmpy.validation")
    assert validation.validate_fmu(str(unit[0])) == []


@pytest.mark.parametrize(("speed", "load"), [(500.0, 100.0), (2000.0, 900.0), (8000.0, 2700.0)])
def test_unit_passes_through_the_points(unit, speed, load):
    found = simulated(unit[0], speed, load)
    assert found["torque_N_mm"] == pytest.approx(torque(speed, load), rel=1e-12)
    assert found["temperature_C"] == pytest.approx(temperature(speed, load), rel=1e-12)
    assert found["stiffness_y_N_m"] == pytest.approx(1e6 + load, rel=1e-12)
    assert found["outside"] == 0.0


def test_unit_is_within_its_error_between_the_points(unit, results):
    table = table_of(results)
    errors = dict(zip(table.outputs, table.errors, strict=True))
    for speed, load in ((707.0, 170.0), (3000.0, 500.0), (6100.0, 2000.0)):
        found = simulated(unit[0], speed, load)
        assert found["torque_N_mm"] == pytest.approx(torque(speed, load), rel=errors["torque_N_mm"])
        assert found["temperature_C"] == pytest.approx(temperature(speed, load), abs=errors["temperature_C"])
    assert 0.0 < errors["torque_N_mm"] < 0.05


def test_unit_is_held_and_flagged_beyond_the_table(unit):
    for speed, load, held in ((9000.0, 900.0, (8000.0, 900.0)), (500.0, 1.0, (500.0, 100.0))):
        found = simulated(unit[0], speed, load)
        assert found["outside"] == 1.0
        assert found["torque_N_mm"] == pytest.approx(torque(*held), rel=1e-12)
    assert simulated(unit[0], math.nan, 900.0)["outside"] == 1.0


def test_lines_tell_ranges_and_errors(unit):
    lines = "\n".join(unit[1])
    assert "input inner_speed_rpm: 500 to 8000" in lines
    assert "output torque_N_mm: within" in lines


def test_source_is_inside_without_a_compiler(results, tmp_path, monkeypatch):
    monkeypatch.setattr(export, "COMPILERS", ())
    lines = export.write_fmu(results, tmp_path / "t.fmu", 3)
    with zipfile.ZipFile(tmp_path / "t.fmu") as archive:
        names = archive.namelist()
    assert not [name for name in names if name.startswith("binaries")]
    assert {"sources/fmi3.c", "sources/table.h", "sources/buildDescription.xml"} <= set(names)
    assert lines[-1].startswith("no binary")


def test_equal_tables_are_equal_files(results, tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        export.write_fmu(results, tmp_path / name / "t.fmu", 2)
    assert (tmp_path / "a" / "t.fmu").read_bytes() == (tmp_path / "b" / "t.fmu").read_bytes()


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([point(1, 500.0, 100.0), point(2, 1000.0, 100.0), point(3, 500.0, 300.0)], "1 of 4 points"),
        ([point(1, 500.0, 100.0)], "varies none"),
        ([point(k, 500.0, 100.0, values={KEYS[0]: w}) for k, w in enumerate("ab")], "varies operation.inner_speed_rpm"),
        ([point(1, 500.0, 100.0), point(2, 900.0, 100.0, summary=None)], "1 of 2 points"),
    ],
    ids=["hole", "nothing varies", "words", "not converged"],
)
def test_no_table_without_a_full_grid(points, message):
    with pytest.raises(ValueError, match=message):
        table_of(batch(points))


def test_every_number_is_kept(unit):
    file, lines = unit
    with zipfile.ZipFile(file) as archive:
        texts = {name: archive.read(name) for name in archive.namelist() if name.endswith((".xml", ".c", ".h"))}
    without = "guid|token|generation"
    version = "fmi3" if any("fmi3" in name for name in texts) else "fmi2"
    kept(f"unit, {version}", {"lines": lines, "texts": texts}, without=without)
