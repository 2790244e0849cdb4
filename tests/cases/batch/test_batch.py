"""Sweeps: their files, their points, execution, and what is left when something goes wrong."""

from __future__ import annotations

import csv
import json
import math
import pickle
import sqlite3
import subprocess
import sys
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from errno import ENOSPC

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm import postprocess
from oilfilm.bearing import contact_conditions, solve_quasistatic
from oilfilm.cases import CaseError, load_case
from oilfilm.cases.batch import shared_tables
from oilfilm.cases.batch.compute import compute_block, compute_point
from oilfilm.cases.batch.engine import PointSelection, ProgressEstimate, duration, run_batch
from oilfilm.cases.batch.finished import finished_summary
from oilfilm.cases.batch.keys import WITHOUT_CONTACTS, content_key
from oilfilm.cases.batch.points import Task
from oilfilm.cases.batch.pools import LocalPool, scheduler_address
from oilfilm.cases.batch.results import load_results, write_batch
from oilfilm.cases.batch.shared_tables import ContactCache
from oilfilm.cases.batch.store import finished_points, open_folder
from oilfilm.cases.batch.sweep import read_sweep, sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.film_model import NEWTONIAN
from oilfilm.ehl import ContactConditions, Lubricant, MoesConditions, SolverOptions
from oilfilm.postprocess.batch.store import PointStore, Record, StoredPoints, store_files

HEAD = 'case = "6208_full_ceramic"\n'
QUICK = (
    HEAD
    + """
[sweep]
"operation.inner_speed_rpm" = [5000.0, 10000.0]
"operation.radial_load_N" = [400.0, 900.0, 1750.0]
"ehl.film_maps" = ["none"]
"""
)


class HerePool:
    """Computes in this process at once, so that a test sees what the engine does; `broken` is the points that kill."""

    shares_folder = True
    retries = True

    def __init__(self, broken=(), times=1, stop_after=None):
        self.broken, self.times, self.rebuilt, self.handed_out = set(broken), times, 0, []
        self.stop_after = stop_after
        self.closed = None

    def capacity(self):
        return 3

    def block(self):
        return 1

    def submit(self, block):
        (task,) = block
        self.handed_out.append(task.key)
        future = Future()
        if self.stop_after is not None and len(self.handed_out) > self.stop_after:
            raise KeyboardInterrupt
        if task.key in self.broken and self.handed_out.count(task.key) <= self.times:
            future.set_exception(BrokenProcessPool("gone"))
        else:
            try:
                future.set_result(compute_block(block))
            except OSError as error:
                future.set_exception(error)
        return future

    def lost(self, error):
        return isinstance(error, BrokenProcessPool)

    def rebuild(self):
        self.rebuilt += 1
        return True

    def close(self, *, at_once):
        self.closed = at_once


def stored(folder):
    """Finished points of a batch on disk."""
    return StoredPoints(store_files(folder))


def finished(folder, sweep):
    """Names of the points of a sweep that are finished."""
    return finished_points(folder, [point.key for point in sweep.points], stored(folder))[0]


def damage(path, key):
    """Change a byte of the record of a point."""
    with closing(sqlite3.connect(path)) as file:
        (content,) = file.execute("SELECT summary FROM points WHERE key = ?", (key,)).fetchone()
        changed = content[:50] + bytes([content[50] ^ 1]) + content[51:]
        file.execute("UPDATE points SET summary = ? WHERE key = ?", (changed, key))
        file.commit()


def points(text):
    return [point.values for point in sweep_from_text(text, "sweep.toml").points]


def messages(text):
    with pytest.raises(CaseError) as caught:
        sweep_from_text(text, "sweep.toml")
    return caught.value.messages


def test_factorial_points_the_last_key_fastest():
    sweep = sweep_from_text(QUICK, "sweep.toml")
    found = [(p.values["operation.inner_speed_rpm"], p.values["operation.radial_load_N"]) for p in sweep.points]
    assert found == [(n, f) for n in (5000.0, 10000.0) for f in (400.0, 900.0, 1750.0)]
    assert [point.number for point in sweep.points] == [1, 2, 3, 4, 5, 6]
    assert len({point.key for point in sweep.points}) == 6


def test_every_point_states_every_key():
    text = HEAD + '[[combinations]]\n"bearing.balls" = 8\n[[combinations]]\noperation.radial_load_N = 500.0\n'
    assert points(text) == [
        {"bearing.balls": 8, "operation.radial_load_N": 3000.0},
        {"bearing.balls": 9, "operation.radial_load_N": 500.0},
    ]


def test_fixed_values_are_in_every_point():
    sweep = sweep_from_text(HEAD + '[fixed]\n"ehl.points" = 65\n[sweep]\n"bearing.balls" = [8, 9]\n', "sweep.toml")
    assert [point.resolved["ehl"]["points"] for point in sweep.points] == [65, 65]
    assert sweep.keys == ("bearing.balls",)


