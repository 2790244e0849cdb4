"""Batches in shares, at the same time, of a hundred thousand points, within limits, on executors of the user's."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest
from typer.testing import CliRunner

from oilfilm.cases import CaseError
from oilfilm.cases.batch import results as batch_results
from oilfilm.cases.batch.compute import compute_point, failure, limited
from oilfilm.cases.batch.engine import PointSelection, computed_before, run_batch
from oilfilm.cases.batch.keys import digest, program_digest, program_sources
from oilfilm.cases.batch.points import Limits
from oilfilm.cases.batch.pools import Pool, executor_factory
from oilfilm.cases.batch.results import collect_results, load_results, write_batch
from oilfilm.cases.batch.sweep import Shard, shard_of, sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.runs.output_directory import one_writer
from oilfilm.postprocess.batch.packed_columns import InMemory, columns_of
from oilfilm.postprocess.batch.store import FAILED, read_batch, stored_summaries
from oilfilm.postprocess.batch.write import write_batch_parquet

from .test_batch import HEAD, QUICK, HerePool, stored

MANY = """
case = "6208_full_ceramic"
[fixed]
"ehl.film_maps" = "none"
[sweep]
"operation.inner_speed_rpm" = {speeds}
"operation.radial_load_N" = [400.0, 900.0, 1750.0, 3000.0]
"""


def files(folder):
    """Content of the files that depend on the input alone."""
    return {name: (folder / name).read_bytes() for name in ("batch.csv", "results.nc")}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A batch computed in one piece, its folder and its sweep."""
    folder = tmp_path_factory.mktemp("whole") / "out"
    sweep = sweep_from_text(QUICK, "sweep.toml")
    write_batch(load_results(run_batch(sweep, folder, HerePool)), folder)
    return folder, sweep


def test_every_point_belongs_to_one_shard():
    keys = [digest(str(k)) for k in range(1000)]
    shards = [shard_of(f"{i}/7") for i in range(1, 8)]
    counts = [sum(shard.has(key) for key in keys) for shard in shards]
    assert sum(counts) == 1000 and min(counts) > 100
    assert [sum(shard.has(key) for shard in shards) for key in keys] == [1] * 1000
    assert shard_of("3/8") == Shard(3, 8)
    for wrong in ("0/8", "9/8", "3", "a/b", "-1/8", "1/1000000"):
        with pytest.raises(CaseError, match="allowed: I/N"):
            shard_of(wrong)


def test_shards_give_the_same_files_to_the_byte(whole, tmp_path):
    folder, sweep = whole
    for number in (3, 1, 2):
        run_batch(sweep, tmp_path / "out", HerePool, PointSelection(shard=Shard(number, 3)))
    batch = computed_before(sweep, tmp_path / "out")
    assert len(batch.resumed) == 6
    write_batch(load_results(batch), tmp_path / "out")
    assert files(folder) == files(tmp_path / "out")
    nothing = HerePool()
    run_batch(
        sweep, tmp_path / "out", lambda: nothing, PointSelection(shard=Shard(1, 2))
    )  # cut otherwise: all is there
    assert nothing.handed_out == []


def test_a_shard_that_is_written_is_refused_and_others_are_not(whole, tmp_path):
    _, sweep = whole
    out = tmp_path / "out"
    out.mkdir()
    (out / "sweep.toml").touch()
    with one_writer(out / Shard(1, 2).file):
        with pytest.raises(CaseError, match="another oilfilm is writing there"):
            run_batch(sweep, out, HerePool, PointSelection(shard=Shard(1, 2)))
        run_batch(sweep, out, HerePool, PointSelection(shard=Shard(2, 2)))


