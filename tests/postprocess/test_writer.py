"""Everything into one directory; a lost picture is a message."""

from __future__ import annotations

import json

from oilfilm.postprocess import write_results


def test_all_files_are_written(bearing_folder):
    names = {p.name for p in bearing_folder.iterdir()}
    assert names == {"summary.json", "contacts.csv", "results.nc", "azimuth.pvd", "fields.pvd", "plots", "vtk"}


def test_single_contact_files(moes_folder):
    assert {p.name for p in moes_folder.iterdir()} == {"summary.json", "results.nc", "fields.pvd", "plots", "vtk"}


def test_failed_picture_is_a_message(contact_results, tmp_path, monkeypatch):
    def broken(results, directory):
        raise RuntimeError("no fonts")

    monkeypatch.setattr("oilfilm.postprocess.writer.write_contact_plots", broken)
    problems = write_results(contact_results, tmp_path)
    assert problems == ("plots not written: RuntimeError: no fonts",)
    document = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert problems[0] in document["messages"]