def test_latin_hypercube_takes_every_stratum_once():
    text = (
        HEAD + '[latin_hypercube]\nsamples = 20\n"operation.radial_load_N" = [400, 2399]\n"operation.temperature_C" = '
    )
    found = points(text + "[30.0, 50.0]\n")
    loads = [values["operation.radial_load_N"] for values in found]
    assert sorted((load - 400) // 100 for load in loads) == list(range(20))
    assert all(load == int(load) for load in loads)  # whole ends give whole numbers
    strata = sorted(int(values["operation.temperature_C"] - 30.0) for values in found)
    assert strata == list(range(20))
    assert points(text + "[30.0, 50.0]\n") == found
    assert points(text.replace("samples", "seed = 7\nsamples") + "[30.0, 50.0]\n") != found


def test_sensitivity_varies_what_is_assumed():
    sweep = sweep_from_text(HEAD + "[sensitivity]\nstep = 0.1\n", "sweep.toml")
    base, *others = sweep.points
    assert base.values["lubricant.viscosity_mPa_s"] == 26.1
    viscosity = sorted({p.values["lubricant.viscosity_mPa_s"] for p in others})
    assert viscosity == pytest.approx([0.9 * 26.1, 26.1, 1.1 * 26.1])
    for point in others:
        assert sum(point.values[key] != base.values[key] for key in sweep.keys) == 1


@pytest.mark.slow
def test_sensitivities_are_in_the_summary(tmp_path):
    text = HEAD + '[fixed]\n"ehl.film_maps" = "none"\n[sensitivity]\n'
    batch = run_batch(sweep_from_text(text, "sweep.toml"), tmp_path / "out", HerePool)
    write_batch(load_results(batch), tmp_path / "out")
    document = json.loads((tmp_path / "out" / "summary.json").read_text())
    found = {row["key"]: row["results"] for row in document["sensitivity"]}
    modulus = found["materials.silicon nitride.youngs_modulus_GPa"]["hertz_pressure_maximum_GPa"]
    assert modulus["sensitivity"] == pytest.approx(2.0 / 3.0, abs=0.03)  # p_h ~ E^(2/3) at a given load
    # thicker films press the balls beside the heaviest one more, which leaves it less
    assert found["lubricant.viscosity_mPa_s"]["load_maximum_N"]["sensitivity"] == pytest.approx(-0.006, abs=0.002)
    assert any("model.ball_kinematics left out" in message for message in document["messages"])


def test_a_bearing_and_an_oil_of_the_libraries(tmp_path):
    (tmp_path / "plain.toml").write_text(
        'schema_version = 1\n[bearing]\nname = "6208"\n[lubricant]\nname = "iso vg 46"\n'
        '[operation]\ninner_speed_rpm = 1000.0\nradial_load_N = 500.0\n[ehl]\nfilm_maps = "none"\n'
    )
    text = 'case = "plain.toml"\n[sweep]\n"bearing.name" = ["6208", "7000C"]\n"lubricant.name" = ["iso vg 46"]\n'
    sweep = sweep_from_text(text, "sweep.toml", tmp_path)
    assert sweep.points[0].resolved["bearing"]["balls"] != sweep.points[1].resolved["bearing"]["balls"]
    found = messages(HEAD + '[sweep]\n"bearing.name" = ["6208", "7000C"]\n')
    assert found == (
        'sweep.toml:3: sweep."bearing.name": the case itself gives ball_diameter_mm, which overrides the library\'s; '
        "allowed with a case that names a bearing only",
    )


SWEEP = HEAD + "[sweep]\n"
CUBE = HEAD + "[latin_hypercube]\n"
WRONG = {
    "": "1: the file is empty; see 'oilfilm init'",
    SWEEP.replace(HEAD, ""): "1: case: missing; needed: text in quotes",
    '[bearing]\nname = "6208"\n': "1: a case, not a sweep; run it with 'oilfilm run'",
    "[contact]\nload_N = 1.0\n": "1: a case, not a sweep; run it with 'oilfilm contact'",
    HEAD: "1: no points; needed: [sweep], [[combinations]], [latin_hypercube] or [sensitivity] with keys",
    HEAD.replace("full", "fool"): (
        "1: case: 6208_fool_ceramic: no such file, and no shipped case has this name; did you mean '6208_full_ceramic'?"
    ),
    HEAD + "[sweeep]\n": "2: sweeep: unknown name; did you mean 'sweep'?",
    SWEEP + '"operation.radial_load" = [1.0]': (
        "3: sweep.\"operation.radial_load\": unknown key; keys end in their unit; did you mean 'radial_load_N'?"
    ),
    SWEEP + '"operatoin.radial_load_N" = [1.0]': (
        "3: sweep.\"operatoin.radial_load_N\": operatoin: unknown name; did you mean 'operation'?"
    ),
    SWEEP + '"operation.radial_load_N" = 1.0': (
        '3: sweep."operation.radial_load_N": found 1.0; allowed: a list of values'
    ),
    SWEEP + "operation.inner_speed_rpm = [1.0, 2e7]": (
        "3: sweep.operation.inner_speed_rpm: found 20000000.0; allowed: a number >= -1e+06 and <= 1e+06"
    ),
    CUBE + 'samples = 0\n"operation.radial_load_N" = [1.0, 2.0]': (
        "3: latin_hypercube.samples: found 0; allowed: a whole number >= 1 and <= 100000"
    ),
    CUBE + 'samples = 3\n"operation.radial_load_N" = [2.0, 1.0]': (
        '4: latin_hypercube."operation.radial_load_N": found [2.0, 1.0]; '
        "allowed: [first, last], two numbers, first < last"
    ),
    CUBE + '"operation.radial_load_N" = [1.0, 2.0]': (
        "2: latin_hypercube.samples: missing; needed: a whole number >= 1 and <= 100000"
    ),
    HEAD + 'compute = "slip"\n[sweep]\n"operation.radial_load_N" = [1.0]': (
        '2: compute: point 1: the case has no table [slip]; allowed: "run"'
    ),
    HEAD + '[fixed]\n"ehl.points" = 66\n[sweep]\n"bearing.balls" = [8, 9]': (
        '3: fixed."ehl.points": found 66; allowed: 2^k + 1: 33, 65, 129, 257, 513, 1025, 2049 or 4097'
    ),
    SWEEP + '"bearing.balls" = [8, 30]': (
        '3: sweep."bearing.balls": found 30; allowed: at most 15 balls of 12 mm on a pitch circle of 60 mm'
    ),
    SWEEP + '"bearing.pitch_diameter_mm" = [30.0]': (
        "1: case: point 1 (bearing.pitch_diameter_mm = 30.0): bearing.balls: found 9; "
        "allowed: at most 7 balls of 12 mm on a pitch circle of 30 mm"
    ),
    HEAD + '[sensitivity]\nkeys = ["bearing.cage_material"]': (
        '3: sensitivity.keys: bearing.cage_material = "pvx"; allowed: keys of the case with a number that is not 0'
    ),
    HEAD + "[sensitivity]\nkeys = 1": (
        '3: sensitivity.keys: found 1; allowed: "assumed", or a list of keys like "lubricant.viscosity_mPa_s"'
    ),
}


@pytest.mark.parametrize(("text", "message"), WRONG.items())
def test_messages_name_the_line_of_the_sweep_file(text, message):
    assert f"sweep.toml:{message}" in messages(text)


def test_too_many_points_are_refused_before_they_are_made():
    axes = "".join(f'"operation.k{i}" = {list(range(99))}\n' for i in range(9))
    assert "allowed: at most 10000000" in messages(HEAD + "[sweep]\n" + axes)[0]


def test_equal_points_are_computed_once(tmp_path):
    text = HEAD + '[sweep]\n"operation.radial_load_N" = [400.0, 400.0, 400]\n"ehl.film_maps" = ["none"]\n'
    pool = HerePool()
    batch = run_batch(sweep_from_text(text, "sweep.toml"), tmp_path / "out", lambda: pool)
    assert len(pool.handed_out) == 1
    assert len(load_results(batch).points) == 3


def test_files_of_a_point_are_there_before_it_counts_as_finished(tmp_path, monkeypatch):
    from oilfilm.cases.batch import engine

    seen = []

    class Watched(engine.PointStore):
        def put(self, record):
            seen.append((tmp_path / "out" / "points" / f"{record.key}.json").exists())
            super().put(record)

    monkeypatch.setattr("oilfilm.cases.batch.store.PointStore", Watched)
    run_batch(sweep_from_text(QUICK, "sweep.toml"), tmp_path / "out", HerePool, PointSelection(keep_json=True))
    assert seen == [True] * 6


def test_files_of_a_batch(tmp_path):
    batch = run_batch(sweep_from_text(QUICK, "sweep.toml"), tmp_path / "out", HerePool)
    write_batch(load_results(batch), tmp_path / "out")
    with (tmp_path / "out" / "batch.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["operation.radial_load_N [N]"] for row in rows] == ["400.0", "900.0", "1750.0"] * 2
    with postprocess.open_results(tmp_path / "out") as data:
        data = data.to_dataset()
        assert data["operation.inner_speed_rpm"].attrs["units"] == "rpm"
        assert data["contact.load_N"].dims == ("point", "ball", "race")
        assert data["contact.load_N"].attrs["units"] == "N"
        loads = data["contact.load_N"].values
        films = data["contact.film_central_um"].values  # of the film atlas, of all that carry load
        assert (np.isnan(films) | (loads > 0.0)).all() and np.isfinite(films[:, 0]).all()
        assert float(rows[4]["load_maximum_N [N]"]) == loads[4].max()
        case = json.loads(data["case"].values[4])
        assert case["operation"]["radial_load_N"] == 900.0
        assert data.attrs["sweep"] == QUICK
        # a ball is pressed on the outer race by the inner one and its centrifugal force
        inner, outer = (data["contact.load_N"].sel(race=race).values[4] for race in ("inner", "outer"))
        assert outer - inner == pytest.approx(np.full(9, (outer - inner)[0]), rel=1e-3)
        assert outer[0] > inner[0] > 0.0
        # the heavy balls carry the radial load, sum of Q cos(psi) = F; the films of the others push beside it
        azimuth = np.radians(data["ball.azimuth_deg"].values)[4]
        light = inner < 0.05 * inner.max()
        assert 0 < light.sum() < 9
        assert (inner * np.cos(azimuth))[~light].sum() == pytest.approx(900.0, rel=1e-3)
        assert (outer * np.cos(azimuth)).sum() == pytest.approx(900.0, rel=0.05)


def test_a_failing_point_is_recorded_and_does_not_stop_the_others(tmp_path, monkeypatch):
    sweep = sweep_from_text(QUICK, "sweep.toml")
    bad = sweep.points[2].document

    def run(case, *_, **_options):
        if case.document["operation"]["radial_load_N"] == 1750.0:
            raise ArithmeticError("no such equilibrium")
        return original(case, 1)

    from oilfilm.cases.runs import bearing as module

    original = module.run_case
    monkeypatch.setattr("oilfilm.cases.batch.compute.run_case", run)
    batch = run_batch(sweep, tmp_path / "out", HerePool)
    results = load_results(batch)
    assert bad["operation"]["radial_load_N"] == 1750.0
    assert [point.status for point in results.points] == ["done", "done", "failed"] * 2
    assert results.points[2].message == "ArithmeticError: no such equilibrium"
    write_batch(results, tmp_path / "out")
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["failed"] == 2
    assert any("no such equilibrium" in message for message in summary["messages"])
    monkeypatch.undo()
    again = run_batch(sweep, tmp_path / "out", HerePool, PointSelection(resume=True))
    assert len(again.resumed) == 4
    assert all(point.status == "done" for point in load_results(again).points)


def test_a_lost_worker_costs_nothing_but_the_point_that_kills_it(tmp_path):
    sweep = sweep_from_text(QUICK, "sweep.toml")
    once = HerePool([sweep.points[1].key])
    results = load_results(run_batch(sweep, tmp_path / "once", lambda: once))
    assert once.rebuilt == 1
    assert all(point.status == "done" for point in results.points)
    twice = HerePool([sweep.points[1].key], times=2)
    results = load_results(run_batch(sweep, tmp_path / "twice", lambda: twice))
    assert [point.status for point in results.points] == ["done", "lost", "done", "done", "done", "done"]
    assert "the worker was lost twice" in results.points[1].message
    assert twice.closed is False


def test_an_interrupt_keeps_what_is_finished_and_resume_goes_on(tmp_path):
    sweep = sweep_from_text(QUICK, "sweep.toml")
    pool = HerePool(stop_after=4)
    with pytest.raises(KeyboardInterrupt):
        run_batch(sweep, tmp_path / "out", lambda: pool)
    assert pool.closed is True
    kept = finished(tmp_path / "out", sweep)
    assert len(kept) == 4
    with pytest.raises(CaseError, match="--resume"):
        run_batch(sweep, tmp_path / "out", HerePool)
    rest = HerePool()
    batch = run_batch(sweep, tmp_path / "out", lambda: rest, PointSelection(resume=True))
    assert len(rest.handed_out) == 2
    assert batch.resumed == kept


def test_nothing_stays_of_what_a_worker_was_writing_when_it_was_ended(tmp_path):
    class Writing(HerePool):
        def close(self, *, at_once):
            for folder in ("points", "contacts", "tables"):
                (tmp_path / "out" / folder).mkdir(exist_ok=True)
                (tmp_path / "out" / folder / ".key-x.part").touch()

    with pytest.raises(KeyboardInterrupt):
        run_batch(sweep_from_text(QUICK, "sweep.toml"), tmp_path / "out", lambda: Writing(stop_after=1))
    assert len(stored(tmp_path / "out").status) == 1
    assert not list((tmp_path / "out").rglob(".*"))


def test_resume_after_the_sweep_was_extended_and_a_file_was_damaged(tmp_path):
    first = sweep_from_text(QUICK, "sweep.toml")
    run_batch(first, tmp_path / "out", HerePool)
    damage(tmp_path / "out" / "points.sqlite", first.points[0].key)
    longer = sweep_from_text(QUICK.replace("1750.0", "1750.0, 3000.0"), "sweep.toml")
    pool = HerePool()
    batch = run_batch(longer, tmp_path / "out", lambda: pool, PointSelection(resume=True))
    assert len(pool.handed_out) == 3
    assert len(batch.resumed) == 5
    nothing = HerePool()
    run_batch(longer, tmp_path / "out", lambda: nothing, PointSelection(resume=True))
    assert nothing.handed_out == []


def test_a_finished_batch_is_neither_computed_nor_written_again(tmp_path):
    """Without a solver: its summary as it stands, points as taken over; anything changed goes the long way."""
    sweep = tmp_path / "sweep.toml"
    sweep.write_text(QUICK, encoding="utf-8")
    out = tmp_path / "out"
    ran = write_batch(load_results(run_batch(read_sweep(sweep), out, HerePool)), out)
    before = {path: path.stat().st_mtime_ns for path in out.rglob("*")}
    again = CliRunner().invoke(app, ["batch", str(sweep), "-o", str(out), "--json", "--resume"])
    resumed = json.loads(again.stdout)
    assert {path: path.stat().st_mtime_ns for path in out.rglob("*")} == before
    assert resumed["resumed"] == 6 and all(point["resumed"] for point in resumed["points"])
    changing = ("resumed", "timing_s", "points")
    assert {k: v for k, v in resumed.items() if k not in changing} == {
        k: v for k, v in ran.items() if k not in changing
    }
    code = f"""
import sys
from pathlib import Path
from oilfilm.cases.batch.finished import finished_summary
print(finished_summary({str(sweep)!r}, Path({str(out)!r}), parquet=False) is None, "numba" in sys.modules)
"""
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.split() == ["False", "False"]
    assert finished_summary(sweep, out, parquet=True) is None
    for changed in (QUICK.replace("1750.0", "1760.0"), QUICK + "\n"):
        sweep.write_text(changed, encoding="utf-8")
        assert finished_summary(sweep, out, parquet=False) is None
    sweep.write_text(QUICK, encoding="utf-8")
    (out / "points.sqlite").touch()
    assert finished_summary(sweep, out, parquet=False) is None


def test_a_full_disk_ends_the_batch_and_keeps_what_is_there(tmp_path, monkeypatch):
    from oilfilm.cases.batch import engine

    class Small(engine.PointStore):
        def put(self, record):
            if len(written) == 2:
                (pages,) = self._file.execute("PRAGMA page_count").fetchone()
                self._file.execute(f"PRAGMA max_page_count = {pages}")
            super().put(record)
            self.flush(at_once=True)
            written.append(record.key)

    written = []
    monkeypatch.setattr("oilfilm.cases.batch.store.PointStore", Small)
    sweep = sweep_from_text(QUICK, "sweep.toml")
    with pytest.raises(OSError, match="full") as caught:
        run_batch(sweep, tmp_path / "out", HerePool)
    assert caught.value.errno == ENOSPC
    assert finished(tmp_path / "out", sweep) == set(written) != set()


@pytest.mark.slow
def test_a_full_disk_is_told_with_what_is_kept(tmp_path, monkeypatch):
    import errno

    from oilfilm.cases.batch import results

    def full(*arguments, **choices):
        raise OSError(errno.ENOSPC, "No space left on device")

    (tmp_path / "mine.toml").write_text(QUICK)
    monkeypatch.setattr("oilfilm.cases.cli.batch._pool", lambda plan, wanted: HerePool)
    words = ["batch", str(tmp_path / "mine.toml"), "-o", str(tmp_path / "out"), "-q"]
    with monkeypatch.context() as patch:
        patch.setattr(results, "write_batch", full)
        found = CliRunner().invoke(app, words)
    assert found.exit_code == 4
    assert f"finished points are kept in {tmp_path / 'out'}; make room, then continue with --resume" in found.stderr
    assert "No space left on device" in found.stderr
    assert CliRunner().invoke(app, [*words, "--resume"]).exit_code == 0
    assert json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))["resumed"] == 6