def test_a_whole_batch_waits_for_no_shard(tmp_path):
    """Shards hold the folder together; a batch that wants it for itself is refused, and the other way round."""
    out = tmp_path / "out"
    with one_writer(out, shared=True), one_writer(out, shared=True):
        refused = pytest.raises(CaseError, match="another oilfilm")
        with refused, one_writer(out):
            pass
    refused = pytest.raises(CaseError, match="another oilfilm")
    with one_writer(out), refused, one_writer(out, shared=True):
        pass
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_the_command_in_shards(whole, tmp_path, monkeypatch):
    folder, _ = whole
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("oilfilm.cases.cli.batch._pool", lambda plan, wanted: HerePool)
    (tmp_path / "quick.toml").write_text(QUICK)
    assert CliRunner().invoke(app, ["batch", "quick.toml", "--collect"]).exit_code == 2
    first = CliRunner().invoke(app, ["batch", "quick.toml", "--shard", "1/2", "--json"])
    assert first.exit_code == 0, first.output
    counts = json.loads(first.stdout)
    assert counts["shard"] == "1-of-2" and 0 < counts["done"] == counts["points"] < 6
    part = CliRunner().invoke(app, ["batch", "quick.toml", "--collect", "--json"])
    assert part.exit_code == 1  # it is told which points are missing
    assert json.loads(part.stdout)["counts"]["missing"] == 6 - counts["done"]
    assert CliRunner().invoke(app, ["batch", "quick.toml", "--shard", "2/2", "-q"]).exit_code == 0
    answer = CliRunner().invoke(app, ["batch", "quick.toml", "--collect", "--parquet", "--json"])
    assert answer.exit_code == 0, answer.output
    assert json.loads(answer.stdout)["counts"]["done"] == 6
    assert files(folder) == files(tmp_path / "quick_results")
    assert CliRunner().invoke(app, ["batch", "quick.toml", "--shard", "3/2"]).exit_code == 2
    assert CliRunner().invoke(app, ["batch", "quick.toml", "--shard", "1/2", "--plot"]).exit_code == 2


def test_only_failed_points_are_computed_again(tmp_path, monkeypatch):
    sweep = sweep_from_text(QUICK, "sweep.toml")
    original = compute_point

    def failing(task, tables=None):
        bad = task.document["operation"]["radial_load_N"] == 900.0
        return original(task, tables) if not bad else batch_results_failure(task)

    def batch_results_failure(task):
        from oilfilm.cases.batch.compute import failure

        return failure(task.key, "failed", "not today")

    with monkeypatch.context() as patch:
        patch.setattr("oilfilm.cases.batch.compute.compute_point", failing)
        with pytest.raises(KeyboardInterrupt):
            run_batch(sweep, tmp_path / "out", lambda: HerePool(stop_after=5))
    pool = HerePool()
    run_batch(sweep, tmp_path / "out", lambda: pool, PointSelection(only_failed=True))
    assert sorted(pool.handed_out) == sorted(
        p.key for p in sweep.points if p.values["operation.radial_load_N"] == 900.0
    )
    assert [stored(tmp_path / "out").status.get(p.key) for p in sweep.points] == ["done"] * 5 + [None]


@pytest.mark.slow
def test_a_large_sweep_is_planned_by_a_sample_and_its_ends():
    speeds = [1000.0 + k for k in range(3000)]
    sweep = sweep_from_text(MANY.format(speeds=speeds), "sweep.toml")
    assert len(sweep.points) == 12_000
    assert sweep.points[-1].given == {"operation.inner_speed_rpm": 3999.0, "operation.radial_load_N": 3000.0}
    assert len({point.key for point in sweep.points}) == 12_000
    few = sweep_from_text(MANY.format(speeds=speeds[:2]), "sweep.toml")
    assert [p.key for p in few.points] == [p.key for p in sweep.points[:8]]  # names do not depend on the others
    with pytest.raises(CaseError, match=r"sweep.toml:6: .*found 20000000\.0"):  # the last of a list is checked
        sweep_from_text(MANY.format(speeds=[*speeds, 2e7]), "sweep.toml")


