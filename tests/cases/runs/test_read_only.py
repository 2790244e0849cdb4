"""Small and odd machines: read-only installation and home, no semaphores, results that cannot be written."""

from __future__ import annotations

import multiprocessing.synchronize
import os
import subprocess
import sys

import pytest

SHUT = "/proc/nowhere"  # no folder can be made there, by root either


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="needs a place where nobody can write")
@pytest.mark.parametrize(
    "words",
    [
        ["run", "209_radial_8900N", "-q", "-o", "out"],
        pytest.param(["slip", "small.toml", "-q", "-o", "out", "--workers", "1"], marks=pytest.mark.slow),
        pytest.param(["batch", "sweep.toml", "-q", "-o", "out", "--plot", "--workers", "1"], marks=pytest.mark.slow),
    ],
    ids=lambda words: words[0],
)
def test_no_home_directory_and_no_cache(words, tmp_path):
    """Exit code 0 and not a word of matplotlib or numba."""
    from oilfilm.cases.format.shipped import find_case

    text = find_case("hirano_7000C").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith(("points", "critical_points"))]
    at = lines.index("[slip]") + 1
    (tmp_path / "small.toml").write_text("\n".join([*lines[:at], "points = 3", "critical_points = 2", *lines[at:]]))
    (tmp_path / "sweep.toml").write_text('case = "209_radial_8900N"\n[sweep]\n"operation.radial_load_N" = [1e3, 2e3]\n')
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("XDG_", "MPL", "NUMBA_"))} | {"HOME": SHUT}
    run = subprocess.run(
        [sys.executable, "-m", "oilfilm.cases.cli", *words],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert not [line for line in run.stderr.splitlines() if not line.startswith("results in")]
    assert (tmp_path / "out" / "summary.json").exists()


def test_no_semaphores(tmp_path, monkeypatch):
    """A container without /dev/shm: no processes, the same points."""
    from typer.testing import CliRunner

    from oilfilm.cases.cli.main import app

    def refused(*_):
        raise FileNotFoundError(2, "No such file or directory")

    path = tmp_path / "sweep.toml"
    path.write_text('case = "209_radial_8900N"\n[sweep]\n"operation.radial_load_N" = [1e3, 2e3]\n')
    words = ["batch", str(path), "-q", "--workers", "2", "-o"]
    assert CliRunner().invoke(app, [*words, str(tmp_path / "plain")]).exit_code == 0
    monkeypatch.setattr(multiprocessing.synchronize._multiprocessing, "SemLock", refused)
    for command in ([*words, str(tmp_path / "bare")], ["run", "209_radial_8900N", "-q", "-o", str(tmp_path / "run")]):
        result = CliRunner().invoke(app, command)
        assert result.exit_code == 0, result.output
    one, other = ((tmp_path / name / "batch.csv").read_text() for name in ("plain", "bare"))
    assert one == other
    assert list((tmp_path / "run" / "plots").iterdir())


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="needs a place where nobody can write")
@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["run", "209_radial_8900N", "-q", "-o", SHUT], SHUT),
        (["run", "209_radial_8900N", "-q", "-o", "file/sub"], "file/sub"),
        (["run", "/proc/self/mem", "-q"], "/proc/self/mem"),
        (["init", f"{SHUT}/new", "--bearing", "6205"], f"{SHUT}/new.toml"),
        (["table", "209_radial_8900N", "-o", f"{SHUT}/t.npz"], f"{SHUT}/t.npz"),
        (["report", "file"], "file"),
    ],
)
def test_an_error_names_its_file(words, named, tmp_path, monkeypatch):
    """One line, exit code 2."""
    from typer.testing import CliRunner

    from oilfilm.cases.cli.main import app

    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("x")
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 2, result.output
    assert named in result.output and len(result.output.splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
