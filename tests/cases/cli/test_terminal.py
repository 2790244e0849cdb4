"""Exit codes and messages of what a command raises or returns; limits and found values in words."""

from __future__ import annotations

import tempfile

import pytest
import typer

from oilfilm.cases.cli.terminal import exit_code
from oilfilm.cases.format.rules import CaseError, allowed_values, shown


def raising(error):
    def command():
        raise error

    return command


@pytest.mark.parametrize(
    ("command", "code", "message"),
    [
        (lambda: None, 0, ""),
        (lambda: 1, 1, ""),
        (raising(CaseError("a.toml:3: balls: missing")), 2, "a.toml:3: balls: missing\n"),
        (raising(KeyboardInterrupt()), 3, "oilfilm: interrupted\n"),
        (raising(typer.Exit(2)), 2, ""),
    ],
)
def test_exit_codes(command, code, message, capsys):
    """The README's: 0 converged, 1 not converged, 2 bad input, 3 interrupted."""
    assert exit_code(command) == code
    assert capsys.readouterr().err == message


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (OSError(28, "No space left on device", "a.nc"), "failed: a.nc: No space left on device"),
        (MemoryError(), "failed: out of memory"),
        (ZeroDivisionError("by\n  zero"), "internal error: ZeroDivisionError: by zero"),
    ],
)
def test_a_failure_of_the_machine_is_one_line(error, words, capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    assert exit_code(raising(error)) == 4
    message = capsys.readouterr().err
    assert message.startswith(f"oilfilm: {words}; details: {tmp_path}")
    assert message.count("\n") == 1
    assert "Traceback" in next(tmp_path.glob("oilfilm-*.log")).read_text(encoding="utf-8")


def test_long_lists_of_errors_end(capsys):
    """Twenty lines of 25, and how many are left."""
    assert exit_code(raising(CaseError(f"line {k}" for k in range(25)))) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 21
    assert lines[-1] == "... and 5 more errors"


def test_found_and_allowed_values_in_words():
    """Sixty characters are shown, of more 57 and dots."""
    assert shown("x" * 58) == '"' + 58 * "x" + '"'
    assert shown("x" * 59) == '"' + 56 * "x" + "..."
    assert (shown(True), shown({}), shown(2.5)) == ("true", "a table", "2.5")
    assert allowed_values({"type": "number", "exclusiveMinimum": 0, "maximum": 1}) == "a number > 0 and <= 1"
