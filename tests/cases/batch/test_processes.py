"""Batches in processes of their own: killed at random moments, on a Dask cluster, with workers that die."""

from __future__ import annotations

import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm import postprocess
from oilfilm.cases.batch import pools
from oilfilm.cases.batch.engine import run_batch
from oilfilm.cases.batch.pools import ClusterPool, LocalPool
from oilfilm.cases.batch.results import load_results, write_batch
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.cli.main import app

from .test_batch import HerePool

SEED = 60_413_871
SWEEP = """
case = "6208_full_ceramic"
[sweep]
"operation.inner_speed_rpm" = [2500.0, 5000.0, 7500.0, 10000.0]
"operation.radial_load_N" = [400.0, 900.0, 1750.0, 3000.0]
"ehl.points" = [65]
"""
FEW = """
case = "6208_full_ceramic"
[sweep]
"operation.inner_speed_rpm" = [2500.0, 5000.0, 7500.0]
"operation.radial_load_N" = [400.0, 1750.0]
"ehl.points" = [65]
"""
QUICK = FEW.replace('"ehl.points" = [65]', '"ehl.film_maps" = ["none"]')
ONE_BALL = '[fixed]\n"ehl.film_maps" = [0.0]\n'
OILFILM = [sys.executable, "-m", "oilfilm.cases.cli"]


def same_data(first, second):
    """Whether the data sets of two batches are equal to the bit."""
    with postprocess.open_results(first) as one, postprocess.open_results(second) as two:
        a, b = one.to_dataset(), two.to_dataset()
        assert set(a.variables) == set(b.variables)
        for name in a.variables:
            np.testing.assert_array_equal(a[name].values, b[name].values, err_msg=name)
    assert (first / "batch.csv").read_bytes() == (second / "batch.csv").read_bytes()


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def children(pid):
    answer = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True, check=False)
    return [int(word) for word in answer.stdout.split()]


@pytest.mark.slow
@pytest.mark.skipif(not os.path.isdir("/proc"), reason="looks for left workers in /proc")
def test_a_batch_killed_ten_times_ends_like_an_undisturbed_one(tmp_path):
    (tmp_path / "sweep.toml").write_text(SWEEP + ONE_BALL)
    words = [*OILFILM, "batch", str(tmp_path / "sweep.toml"), "-q", "--workers", "2"]
    start = time.monotonic()
    subprocess.run([*words, "-o", "calm"], cwd=tmp_path, check=True)
    whole = time.monotonic() - start
    rng, kills, orphans = random.Random(SEED), 0, []
    while kills < 10:
        process = subprocess.Popen([*words, "-o", "killed", "--resume"], cwd=tmp_path, stderr=subprocess.DEVNULL)
        try:
            process.wait(rng.uniform(0.1, 0.6) * whole)
            with closing(sqlite3.connect(tmp_path / "killed" / "points.sqlite")) as file:
                file.execute("DELETE FROM points WHERE id % 2")  # it was done before it could be killed
                file.commit()
        except subprocess.TimeoutExpired:
            orphans += children(process.pid)
            process.send_signal(signal.SIGKILL)
            process.wait()
            kills += 1
    deadline = time.monotonic() + 60.0
    while any(map(alive, orphans)) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not [pid for pid in orphans if alive(pid)]  # the workers end with their parent
    subprocess.run([*words, "-o", "killed", "--resume"], cwd=tmp_path, check=True)
    same_data(tmp_path / "calm", tmp_path / "killed")
    assert not list((tmp_path / "killed" / "points").glob(".*"))


@pytest.mark.slow
def test_a_dask_cluster_of_two_workers_gives_the_same(tmp_path):
    distributed = pytest.importorskip("distributed")
    sweep = sweep_from_text(FEW, "sweep.toml")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        far = run_batch(sweep, tmp_path / "far", lambda: ClusterPool(cluster.scheduler_address))
        write_batch(load_results(far), tmp_path / "far")
    near = run_batch(sweep, tmp_path / "near", lambda: LocalPool(1))
    write_batch(load_results(near), tmp_path / "near")
    same_data(tmp_path / "far", tmp_path / "near")


@pytest.mark.slow
def test_a_dead_worker_of_a_cluster_costs_nothing(tmp_path):
    distributed = pytest.importorskip("distributed")
    sweep = sweep_from_text(SWEEP, "sweep.toml")
    killed = []

    class Killing(ClusterPool):
        done = 0

        def submit(self, block):
            self.done += 1
            if not killed and self.done >= 3:
                victim = next(iter(self._client.run(os.getpid).values()))
                os.kill(victim, signal.SIGKILL)
                killed.append(victim)
            return super().submit(block)

    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        results = load_results(run_batch(sweep, tmp_path / "out", lambda: Killing(cluster.scheduler_address)))
    assert killed
    assert [point.status for point in results.points] == ["done"] * 16


