"""The README's commands are those of the continuous integration, and its Python runs."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from oilfilm.cases.format.shipped import shipped_cases, shipped_sweeps

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
CI = (ROOT / ".ci" / "run").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)


def test_two_commands_set_up_run_and_test():
    first, second = blocks("bash")
    assert "pip install" in first
    assert first.strip().endswith("oilfilm run 6208_full_ceramic")
    assert second.strip().endswith("pytest -n auto")
    assert all(len(block.strip().splitlines()) == 1 for block in (first, second))


def test_the_continuous_integration_runs_the_readme():
    assert "run_readme 1" in CI
    assert "run_readme 2" in CI
    command = r"""awk -v wanted=2 '/^```bash$/ { n++; on = (n == wanted); next } /^```$/ { on = 0 } on' README.md"""
    if shutil.which("awk"):
        found = subprocess.run(["sh", "-c", command], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        assert found == blocks("bash")[1]


def test_links_and_pictures_exist():
    targets = re.findall(r"\]\(([^)#:]+)\)", README)
    assert targets
    assert [target for target in targets if not (ROOT / target).exists()] == []


def test_the_commands_of_the_tour_exist():
    from typer.main import get_command

    from oilfilm.cases.cli.main import app

    commands = get_command(app).commands
    lines = [line for block in blocks("console") for line in block.splitlines() if line.startswith("oilfilm ")]
    lines += re.findall(r"`(oilfilm [^`]+)`", README)
    assert len(lines) > 10
    for line in lines:
        words = line.split()
        assert words[1] in commands
        options = {name for parameter in commands[words[1]].params for name in parameter.opts}
        assert {word for word in words if word.startswith("-")} <= options
        cases = [word for word in words[2:] if word.startswith(("6208", "moes", "ball")) and "results" not in word]
        assert set(cases) <= {*shipped_cases(), *shipped_sweeps()}


@pytest.mark.parametrize("code", blocks("python"))
def test_the_python_runs(code, tmp_path):
    environment = os.environ | {"MPLBACKEND": "Agg"}
    words = [sys.executable, "-c", code]
    run = subprocess.run(words, capture_output=True, text=True, timeout=300, cwd=tmp_path, env=environment)
    assert run.returncode == 0, run.stderr
    assert run.stdout


def test_the_error_shown_is_the_one_printed(tmp_path, monkeypatch):
    """The case of the tour with the mistake that it shows, validated."""
    from typer.testing import CliRunner

    from oilfilm.cases.cli.main import app

    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(app, ["init", "motor6205", "--bearing", "6205"]).exit_code == 0
    path = tmp_path / "motor6205.toml"
    text = path.read_text(encoding="utf-8").replace("\nball_diameter_mm", "\nball_diameter")
    path.write_text(text, encoding="utf-8")
    answer = CliRunner().invoke(app, ["validate", "motor6205.toml"])
    assert answer.exit_code == 2
    assert answer.output == blocks("text")[0]
