"""A copy of the repository in which tests run, and the processes that run them."""

from __future__ import annotations

import importlib
import multiprocessing
import os
import shutil
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
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
    """A run of pytest in a fork, in a process group of its own."""

    def __init__(self, tree: Path, tests: list[str], plugin: Callable[[], Any]) -> None:
        context = multiprocessing.get_context("fork")
        self.answer, end = context.Pipe(duplex=False)
        self.process = context.Process(target=_pytest, args=(tree, tests, plugin, end))
        self.process.start()
        end.close()

    def result(self, longest: float | None) -> tuple[int | None, Any]:
        """Exit code of pytest, None after the longest time [s]; and what its plugin found."""
        found = None
        try:
            if self.answer.poll(longest):
                found = self.answer.recv()
            else:
                return None, None
        except EOFError:
            pass
        finally:
            self.process.join(10.0 if found is not None else 0.0)
            with suppress(ProcessLookupError):
                os.killpg(self.process.pid or 0, signal.SIGKILL)  # also what it started
            self.process.join()
        return (LOST, None) if found is None else found


def _pytest(tree: Path, tests: list[str], plugin: Callable[[], Any], end: Connection) -> None:
    """Of the process of one run: silent, in the copy."""
    os.setsid()
    os.chdir(tree)
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    try:
        own = plugin()
        end.send((int(pytest.main([*OPTIONS, *tests], plugins=[own])), own.found))
    finally:
        os._exit(LOST)
