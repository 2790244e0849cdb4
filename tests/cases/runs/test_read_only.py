"""Nothing to write to but the folder of the results: an installation and a home directory that are read-only."""

from __future__ import annotations

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
