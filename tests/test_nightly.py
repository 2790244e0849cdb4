"""The command that runs all long checks: its steps exist, and it sees a page that is out of date."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import nightly
import pytest

ROOT = Path(__file__).parents[1]


def test_every_step_is_there():
    """Scripts of the repository, or modules of Python."""
    every = nightly.steps(7, Path("out"))
    assert len({step.name for step in every}) == len(every)
    scripts = [step.words[0] for step in every if step.words[0] != "-m"]
    assert scripts and all((ROOT / script).is_file() for script in scripts)


def test_every_fuzzer_is_a_step():
    steps = {word for step in nightly.steps(7, Path("out")) for word in step.words}
    fuzzers = {path.relative_to(ROOT).as_posix() for path in (ROOT / "tools" / "fuzz").glob("*.py")}
    assert fuzzers <= steps


def test_every_page_of_a_generator_is_there():
    for script, page in nightly.GENERATORS.items():
        assert (ROOT / "tools" / "docs" / f"{script}.py").is_file()
        assert (ROOT / "docs" / page).is_file()


@pytest.mark.parametrize(
    ("ours", "theirs", "same"),
    [
        ("| 0.4309 ± 0.0005 |", "| 0.4310 ± 0.0004 |", True),
        ("| 0.4309 |", "| 0.4360 |", False),
        ("| 117 |", "| 121 |", False),
        ("converged", "not converged", False),
        ("1 of 3", "1 of 3", True),
    ],
)
def test_lines_are_compared_by_their_numbers(ours, theirs, same):
    assert nightly.same_line(ours, theirs) is same


def test_a_page_out_of_date_is_found(monkeypatch, tmp_path):
    """Of a tree with one page, whose generator writes another number, and of one that fails."""
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "page.md").write_text("A film of 0.431 µm.\nText.\n", encoding="utf-8")
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    monkeypatch.setattr(nightly, "ROOT", tmp_path)
    monkeypatch.setattr(nightly, "GENERATORS", {"made_up": "page.md"})

    def write(text):
        def generate(tree, script):
            (tree / "docs" / "page.md").write_text(text, encoding="utf-8")
            return 0

        return list(nightly.changed_pages(generate))

    assert write("A film of 0.431 µm.\nText.\n") == []
    (fault,) = write("A film of 0.631 µm.\nText.\n")
    assert fault.startswith("docs/page.md:1:")
    assert list(nightly.changed_pages(lambda tree, script: 3)) == ["made_up: code 3"]


def test_a_step_that_fails_is_named(monkeypatch, capsys, tmp_path):
    steps = (nightly.Step("good", ("-c", "pass"), ""), nightly.Step("bad", ("-c", "raise SystemExit(3)"), ""))
    monkeypatch.setattr(nightly, "steps", lambda seed, folder: steps)
    monkeypatch.setattr(sys, "argv", ["nightly.py", "-o", str(tmp_path)])
    assert nightly.main() == 1
    printed = capsys.readouterr().out
    assert "good: ok" in printed and "bad: code 3" in printed and printed.endswith("failed: bad\n")
    monkeypatch.setattr(sys, "argv", ["nightly.py", "-o", str(tmp_path), "--only", "good"])
    assert nightly.main() == 0