def test_whole_numbers_and_floats_are_the_same_point():
    one = sweep_from_text(HEAD + '[sweep]\n"operation.radial_load_N" = [400, 900]\n', "sweep.toml")
    other = sweep_from_text(HEAD + '[sweep]\n"operation.radial_load_N" = [900.0, 400.0]\n', "sweep.toml")
    assert {p.key for p in one.points} == {p.key for p in other.points}


def test_a_point_that_cannot_be_a_case_fails_with_its_message(tmp_path, monkeypatch):
    """In a sweep too large to check all of it: the others are computed."""
    monkeypatch.setattr("oilfilm.cases.batch.sweep.CHECKED", 1)
    text = HEAD + '[fixed]\n"ehl.film_maps" = "none"\n[sweep]\n"bearing.balls" = [8, 40, 9]\n'
    monkeypatch.setattr("oilfilm.cases.batch.sweep._checked_indices", lambda plan, every: [0])
    results = load_results(run_batch(sweep_from_text(text, "sweep.toml"), tmp_path / "out", HerePool))
    assert [point.status for point in results.points] == ["done", "failed", "done"]
    assert "at most 15 balls" in results.points[1].message
    assert [point.values["bearing.balls"] for point in results.points] == [8, 40, 9]


@pytest.mark.slow
def test_a_batch_too_large_for_memory_has_the_same_columns(whole, tmp_path, monkeypatch):
    """Written some points at a time; counts in place of a list of points."""
    folder, sweep = whole
    out = tmp_path / "out"
    batch = run_batch(sweep, out, HerePool)
    monkeypatch.setattr(batch_results, "LARGE", 2)
    monkeypatch.setattr(batch_results, "CHUNK", 4)
    with collect_results(batch) as (results, columns):
        write_batch(results, out, columns, {"batch.parquet": write_batch_parquet})
        assert not results.points
    assert (out / "batch.csv").read_bytes() == (folder / "batch.csv").read_bytes()
    document = json.loads((out / "summary.json").read_text())
    assert document["points"] is None
    assert document["counts"] == {"points": 6, "done": 6, "failed": 0, "lost": 0, "missing": 0, "converged": 6}
    assert any(message.startswith("points: null") for message in document["messages"])
    with pytest.raises(ValueError, match=r"6 points, which are read from its results\.nc"):
        read_batch(out)
    assert len(dict(stored_summaries(out))) == 6


def test_parquet_has_the_table_with_types_and_units(whole, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    folder, _ = whole
    columns = columns_of(InMemory(read_batch(folder)))
    write_batch_parquet(columns, tmp_path / "batch.parquet")
    table = parquet.read_table(tmp_path / "batch.parquet")
    assert table.num_rows == 6
    assert table.column("operation.radial_load_N").to_pylist() == [400.0, 900.0, 1750.0] * 2
    assert table.schema.field("torque_N_mm").metadata == {b"units": b"N mm"}
    assert str(table.schema.field("converged").type) == "bool"
    assert table.column("film_minimum_um").null_count == 0


def test_a_point_beyond_its_time_fails(tmp_path):
    start = time.monotonic()
    with pytest.raises(TimeoutError, match=r"longer than its 0\.05 s"), limited(Limits(seconds=0.05)):
        time.sleep(20.0)
    assert time.monotonic() - start < 10.0
    with limited(Limits(seconds=60.0)):
        pass


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the limit is of the kernel")
def test_a_point_beyond_its_memory_fails():
    words = "from oilfilm.cases.batch.compute import limited; from oilfilm.cases.batch.points import Limits\n"
    words += "import numpy\nwith limited(Limits(memory=0.2)):\n    numpy.ones(10**8)\n"
    answer = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, check=False)
    assert "MemoryError" in answer.stderr


@pytest.mark.slow
def test_a_point_within_limits_is_the_same(whole, tmp_path):
    folder, sweep = whole
    limits = Limits(seconds=120.0, memory=4.0)
    batch = run_batch(sweep, tmp_path / "out", HerePool, PointSelection(limits=limits))
    write_batch(load_results(batch), tmp_path / "out")
    assert files(folder) == files(tmp_path / "out")


