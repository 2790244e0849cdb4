"""The table of results in a terminal of 80 columns."""

from __future__ import annotations

from dataclasses import replace

from rich.console import Console

from postprocess.table import result_table


def printed(results):
    console = Console(width=80, file=None, record=True, force_terminal=False, quiet=False)
    with console.capture() as capture:
        console.print(result_table(results))
    return capture.get()


def test_bearing_fits_80_columns(bearing_results):
    text = printed(bearing_results)
    assert max(len(line.rstrip()) for line in text.splitlines()) <= 80
    assert "…" not in text
    assert text.count("inner") == 9
    assert "1596." in text
    assert "2.73" in text


def test_flags_are_explained(bearing_results):
    bad = replace(bearing_results.solutions[0], converged=False, resolved=False)
    text = printed(replace(bearing_results, solutions=(bad, *bearing_results.solutions[1:])))
    assert "!?" in text
    assert "! not converged" in text
    assert "! not converged" not in printed(bearing_results)


def test_single_contact(contact_results, moes_results):
    assert "µm" in printed(contact_results)
    assert "µm" not in printed(moes_results)
