"""A copy of the repository in which tests run, and the processes that run them."""

from __future__ import annotations

import importlib
import multiprocessing
import os
import resource
import shutil
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from math import ceil
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
LAYERS = ("ehl", "bearing", "postprocess", "cases", "oilfilm")
COPIED = (*LAYERS, "docs", "tests", "tools", "pyproject.toml", "README.md", "CONTRIBUTING.md")
LIBRARIES = (
    "numpy scipy.optimize scipy.special scipy.sparse.linalg scipy.interpolate scipy.integrate scipy.stats "
    "numba pydantic rich.table typer typer.testing xarray h5netcdf h5py"
).split()  # not plugins of pytest
OPTIONS = ["-q", "-n", "0", "-p", "no:cacheprovider"]
WAITED = 20.0  # for a run on a machine with other work, times the time that it may compute [-]
LOST = 99  # exit code of a run that pytest did not end itself


def copy_tree(target: Path) -> Path:
    """The tree with its compiled kernels, whose source keeps its time."""
    for name in COPIED:
        source = ROOT / name
        (shutil.copytree if source.is_dir() else shutil.copy2)(source, target / name)
    return target


def modules(root: Path = ROOT) -> list[str]:
    """Files of the product, from the root."""
    return sorted(path.relative_to(root).as_posix() for layer in LAYERS for path in (root / layer).rglob("*.py"))


def load_libraries(tree: Path) -> None:
    """Import once, for all forks, what others wrote, and nothing of the product's."""
    os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    os.environ["PYTHONPATH"] = str(tree)
    sys.dont_write_bytecode = True
    sys.path[:] = [str(tree), *(place for place in sys.path if Path(place).resolve() != ROOT)]
    for name in LIBRARIES:
        importlib.import_module(name)


class Fork:
    """A run of pytest in a fork, in a process group of its own, and at most so many seconds of a processor."""

    def __init__(self, tree: Path, tests: list[str], plugin: Callable[[], Any], longest: float) -> None:
        context = multiprocessing.get_context("fork")
        self.answer, end = context.Pipe(duplex=False)
        self.process = context.Process(target=_pytest, args=(tree, tests, plugin, longest, end))
        self.process.start()
        self.longest = longest
        end.close()

    def result(self) -> tuple[int | None, Any]:
        """Exit code of pytest, None after the longest time; and what its plugin found."""
        found = None
        try:
            if self.answer.poll(WAITED * self.longest):
                found = self.answer.recv()
            else:
                return None, None
        except EOFError:
            pass
        finally:
            self.process.join(10.0)
            with suppress(ProcessLookupError):
                os.killpg(self.process.pid or 0, signal.SIGKILL)  # also what it started
            self.process.join()
        if found is None:
            return (None if self.process.exitcode == -signal.SIGXCPU else LOST), None
        return found


def _pytest(tree: Path, tests: list[str], plugin: Callable[[], Any], longest: float, end: Connection) -> None:
    """Of the process of one run: silent, in the copy."""
    os.setsid()
    resource.setrlimit(resource.RLIMIT_CPU, (ceil(longest), ceil(longest) + 60))
    os.chdir(tree)
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    try:
        own = plugin()
        end.send((int(pytest.main([*OPTIONS, *tests], plugins=[own])), own.found))
    finally:
        os._exit(LOST)
