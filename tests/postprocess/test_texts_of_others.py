"""Texts of others in pictures, tables and on a terminal: shown as they are, acted upon nowhere."""

from __future__ import annotations

import csv
import zipfile

import pytest
from matplotlib.figure import Figure

from oilfilm.cases.cli.terminal import print_lines
from oilfilm.cases.runs.interrupt import print_message
from oilfilm.ehl.foreign_files import DamagedFileError, parse_json, visible
from oilfilm.postprocess.files import write_csv
from oilfilm.postprocess.plot_style import keep_dollars, save, write_figures

FORMULAS = ("=1+1", "+1+1", "-a", "@SUM(A1)", "\t=1+1", '=HYPERLINK("http://x")')


@pytest.mark.parametrize("title", ["$", "$5 and $6", "$\\frac$", "a $x$ b $\\no$", "$$", "$ $", "\\$", "$x_$", "$a$5"])
@pytest.mark.parametrize("suffix", [".png", ".svg"])
def test_a_title_loses_no_picture(tmp_path, title, suffix):
    figure = Figure()
    figure.suptitle(f"{title}\n$M$ = 5")
    figure.subplots().set_xscale("log")
    save(figure, tmp_path / f"picture{suffix}")
    assert (tmp_path / f"picture{suffix}").stat().st_size > 1000


@pytest.mark.parametrize(
    ("words", "drawn"),
    [
        ("$M$ = 5, $h_{min}$", "$M$ = 5, $h_{min}$"),
        ("$5 and $6", r"\$5 and \$6"),
        ("one $", r"one \$"),
        (r"$\no$ and $x$", r"\$\no\$ and $x$"),
    ],
)
def test_formulas_stay_and_amounts_do(words, drawn):
    figure = Figure()
    figure.suptitle(words)
    keep_dollars(figure)
    assert figure.get_suptitle() == drawn


def test_a_picture_of_a_run_with_dollars_is_written(tmp_path):
    problems = write_figures(tmp_path, [("plots/a", lambda figure: figure.suptitle(r"cost $\x$ and $1"))])
    assert problems == () and (tmp_path / "plots/a.png").exists()


@pytest.mark.parametrize("text", FORMULAS)
def test_a_formula_in_a_table_is_a_text(tmp_path, text):
    write_csv(tmp_path / "a.csv", ["name", text], [[text, -1.5], ["-1.5e3", "-"]])
    with (tmp_path / "a.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert rows == [["name", f"'{text}"], [f"'{text}", "-1.5"], ["-1.5e3", "-"]]


@pytest.mark.parametrize("text", [*FORMULAS, "http://example.org", "mailto:a@b.c", "internal:Sheet1!A1"])
def test_a_formula_or_a_link_in_a_workbook_is_a_text(tmp_path, monkeypatch, text):
    from oilfilm.postprocess.report import pdf_and_workbook

    monkeypatch.setattr(pdf_and_workbook, "sheets", lambda folder: {"Messages": ([text], [[text]])})
    path = pdf_and_workbook.write_workbook(tmp_path, tmp_path / "a.xlsx")
    with zipfile.ZipFile(path) as book:
        sheet = book.read("xl/worksheets/sheet1.xml").decode()
        names = book.namelist()
    assert "<f>" not in sheet and "hyperlink" not in sheet.lower()
    assert not any("rels/sheet" in name for name in names)


def test_a_terminal_acts_upon_no_text(capsys):
    text = "a\x1b[2Jb\x07\x9b1m\u202ec\td\ne"
    print_message(text)
    print_lines(text)
    shown = "a\\x1b[2Jb\\x07\\x9b1m\\u202ec\td\\ne\n"
    assert capsys.readouterr() == (shown, shown)
    assert visible("Größe ä µm − ψ") == "Größe ä µm − ψ"


@pytest.mark.parametrize("text", ['{"a": "\\u001b[2J"}', '["\\u202e"]', '{"\\u0007": 1}', '"\u009b"'])
def test_results_with_control_characters_are_damaged(text):
    with pytest.raises(DamagedFileError, match="control characters"):
        parse_json(text, "summary.json")
    assert parse_json('{"a": "C:\\\\u001b \\u0041 \\n"}', "summary.json")
