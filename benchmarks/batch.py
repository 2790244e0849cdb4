"""Speed of batches: films on one and on two workers, and torque points from ready traction tables.

    python benchmarks/batch.py                     # 48 points with films, one worker and two
    python benchmarks/batch.py --points 96
    python benchmarks/batch.py --table FILE        # 1000 torque points on two workers, tables of 6208_five_terms
    python benchmarks/batch.py --atlas 1000        # torque points of a 7012AC, films of the atlas
    python benchmarks/batch.py --atlas 1000 --heated    # the same with temperatures solved
    python benchmarks/batch.py --records 200000    # planning, resuming and collecting, without computing

`--records` computes one point, and stores its record under the names of all of them.

Wall times mean something on a quiet machine only; processor times, of all workers together, nearly always do: what
two workers take more of it than one is lost to sharing.
"""

from __future__ import annotations

import argparse
import json
import resource
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from oilfilm.cases.batch.engine import PointSelection, run_batch
from oilfilm.cases.batch.pools import LocalPool
from oilfilm.cases.batch.results import collect_results, write_batch
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.runs.processes import POINTS, fork_server
from oilfilm.postprocess.batch.store import PointStore, StoredPoints
from oilfilm.postprocess.batch.write import write_batch_csv, write_batch_parquet

FILMS = """
case = "6208_full_ceramic"
[fixed]
"ehl.points" = 129
[sweep]
"operation.radial_load_N" = {loads}
"""
TORQUE = """
case = "6208_five_terms"
compute = "torque"
table = {table!r}
[sweep]
"operation.inner_speed_rpm" = {speeds}
"operation.radial_load_N" = {loads}
"""
ATLAS = """
case = {case!r}
[latin_hypercube]
samples = {points}
seed = 7
"operation.inner_speed_rpm" = [2000.0, {fastest}]
"operation.axial_load_N" = [1000.0, 3000.0]
"operation.radial_load_N" = [0.0, 1000.0]
"""
OPEN = """
schema_version = 1
title = "7012AC"
bearing = {name = "7012AC"}
lubricant = {name = "iso vg 32"}
surface = {inner_ring_roughness_um = 0.05, outer_ring_roughness_um = 0.05, ball_roughness_um = 0.02}
ehl = {film_maps = "none"}
[operation]
inner_speed_rpm = 6000.0
axial_load_N = 2000.0
temperature_C = 60.0
%s
[friction]
lubrication = "oil jet"
oil_fraction = 0.05
%s
"""
HEAT = (
    'temperature = "self-heated"',
    "heat_transfer_W_K = 2.8\nambient_C = 25.0\ncooling_oil_mL_min = 900.0\ncooling_oil_C = 40.0",
)


RECORDS = """
case = "6208_full_ceramic"
[fixed]
"ehl.film_maps" = "none"
[sweep]
"operation.inner_speed_rpm" = {speeds}
"operation.radial_load_N" = {loads}
"""


@dataclass(frozen=True, slots=True)
class Cost:
    """Wall time, processor time of all workers [s], largest memory of one worker so far [MB]."""

    wall: float
    processor: float
    memory: float


