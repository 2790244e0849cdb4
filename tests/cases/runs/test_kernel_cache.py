"""A folder for compiled kernels when neither the installation nor the home directory can be written."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from oilfilm.cases.runs import kernel_cache
from oilfilm.cases.runs.kernel_cache import VARIABLE, compiled_stamp, ensure_kernel_cache


@pytest.fixture
def nothing_writable(monkeypatch, tmp_path):
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.delenv("MPLCONFIGDIR", raising=False)
    monkeypatch.setattr(kernel_cache, "_beside_the_package", lambda: False)
    monkeypatch.setattr(kernel_cache, "_in_the_home_directory", lambda: False)
    monkeypatch.setattr(kernel_cache.tempfile, "gettempdir", lambda: str(tmp_path))
    yield tmp_path
    os.environ.pop(VARIABLE, None)
    os.environ.pop("MPLCONFIGDIR", None)


def test_a_private_folder_is_used(nothing_writable):
    ensure_kernel_cache()
    folder = Path(os.environ[VARIABLE])
    assert folder.parent == nothing_writable
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    first = os.environ.pop(VARIABLE)
    ensure_kernel_cache()
    assert os.environ[VARIABLE] == first


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="permission bits of POSIX")
def test_a_folder_that_others_can_write_is_not_trusted(nothing_writable):
    planted = nothing_writable / f"oilfilm-kernels-{os.getuid()}"
    planted.mkdir()
    planted.chmod(0o777)
    ensure_kernel_cache()
    assert Path(os.environ[VARIABLE]) != planted


def test_the_choice_of_the_user_stands(nothing_writable, monkeypatch):
    monkeypatch.setenv(VARIABLE, "/somewhere")
    ensure_kernel_cache()
    assert os.environ[VARIABLE] == "/somewhere"


def test_nothing_is_set_where_numba_finds_a_place(monkeypatch):
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr(kernel_cache, "_in_the_home_directory", lambda: True)
    ensure_kernel_cache()
    assert VARIABLE not in os.environ


def test_the_folder_beside_the_package_is_enough_for_numba(nothing_writable, monkeypatch):
    monkeypatch.setattr(kernel_cache, "_beside_the_package", lambda: True)
    ensure_kernel_cache()
    assert VARIABLE not in os.environ
    assert Path(os.environ["MPLCONFIGDIR"]).parent == nothing_writable


def test_a_folder_of_matplotlib_that_cannot_be_written_leaves_no_litter(nothing_writable, monkeypatch):
    """It would make one of its own in every process; one that can be made is left alone."""
    monkeypatch.setenv("MPLCONFIGDIR", "/proc/nowhere/matplotlib")
    ensure_kernel_cache()
    assert Path(os.environ["MPLCONFIGDIR"]).parent == nothing_writable
    chosen = str(nothing_writable / "new" / "matplotlib")
    monkeypatch.setenv("MPLCONFIGDIR", chosen)
    ensure_kernel_cache()
    assert os.environ["MPLCONFIGDIR"] == chosen


def test_the_stamp_knows_the_kind_of_work_and_the_place(monkeypatch, tmp_path):
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    run, other = compiled_stamp("run"), compiled_stamp("dynamics")
    assert run.parent == other.parent == tmp_path
    assert run != other and run == compiled_stamp("run")
    monkeypatch.setattr(kernel_cache, "version", lambda: "9.0")
    assert compiled_stamp("run") != run


def test_no_place_for_a_stamp_is_no_error(nothing_writable, monkeypatch):
    def homeless():
        raise RuntimeError("no home")

    monkeypatch.setattr(kernel_cache, "_user_cache", homeless)
    assert compiled_stamp("run") is None
