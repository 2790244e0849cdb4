"""The tutorial as a reader works through it: every block, in order, in one folder."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[1] / "docs" / "tutorial" / "tutorial.md"
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_the_page_has_blocks_of_every_kind():
    assert {kind for kind, _ in BLOCKS} == {"console", "python", "toml"}


@pytest.mark.slow
def test_every_block_runs(tmp_path):
    for kind, text in BLOCKS:
        if kind == "toml":
            (tmp_path / "loads.toml").write_text(text, encoding="utf-8")
            continue
        commands = [[sys.executable, "-c", text]]
        if kind == "console":
            commands = [
                [sys.executable, "-m", "oilfilm.cases.cli", *shlex.split(line)[1:]] for line in text.splitlines()
            ]
        for command in commands:
            run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
            assert run.returncode == 0, f"{command}\n{run.stdout}\n{run.stderr}"
            assert "Traceback" not in run.stderr
    assert (tmp_path / "first" / "report.html").exists()
    assert (tmp_path / "loads" / "plots" / "over_keys.png").exists()
