"""A disk that takes nothing more is an error with its number, whatever library writes."""

from __future__ import annotations

import errno
import os
import subprocess
import sys

import h5netcdf
import numpy as np
import pytest

from oilfilm.bearing.files import require_room, write_bytes
from oilfilm.postprocess.files import attempt

resource = pytest.importorskip("resource", reason="limits of POSIX")
# Python renames what it wrote of a compiled module, also where the limit cut it short
NO_BYTECODE = "import resource, sys; sys.dont_write_bytecode = True"
OILFILM = [sys.executable, "-m", "oilfilm.cases.cli"]


@pytest.fixture
def small_files():
    """No file may be larger than 20 kB."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, limits[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def test_a_file_is_there_as_a_whole_or_not_at_all(small_files, tmp_path):
    write_bytes(tmp_path / "a", b"1" * 19_000)
    for name in ("a", "b"):
        with pytest.raises(OSError) as caught:
            write_bytes(tmp_path / name, b"2" * 21_000)
        assert caught.value.errno == errno.EFBIG
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    assert (tmp_path / "a").read_bytes() == b"1" * 19_000


@pytest.mark.slow
def test_hdf5_never_sees_the_error(tmp_path):
    """A history on a disk that is full ends with the error of the disk, and what was written can be read."""
    code = f"""
import resource
import numpy as np
from types import SimpleNamespace
from pathlib import Path
from oilfilm.postprocess.dynamics import history

def variables(record, balls):
    return {{"v": (("time", "ball"), record.v, "N"), "contact_state": (("time", "ball"), record.v, "1")}}

history.variables = variables
resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, 2_000_000))
rng = np.random.default_rng(51_377)
with history.HistoryWriter(Path({str(tmp_path / "a.nc")!r}), 9, 10**6, {{"title": "made up"}}) as writer:
    for k in range(1000):
        writer.add(SimpleNamespace(time=128.0 * k + np.arange(128), v=rng.random((128, 9))))
"""
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert answer.returncode == 1
    assert answer.stderr.splitlines()[-1] == f"OSError: [Errno {errno.EFBIG}] {os.strerror(errno.EFBIG)}"
    with h5netcdf.File(tmp_path / "a.nc", "r") as file:
        values = np.asarray(file["v"])
        rows = len(values)
    assert rows % 128 == 0 and rows > 1280
    expected = np.random.default_rng(51_377).random((rows, 9))
    np.testing.assert_allclose(values, expected, rtol=1e-6)


def test_a_full_disk_is_no_lost_picture():
    def fail(number):
        raise OSError(number, os.strerror(number))

    assert attempt("plots", lambda: fail(errno.ENOENT)) == (
        "plots not written: FileNotFoundError: [Errno 2] No such file or directory",
    )
    with pytest.raises(OSError, match="No space"):
        attempt("plots", lambda: fail(errno.ENOSPC))


def test_there_is_room_or_an_error(small_files, tmp_path):
    require_room(tmp_path, 20_000)
    with pytest.raises(OSError, match="File too large"):
        require_room(tmp_path, 20_001)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_hdf5_of_a_mesh_is_not_begun_without_room(bearing_folder, tmp_path):
    """It would end the program with a segmentation fault."""
    words = ["export", str(bearing_folder), "--format", "xdmf", "-o", str(tmp_path / "a.xdmf")]
    code = f"{NO_BYTECODE}; resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000)); sys.argv[1:] = {words}"
    code += "; from oilfilm.cases.cli.start import main; main()"
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert answer.returncode == 4, answer.stderr
    assert "File too large" in answer.stderr
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "words",
    [
        "run 209_radial_8900N -o out",
        pytest.param("stiffness 209_radial_8900N --speeds 0 900 --points 40 -o out", marks=pytest.mark.slow),
        pytest.param("batch s.toml -o out", marks=pytest.mark.slow),
    ],
)
def test_commands_end_with_one_line_and_code_4(words, tmp_path):
    (tmp_path / "s.toml").write_text('case = "209_radial_8900N"\n[sweep]\n"operation.radial_load_N" = [100.0, 200.0]\n')
    limit = f"{NO_BYTECODE}; resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000)); sys.argv[1:] = {words.split()}"
    code = f"{limit}; from oilfilm.cases.cli.start import main; main()"
    answer = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert answer.returncode == 4
    assert sum("failed: " in line for line in answer.stderr.splitlines()) == 1
    assert "Traceback" not in answer.stderr and "not written" not in answer.stderr
    assert not [path for path in tmp_path.rglob(".*") if not path.name.startswith(".oilfilm-")]