@pytest.mark.slow
def test_an_executor_of_the_users_own(whole, tmp_path, monkeypatch):
    folder, sweep = whole
    (tmp_path / "mine.py").write_text(
        "from concurrent.futures import ThreadPoolExecutor\n\ndef make():\n    return ThreadPoolExecutor(1)\n\n"
        "def nothing():\n    return 1\n\ndef fails():\n    raise RuntimeError('no nodes free')\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    batch = run_batch(sweep, tmp_path / "out", lambda: Pool(executor_factory("mine:make")))
    write_batch(load_results(batch), tmp_path / "out")
    assert files(folder) == files(tmp_path / "out")
    for wrong in ("mine", "mine:other", "no_such_module:make", "mine:nothing"):
        with pytest.raises(CaseError, match="a function that makes a concurrent"):
            executor_factory(wrong)()
    with pytest.raises(CaseError, match=r"--executor mine:fails: .* RuntimeError: no nodes free"):
        executor_factory("mine:fails")()


@pytest.mark.slow
def test_a_folder_without_a_point_is_no_earlier_batch(whole, tmp_path, monkeypatch):
    (tmp_path / "late.py").write_text("def fails():\n    raise RuntimeError('no nodes free')\n")
    monkeypatch.syspath_prepend(tmp_path)
    folder, sweep = whole
    with pytest.raises(CaseError):
        run_batch(sweep, tmp_path / "out", lambda: Pool(executor_factory("late:fails")))
    write_batch(load_results(run_batch(sweep, tmp_path / "out", HerePool)), tmp_path / "out")
    assert files(folder) == files(tmp_path / "out")


def test_results_are_written_where_every_point_failed(tmp_path, monkeypatch):
    monkeypatch.setattr(
        "oilfilm.cases.batch.compute.compute_point", lambda task, tables=None: failure(task.key, FAILED, "no")
    )
    sweep = sweep_from_text(QUICK, "sweep.toml")
    with collect_results(run_batch(sweep, tmp_path / "out", HerePool)) as (results, columns):
        write_batch(results, tmp_path / "out", columns)
        write_batch_parquet(columns, tmp_path / "out" / "batch.parquet")
    lines = (tmp_path / "out" / "batch.csv").read_text().splitlines()
    assert len(lines) == len(sweep.points) + 1
    assert all(",failed," in line for line in lines[1:])


def test_points_travel_in_blocks_of_some_seconds(monkeypatch):
    class Instant(ThreadPoolExecutor):
        def submit(self, *words):
            future = Future()
            clock[0] += 0.1 * len(words[1])
            future.set_result(())
            return future

    clock = [0.0]
    monkeypatch.setattr("oilfilm.cases.batch.pools.monotonic", lambda: clock[0])
    pool = Pool(Instant)
    assert pool.block() == 1
    pool.submit((None,))
    assert pool.block() == 200  # of 0.1 s each


def test_the_code_is_part_of_the_name(monkeypatch):
    sources = [path.name for path in program_sources()]
    assert "solver.py" in sources and "film_atlas.npz" in sources
    assert not [path for path in program_sources() if "cli" in Path(path).parts]
    assert len(program_digest()) == 16
    before = sweep_from_text(QUICK, "sweep.toml").points[0].key
    monkeypatch.setattr("oilfilm.cases.batch.plan.program_digest", lambda: "another")
    assert sweep_from_text(QUICK, "sweep.toml").points[0].key != before


def test_a_file_that_a_case_reads_is_part_of_the_name(tmp_path, monkeypatch):
    from oilfilm.cases.batch.plan import input_files

    document = {"friction": {"traction_table": str(tmp_path / "table.zip")}}
    assert list(input_files(document)) == [str(tmp_path / "table.zip")]
    found = set()
    for content in (b"one", b"another"):
        (tmp_path / "table.zip").write_bytes(content)
        found |= set(input_files(document))
    assert len(found) == 2