def test_a_folder_of_something_else_is_left_alone(tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "notes.txt").write_text("mine")
    with pytest.raises(CaseError, match="holds other files"):
        run_batch(sweep_from_text(QUICK, "sweep.toml"), tmp_path / "out", HerePool)
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["notes.txt"]


@pytest.mark.parametrize("name", ["summary.json", "points.sqlite", "points/1a.json", "points/1a.nc"])
def test_a_folder_in_the_place_of_a_file_is_refused_before_anything_is_computed(name, tmp_path):
    (tmp_path / "sweep.toml").write_text("")
    (tmp_path / name).mkdir(parents=True)
    with pytest.raises(CaseError, match="is a folder in the place of a file"):
        open_folder(tmp_path, resume=True)


def test_contacts_equal_in_several_points_are_solved_once(tmp_path, monkeypatch):
    from oilfilm import ehl

    text = HEAD + (
        '[sweep]\n"surface.ball_roughness_um" = [0.05, 0.1]\n"surface.inner_ring_roughness_um" = [0.1]\n'
        '"surface.outer_ring_roughness_um" = [0.1]\n"ehl.film_maps" = [[0.0]]\n"ehl.points" = [33]\n'
    )
    solved = []

    def solve(conditions, options):
        solved.append(conditions)
        return original(conditions, options)

    original = ehl.solve_contact
    monkeypatch.setattr("oilfilm.cases.format.film_model.solve_contact", solve)
    results = load_results(run_batch(sweep_from_text(text, "sweep.toml"), tmp_path / "out", HerePool))
    assert len(solved) == 2  # both races of one ball, for two points
    first, second = (point.summary["contacts"] for point in results.points)
    assert [c["film_minimum_um"] for c in first] == [c["film_minimum_um"] for c in second]
    assert first[0]["lambda_ratio"] > second[0]["lambda_ratio"]