def test_a_worker_killed_from_outside(tmp_path):
    """The pool is rebuilt and every point gets its result."""

    class Killing(LocalPool):
        done = 0

        def submit(self, block):
            self.done += 1
            future = super().submit(block)
            if not killed and self.done >= 2:
                victim = next(iter(self._executor._processes))
                os.kill(victim, signal.SIGKILL)
                killed.append(victim)
            return future

    killed = []
    results = load_results(run_batch(sweep_from_text(QUICK, "sweep.toml"), tmp_path / "out", lambda: Killing(2)))
    assert killed
    assert [point.status for point in results.points] == ["done"] * 6


@pytest.mark.slow
def test_kernels_are_compiled_by_one_worker(tmp_path):
    """Until a first point is done none else is handed out; where it is known that they are compiled, all at once."""

    class Watched(LocalPool):
        def submit(self, block):
            at_hand.append((self._cold, sum(not future.done() for future in futures)))
            futures.append(super().submit(block))
            return futures[-1]

    sweep, stamp = sweep_from_text(QUICK, "sweep.toml"), tmp_path / "kernels" / "stamp"
    for cold in (True, False):
        at_hand, futures = [], []
        results = load_results(run_batch(sweep, tmp_path / str(cold), lambda: Watched(2, stamp)))
        assert [point.status for point in results.points] == ["done"] * 6
        assert at_hand[0] == (cold, 0)
        assert all(others == 0 for still, others in at_hand if still)
        assert max(others for _, others in at_hand) >= 2
        assert stamp.exists()


@pytest.mark.slow
def test_an_interrupt_ends_the_workers_and_keeps_the_points(tmp_path, monkeypatch):
    (tmp_path / "sweep.toml").write_text(FEW)
    words = [*OILFILM, "batch", str(tmp_path / "sweep.toml"), "-o", "out", "--workers", "1"]
    process = subprocess.Popen(words, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 240.0
    wal = tmp_path / "out" / "points.sqlite-wal"  # has 20 kB before the first point, then 10 to 30 kB with each
    while not (wal.exists() and wal.stat().st_size > 40_000) and time.monotonic() < deadline:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=240.0)
    assert process.returncode == 3
    assert "continue with --resume" in stderr
    assert "Traceback" not in stderr
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("oilfilm.cases.cli.batch._pool", lambda plan, wanted: HerePool)
    answer = CliRunner().invoke(app, [*words[len(OILFILM) :], "--resume", "--json"])
    assert answer.exit_code == 0
    document = json.loads(answer.stdout)
    assert 1 <= document["resumed"] < 6
    assert document["converged"] is True


@pytest.mark.slow
def test_workers_import_what_their_parent_does(tmp_path):
    """Not what bears the same name in the folder in which the command is given, where Python 3.11 looks first."""
    code = "if __name__ == '__main__':\n    from oilfilm import ehl; from oilfilm.cases.batch.pools import LocalPool\n"
    code += "    pool = LocalPool(1)\n"
    code += "    found = pool._executor.submit(eval, '__import__(\"oilfilm.ehl\").ehl.__file__').result()\n"
    code += "    pool.close(at_once=True); assert found == ehl.__file__, found"
    (tmp_path / "script.py").write_text(code)
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "ehl.py").write_text("")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    subprocess.run([sys.executable, "../script.py"], cwd=tmp_path / "here", env=environment, check=True)


def test_no_scheduler_is_told(monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("oilfilm.cases.batch.pools.PATIENCE", 1.0)
    answer = CliRunner().invoke(app, ["batch", "6208_load_and_speed", "--scheduler", "1", "--json"])
    assert answer.exit_code == 2
    assert "no Dask scheduler answers" in answer.stderr


def test_one_point_goes_first_where_kernels_are_not_compiled(tmp_path, monkeypatch):
    """Two workers and no mark of compiled kernels: one block at a time; with the mark, or alone, all at once."""
    monkeypatch.setattr(pools.LocalPool, "_processes", lambda self: ThreadPoolExecutor(self.workers))
    mark = tmp_path / "compiled"
    first = [pools.LocalPool(workers, mark).capacity() for workers in (2, 1)]
    mark.touch()
    assert first[0] == 1 < first[1] == pools.LocalPool(1, mark).capacity() < pools.LocalPool(2, mark).capacity()
