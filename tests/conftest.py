"""Seed of the rotating sample of slow tests, what processes of tests import, and kernels compiled before them."""

from __future__ import annotations

import gc
import os
import random
import sys
from collections import Counter, defaultdict
from datetime import date
from pathlib import Path

import pytest
from filelock import FileLock

from oilfilm.cases.runs.kernel_cache import compile_all
from oilfilm.cases.runs.processes import COLLECTED, own_packages

SEED = "OILFILM_SEED"
SAMPLED = "sample"  # mark of the slow tests that are drawn
SHARE = 0.1  # of the slow tests that are in the sample
LONGEST = (  # files with few tests that take tens of seconds; they come first, so that no worker ends with one alone
    *("regression/test_shipped_cases.py", "cases/runs/test_dynamics.py", "cases/batch/test_processes.py"),
    *("postprocess/scene/test_page.py", "cases/runs/test_open_results.py", "postprocess/test_full_disk.py"),
    *("ehl/solid/bodies/test_compliance.py", "ehl/solid/bodies/test_surface_difference.py"),
    *("postprocess/scene/test_ring_deformed.py", "postprocess/scene/test_animation.py"),
    *("ehl/traction/table/test_temperature.py", "ehl/multigrid/test_hard_contacts.py"),
    *("cases/cli/test_signals_and_streams.py", "cases/batch/test_batch.py", "ehl/traction/heated/test_heated.py"),
)


def pytest_configure(config):
    """Before workers start: they inherit the seed; and two of them with two threads each would be four."""
    os.environ.setdefault(SEED, date.today().strftime("%Y%m%d"))
    os.environ.update(own_packages())  # processes of tests import what is tested
    gc.set_threshold(COLLECTED)
    config.option.loadscopereorder = False  # the order of the files is that of `longest_first`
    if getattr(config.option, "numprocesses", None):
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        compile_all()  # else each worker would compile the same kernels


def pytest_terminal_summary(terminalreporter, config):
    """What to set for the same sample again."""
    if SAMPLED in config.option.markexpr:
        terminalreporter.write_line(f"for the same sample again: {SEED}={os.environ[SEED]}")


@pytest.hookimpl(wrapper=True)
def pytest_collection_modifyitems(items, config):
    """Mark the sample before tests are chosen by their marks; files that take long come first."""
    draw_sample(items)
    yield
    if getattr(config.option, "numprocesses", None) or hasattr(config, "workerinput"):
        longest_first(items)


def pytest_collection_finish():
    """What was imported and collected is no garbage: the collector need not look through it again."""
    gc.freeze()


def longest_first(items):
    """Files with slow tests and those of `LONGEST` before the others, which go by their number of tests."""
    tests = Counter(item.location[0] for item in items)
    slow = {item.location[0] for item in items if item.get_closest_marker("slow")}
    slow |= {f"tests/{name}" for name in LONGEST}
    items.sort(key=lambda item: (item.location[0] not in slow, -tests[item.location[0]]))


def draw_sample(items):
    """Mark as `sample` a tenth of the slow tests, drawn file by file, another one every day."""
    slow = defaultdict(list)
    for item in items:
        if item.get_closest_marker("slow"):
            slow[item.location[0]].append(item)
    for name, tests in slow.items():
        draw = random.Random(f"{os.environ[SEED]} {name}")
        whole, part = divmod(SHARE * len(tests), 1.0)
        for item in draw.sample(tests, int(whole) + (draw.random() < part)):
            item.add_marker(SAMPLED)


@pytest.fixture(scope="session")
def shared(tmp_path_factory, worker_id):
    """Function `shared(name, make)`: the file or folder that `make(path)` writes, once for all workers."""
    base = tmp_path_factory.getbasetemp()
    folder = base if worker_id == "master" else base.parent

    def file(name, make):
        path = folder / name
        with FileLock(folder / f"{name}.lock"):
            if not path.exists():
                make(path)
        return path

    return file


def pytest_sessionfinish(session):
    """After the last test of a process: nothing of the product was loaded under a second name."""
    root = Path(__file__).resolve().parents[1]
    parts = [root / part for part in ("ehl", "bearing", "postprocess", "cases")]
    files = {
        name: Path(file).resolve()
        for name, module in list(sys.modules.items())
        if (file := getattr(module, "__file__", None))
    }
    bare = [
        name for name, path in files.items() if any(map(path.is_relative_to, parts)) and not name.startswith("oilfilm.")
    ]
    if bare:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
        raise pytest.UsageError(f"second copies of the product were imported: {', '.join(sorted(bare))}")