def with_cache(folder, films=NEWTONIAN):
    cache = ContactCache(folder)
    return lambda conditions, options: cache.solve(conditions, options, films)


def test_contacts_of_balls_without_load_are_solved_once_for_all_loads(tmp_path, monkeypatch):
    """Values that repeat, and points that are all different, where nothing is looked for."""
    from oilfilm import ehl

    points = '"ehl.points" = [33]\n"ehl.film_maps" = ["all"]\n'
    text = HEAD + f'[sweep]\n"operation.radial_load_N" = [900.0, 1000.0]\n{points}'
    solved = []
    original = ehl.solve_contact
    monkeypatch.setattr(
        "oilfilm.cases.format.film_model.solve_contact", lambda *words: solved.append(words[0]) or original(*words)
    )
    sweep = sweep_from_text(text, "sweep.toml")
    run_batch(sweep, tmp_path / "out", HerePool)
    assert sweep.share_contacts and len(solved) == len({content_key(one) for one in solved})
    sampled = HEAD + '[sample]\nsamples = 3\n"operation.radial_load_N" = [900.0, 1000.0]\n'
    assert not sweep_from_text(sampled, "sweep.toml").share_contacts


def test_the_cache_is_looked_through_a_few_times_only(tmp_path, monkeypatch):
    """10 000 contacts of 100 kB are 10 looks, of which each reads the sizes of all there are."""
    looks = []
    monkeypatch.setattr(shared_tables, "load_object", lambda path, kind: None)
    monkeypatch.setattr(shared_tables, "store_object", lambda path, thing: 100_000)
    monkeypatch.setattr(shared_tables, "content_key", lambda *words: f"{words[0]}")
    cache = ContactCache(tmp_path)
    plain = cache._look
    monkeypatch.setattr(cache, "_look", lambda: looks.append(1) or plain())
    films = type("Films", (), {"solve": lambda *words: None})()
    for k in range(10_000):
        cache.solve(k, None, films)
    assert len(looks) == 10