def cost(text: str, workers: int, folder: Path) -> Cost:
    """What a whole batch takes, planning and files included."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    with fork_server(POINTS):  # whose children the workers are
        sweep = sweep_from_text(text, "sweep.toml")
        with collect_results(run_batch(sweep, folder, lambda: LocalPool(workers))) as (results, columns):
            write_batch(results, folder, columns)
        wall = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    failed = [point.message for point in results.points if point.status != "done"]
    assert not failed, failed[0]
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Cost(wall, spent, after.ru_maxrss / 1024.0)


def films(points: int, folder: Path) -> None:
    """Points with films on one worker, on two, and on one again, since other work on the machine comes and goes."""
    text = FILMS.format(loads=np.linspace(600.0, 3000.0, points).round(3).tolist())
    cost(FILMS.format(loads=[500.0]), 1, folder / "compiled")
    runs = {name: cost(text, workers, folder / name) for name, workers in (("1", 1), ("2", 2), ("1 again", 1))}
    for name, run in runs.items():
        print(
            f"{name:8} workers: {run.wall:6.1f} s, {run.processor:6.1f} s of processors, {run.memory:.0f} MB a worker"
        )
    one = 0.5 * (runs["1"].wall + runs["1 again"].wall)
    spent = 0.5 * (runs["1"].processor + runs["1 again"].processor)
    print(f"efficiency of two workers: {one / (2.0 * runs['2'].wall):.1%} by the clock, ", end="")
    print(f"{spent / runs['2'].processor:.1%} by processor time")


def torque(table: Path, folder: Path) -> None:
    """1000 torque points from ready tables on two workers."""
    speeds, loads = np.linspace(8000.0, 10000.0, 20).tolist(), np.linspace(1000.0, 3000.0, 50).tolist()
    text = TORQUE.format(table=str(table.resolve()), speeds=speeds, loads=loads)
    run = cost(text, 2, folder / "torque")
    print(f"1000 torque points: {run.wall:.1f} s, {run.processor:.1f} s of processors, {run.memory:.0f} MB a worker")


def atlas(points: int, heated: bool, folder: Path) -> None:
    """Torque points of a 7012AC with films of the atlas on two workers."""
    case = folder / "7012AC.toml"
    case.write_text(OPEN % (HEAT if heated else ("", "")), encoding="utf-8")
    first, whole = (ATLAS.format(case=str(case), points=n, fastest=8000.0 if heated else 12000.0) for n in (2, points))
    cost(first, 1, folder / "compiled")
    begun = time.process_time()
    run = cost(whole, 2, folder / "atlas")
    spent = time.process_time() - begun
    print(
        f"{points} torque points: {run.wall:.1f} s, {run.processor:.1f} s of processors of workers and "
        f"{spent:.1f} s of the main process, {run.memory:.0f} MB a worker"
    )


@contextmanager
def step(what: str) -> Iterator[None]:
    """Print what a step takes, and the memory of this process so far."""
    start, begun = time.perf_counter(), time.process_time()
    yield
    wall, spent = time.perf_counter() - start, time.process_time() - begun
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(f"{what:32} {wall:7.1f} s, {spent:7.1f} s of processor, {memory:6.0f} MB so far", flush=True)


def records(points: int, folder: Path) -> None:
    """A batch without films whose points are all there: planned, resumed, collected."""
    text = RECORDS.format(
        speeds=np.linspace(1000.0, 10000.0, points // 100).round(3).tolist(),
        loads=np.linspace(400.0, 3000.0, 100).round(3).tolist(),
    )
    with step("planned and named"):
        sweep = sweep_from_text(text, "sweep.toml")
        count = sum(1 for _ in sweep.points)
    small = sweep_from_text(RECORDS.format(speeds=[5000.0], loads=[900.0]), "sweep.toml")
    run_batch(small, folder / "one", lambda: LocalPool(1))
    (record,) = StoredPoints([folder / "one" / "points.sqlite"]).records([small.points[0].key])
    whole = folder / "whole"
    whole.mkdir()
    (whole / "sweep.toml").touch()
    with step("records stored"):
        store = PointStore(whole / "points.sqlite")
        for point in sweep.points:
            store.put(replace(record, key=point.key, values=json.dumps(point.given)))
        store.close()
    with step("resumed, planning included"):
        again = sweep_from_text(text, "sweep.toml")
        batch = run_batch(again, whole, lambda: LocalPool(1), PointSelection(resume=True))
    assert len(batch.resumed) == count
    with ExitStack() as stack:
        with step("collected: results.nc, summary"):
            results, columns = stack.enter_context(collect_results(batch))
            write_batch(results, whole, columns, table=False)
        with step("batch.parquet"):
            write_batch_parquet(columns, whole / "batch.parquet")
        with step("batch.csv"):
            write_batch_csv(columns, whole / "batch.csv")
    for file in sorted(whole.glob("*.*")):
        print(f"{file.name:20} {file.stat().st_size / count:8.0f} bytes a point")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--points", type=int, default=48)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--atlas", type=int)
    parser.add_argument("--heated", action="store_true")
    parser.add_argument("--records", type=int)
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        if chosen.records is not None:
            records(chosen.records, Path(temporary))
        elif chosen.atlas is not None:
            atlas(chosen.atlas, chosen.heated, Path(temporary))
        elif chosen.table is not None:
            torque(chosen.table, Path(temporary))
        else:
            films(chosen.points, Path(temporary))
