"""Workbook and PDF of result folders: what is in them, read back."""

from __future__ import annotations

import shutil
from zipfile import ZipFile

import pytest
from typer.testing import CliRunner

from oilfilm.cases.cli.main import app
from oilfilm.postprocess.files import read_summary
from oilfilm.postprocess.report.pdf_and_workbook import (
    _headline,
    _table_rows,
    _with_error,
    sheets,
    write_pdf,
    write_workbook,
)


def test_sheets_hold_every_number_with_its_unit(bearing_folder):
    found = sheets(bearing_folder)
    assert list(found) == ["Results", "Input", "stiffness", "rows", "balls", "contacts", "Messages"]
    facts = {(row[0], row[1]): row[2:] for row in found["Results"][1]}
    summary = read_summary(bearing_folder)
    assert facts["", "cage speed"] == [summary["cage_speed_rpm"], "r/min"]
    assert facts["ring displacement", "y"][0] == pytest.approx(summary["ring"]["displacement_um"][1])
    header, rows = found["contacts"]
    assert len(rows) == 18
    assert rows[0][header.index("load [N]")] == pytest.approx(summary["contacts"][0]["load_N"])
    assert found["Input"][1]


def test_workbook_is_a_file_of_sheets(bearing_folder, tmp_path):
    file = write_workbook(bearing_folder, tmp_path / "results.xlsx")
    with ZipFile(file) as archive:
        assert archive.testzip() is None
        book = archive.read("xl/workbook.xml").decode()
        assert 'name="contacts"' in book and 'name="Messages"' in book
        assert b"<v>" in archive.read("xl/worksheets/sheet1.xml")


def test_pdf_has_the_pictures_and_the_numbers(bearing_folder, tmp_path):
    content = write_pdf(bearing_folder, tmp_path / "results.pdf").read_bytes()
    pictures = len(list((bearing_folder / "plots").glob("*.png")))
    assert content.startswith(b"%PDF") and content.count(b"/Subtype /Image") >= pictures
    assert content.count(b"/Type /Page\n") + content.count(b"/Type /Page ") >= pictures // 2 + 2


def test_page_one_is_what_is_looked_at_first(bearing_folder):
    """Title, main results with error bars, every loaded contact with the number of its ball."""
    summary = read_summary(bearing_folder)
    rows = list(_headline(summary, "folder"))
    texts = [[text for _, _, text in row.cells] for row in rows]
    assert texts[0][0] in summary["case"]["title"] and rows[0].weight == "bold"
    titles = [cells[0] for cells in texts if len(cells) == 1]
    assert [title for title in ("Warnings", "Main results", "Contacts") if title in titles][-2:] == [
        "Main results",
        "Contacts",
    ]
    assert any(cells[0] == "minimum film" and " ± " in cells[1] for cells in texts if len(cells) == 3)
    balls = [cells[0] for cells in texts if len(cells) > 3 and cells[1] in ("inner", "outer")]
    assert len(balls) >= 2 and all(name.startswith("ball") for name in balls)
    assert all(0.0 <= place <= 1.0 for row in rows for place, _, _ in row.cells)


def test_error_bars_are_those_of_films_in_micrometres():
    """A temperature or a film without a unit of length has none."""
    shaft = {"film_maximum_C": 104.7, "film_minimum_um": 0.0976, "film_central_um": 0.176}
    shaft["film_central_uncertainty_um"] = 0.003
    found = [_with_error(shaft, key) for key in ("film_maximum_C", "film_minimum_um", "film_central_um")]
    assert found == ["104.7", "0.0976", "0.176 ± 0.003"]


def test_a_table_has_the_columns_whose_values_differ():
    rows = list(_table_rows(["point", "case.speed_rpm", "same"], [[k, 10.0 * k, 1.0] for k in range(70)]))
    texts = [[text for _, _, text in row.cells] for row in rows]
    assert texts[0] == ["point", "speed [r/min]"]
    assert texts[2] == ["0", "0"] and len(texts) == 2 + 60 + 1
    assert texts[-1] == ["70 rows and 3 columns in all"]


@pytest.mark.parametrize("kind", ["xlsx", "pdf"])
def test_the_command_names_the_file(contact_folder, tmp_path, monkeypatch, kind):
    shutil.copytree(contact_folder, tmp_path / "mine")
    monkeypatch.chdir(tmp_path)
    answer = CliRunner().invoke(app, ["export", "mine", "--format", kind])
    assert answer.exit_code == 0, answer.output
    assert (tmp_path / f"mine.{kind}").stat().st_size > 1000
    answer = CliRunner().invoke(app, ["export", "mine", "--format", kind, "-o", "mine.txt"])
    assert answer.exit_code == 2
    assert f"allowed: a .{kind} file" in answer.output