def test_a_full_cache_takes_no_more(tmp_path, monkeypatch):
    monkeypatch.setattr(shared_tables, "MOST_BYTES", 10)
    monkeypatch.setattr(shared_tables, "BETWEEN", 1)
    oil = Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
    solve = with_cache(tmp_path)
    for load in (10.0, 12.0):
        solve(MoesConditions(load_parameter=load, lubricant_parameter=5.0, lubricant=oil), SolverOptions(points=33))
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.slow  # compiles the kernels of heat
def test_a_contact_with_heat_is_kept_with_its_temperatures(tmp_path):
    case = load_case("6208_with_heat")
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    contact = contact_conditions(state, case.lubricant)[0].conditions
    solve = with_cache(tmp_path, case.films)
    first, again = (solve(contact, SolverOptions(points=33)) for _ in range(2))
    assert again is not first and first.state is not None
    for name in first.state.__dataclass_fields__:
        assert np.array_equal(getattr(first.state, name), getattr(again.state, name)), name


def test_a_cached_contact_is_the_solved_one_to_the_bit(tmp_path):
    oil = Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
    contact = ContactConditions(
        load=15.0, radius_x=0.0125, radius_y=0.0125, reduced_modulus=110e9, entrainment_speed=0.09, lubricant=oil
    )
    solve = with_cache(tmp_path)
    first = solve(contact, SolverOptions(points=33))
    assert len(list(tmp_path.glob("*.contact"))) == 1
    second = solve(contact, SolverOptions(points=33))
    assert second is not first
    for name in ("X", "Y", "P", "H"):
        assert np.array_equal(getattr(first, name), getattr(second, name))
    for name in ("film_minimum_dimensionless", "film_scale", "domain", "record", "message", "conditions", "options"):
        assert getattr(first, name) == getattr(second, name), name
    assert content_key(contact, SolverOptions(points=33)) != content_key(contact, SolverOptions(points=65))


@pytest.mark.parametrize("damage", ["truncated", "emptied", "flipped", "another", "text", "pickle"])
def test_a_damaged_contact_is_told_and_solved_anew(damage, tmp_path, capsys):
    from dataclasses import replace

    oil = Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
    contact = MoesConditions(load_parameter=10.0, lubricant_parameter=5.0, lubricant=oil)
    solve = with_cache(tmp_path)
    first = solve(contact, SolverOptions(points=33))
    (path,) = tmp_path.glob("*.contact")
    data = path.read_bytes()
    if damage == "truncated":
        path.write_bytes(data[: len(data) // 2])
    elif damage == "emptied":
        path.write_bytes(b"")
    elif damage == "flipped":
        path.write_bytes(data[:5000] + bytes([data[5000] ^ 16]) + data[5001:])
    elif damage == "another":
        solve(replace(contact, load_parameter=12.0), SolverOptions(points=33))
        (other,) = set(tmp_path.glob("*.contact")) - {path}
        path.write_bytes(other.read_bytes())
    elif damage == "text":
        path.write_text("no contact")
    else:
        path.write_bytes(pickle.dumps([1, 2, 3]))
    again = solve(contact, SolverOptions(points=33))
    assert np.array_equal(first.P, again.P)
    assert f"{path}: damaged; the contact is solved anew" in capsys.readouterr().err
    solve(contact, SolverOptions(points=33))
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("suffix", ["record", ".nc"])
def test_a_damaged_point_is_told_and_computed_anew(suffix, tmp_path, capsys):
    text = 'case = "ball_on_disc"\nfields = true\n[sweep]\n"contact.load_N" = [10.0, 11.0]\n"ehl.points" = [33]\n'
    sweep = sweep_from_text(text, "sweep.toml")
    run_batch(sweep, tmp_path / "out", HerePool)
    if suffix == "record":
        path, told = tmp_path / "out" / "points.sqlite", "1 points are damaged; they are computed anew"
        damage(path, sweep.points[0].key)
    else:
        path, told = tmp_path / "out" / "points" / f"{sweep.points[0].key}.nc", "damaged; the point is computed anew"
        data = path.read_bytes()
        path.write_bytes(data[:-90] + bytes([data[-90] ^ 1]) + data[-89:])
    pool = HerePool()
    batch = run_batch(sweep, tmp_path / "out", lambda: pool, PointSelection(resume=True))
    assert pool.handed_out == [sweep.points[0].key]
    assert batch.resumed == {sweep.points[1].key}
    assert f"{path}: {told}" in capsys.readouterr().err
    assert [point.status for point in load_results(batch).points] == ["done"] * 2


def test_film_maps_are_kept_where_they_are_wanted(tmp_path):
    text = 'case = "ball_on_disc"\nfields = true\n[sweep]\n"contact.load_N" = [10.0]\n"ehl.points" = [33]\n'
    sweep = sweep_from_text(text, "sweep.toml")
    run_batch(sweep, tmp_path / "out", HerePool)
    path = tmp_path / "out" / "points" / f"{sweep.points[0].key}.nc"
    with postprocess.open_results(path) as tree:
        film = tree["contacts/contact"]["h"]
        assert film.attrs["units"] == "m"
        assert math.isfinite(film.values.min())


def test_slip_maps_are_points_too(tmp_path):
    text = 'case = "hirano_7000C"\ncompute = "slip"\n[sweep]\n"slip.points" = [3]\n"slip.critical_points" = [2]\n'
    batch = run_batch(sweep_from_text(text, "sweep.toml"), tmp_path / "out", HerePool)
    (point,) = load_results(batch).points
    assert point.status == "done", point.message
    assert "minimum_loads" in json.dumps(point.summary) or point.summary["converged"]


def test_a_worker_of_another_version_is_refused(tmp_path):
    task = Task(
        key="a", document={}, compute="run", fields=False, share_contacts=False, folder=str(tmp_path), program="0.0.0"
    )
    with pytest.raises(RuntimeError, match=r"started with code 0\.0\.0"):
        compute_point(task)


@pytest.mark.slow
def test_a_worker_without_the_folder_sends_its_files(tmp_path):
    sweep = sweep_from_text(QUICK, "sweep.toml")

    class Elsewhere(HerePool):
        shares_folder = False

        def submit(self, block):
            assert block[0].folder is None
            return super().submit(block)

    apart = load_results(run_batch(sweep, tmp_path / "apart", Elsewhere))
    here = load_results(run_batch(sweep, tmp_path / "here", HerePool))
    write_batch(apart, tmp_path / "apart")
    write_batch(here, tmp_path / "here")
    assert (tmp_path / "apart" / "batch.csv").read_bytes() == (tmp_path / "here" / "batch.csv").read_bytes()


def test_rate_and_time_left():
    told = []
    pace = ProgressEstimate(10, lambda *words: told.append(words))
    pace.resumed = 2
    pace.report()
    assert told == [(2, 10, "points")]
    pace.done = 4
    assert pace.text(8.0) == "points, 30/min, 8 s left"
    assert pace.text(0.5) == "points, 8/s, 0 s left"
    assert [duration(t) for t in (61.0, 300.0, 36_000.0)] == ["61 s", "5 min", "10.0 h"]


def test_addresses_without_a_host_are_of_this_machine():
    assert scheduler_address("8786") == "tcp://127.0.0.1:8786"
    assert scheduler_address("node7") == "tcp://node7:8786"
    assert scheduler_address("tls://node7:9000") == "tls://node7:9000"


@pytest.mark.slow
def test_processes_give_the_same_as_one_after_the_other(tmp_path):
    sweep = sweep_from_text(QUICK, "sweep.toml")
    two = load_results(run_batch(sweep, tmp_path / "two", lambda: LocalPool(2)))
    one = load_results(run_batch(sweep, tmp_path / "one", HerePool))
    write_batch(two, tmp_path / "two")
    write_batch(one, tmp_path / "one")
    assert (tmp_path / "two" / "batch.csv").read_bytes() == (tmp_path / "one" / "batch.csv").read_bytes()


def test_the_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "quick.toml").write_text(QUICK)
    monkeypatch.setattr("oilfilm.cases.cli.batch._pool", lambda plan, wanted: HerePool)
    answer = CliRunner().invoke(app, ["batch", "quick.toml", "--json"])
    assert answer.exit_code == 0, answer.output
    document = json.loads(answer.stdout)
    assert [point["converged"] for point in document["points"]] == [True] * 6
    assert document["resumed"] == document["failed"] == 0
    assert document["points"][0]["keys"]["operation.radial_load_N"] == 400.0
    assert [path.name for path in tmp_path.iterdir()] == ["quick.toml"]
    answer = CliRunner().invoke(app, ["batch", "quick.toml", "--plot"])
    assert answer.exit_code == 0, answer.output
    assert (tmp_path / "quick_results" / "plots" / "over_keys.png").exists()
    assert max(map(len, answer.stdout.splitlines())) <= 80
    assert CliRunner().invoke(app, ["batch", "quick.toml"]).exit_code == 2
    answer = CliRunner().invoke(app, ["batch", "quick.toml", "--resume", "--json"])
    assert json.loads(answer.stdout)["resumed"] == 6
    answer = CliRunner().invoke(app, ["batch", "quick.toml", "--workers", "2", "--scheduler", "8786"])
    assert answer.exit_code == 2


def test_validate_init_and_list_know_sweeps(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(app, ["init", "mine", "--from", "6208_load_and_speed"]).exit_code == 0
    assert CliRunner().invoke(app, ["validate", "mine.toml", "6208_load_and_speed"]).exit_code == 0
    (tmp_path / "mine.toml").write_text(QUICK.replace("5000.0", "5e9"))
    answer = CliRunner().invoke(app, ["validate", "mine.toml"])
    assert answer.exit_code == 2
    assert "mine.toml:4: sweep" in answer.stderr
    assert "6208_load_and_speed" in CliRunner().invoke(app, ["list", "sweeps"]).stdout
    answer = CliRunner().invoke(app, ["run", "mine.toml"])
    assert "oilfilm batch" in answer.stderr


@pytest.mark.slow
def test_a_lost_point_is_the_machines_failure(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "quick.toml").write_text(QUICK)
    key = read_sweep("quick.toml").points[3].key
    monkeypatch.setattr("oilfilm.cases.cli.batch._pool", lambda plan, wanted: lambda: HerePool([key], times=2))
    answer = CliRunner().invoke(app, ["batch", "quick.toml", "-q"])
    assert answer.exit_code == 4
    assert "1 of 6 points have no result" in answer.stderr
    assert stored(tmp_path / "quick_results").status[key] == "lost"


def test_a_shipped_sweep_is_found_by_name():
    assert len(read_sweep("6208_load_and_speed").points) == 16


def test_a_point_computed_twice_counts_once(tmp_path):
    """By two shards that know nothing of each other, say; a result counts before a failure, wherever it stands."""
    sweep = sweep_from_text(QUICK, "sweep.toml")
    run_batch(sweep, tmp_path / "out", HerePool)
    (record,) = stored(tmp_path / "out").records([sweep.points[0].key])
    with closing(PointStore(tmp_path / "out" / "points-1-of-2.sqlite")) as other:
        other.put(Record(key=record.key, status="failed", message="no room"))
    with closing(PointStore(tmp_path / "out" / "points.sqlite")) as own:
        own.put(Record(key=record.key, status="lost"))
    assert stored(tmp_path / "out").records([record.key]) == [record]
    assert finished(tmp_path / "out", sweep) == {point.key for point in sweep.points}


def test_only_tables_that_leave_contacts_alone_make_a_cache_worth_its_disk():
    assert "surface" in WITHOUT_CONTACTS
    assert "lubricant" not in WITHOUT_CONTACTS
