"""The page of published numbers: complete sources, and the points that take no solve, computed anew."""

from __future__ import annotations

import csv
import re

import measured_points
import pytest

QUICK = ("gao_2026_films", "spindle_pairs", "wang_2024_moment", "nasa_35mm")


def test_eight_sources_and_a_hundred_points_with_bar_and_place():
    names = sorted(path.stem for path in measured_points.DATA.glob("*.csv"))
    assert names == sorted(measured_points.COMPUTED)
    rows = [row for name in names for row in measured_points.published(name)[1]]
    assert len(names) >= 8
    assert len(rows) >= 100
    assert [row for row in rows if not (float(row["bar"]) > 0.0 and float(row["value"]) > 0.0)] == []
    assert [row for row in rows if not (row["where"] and row["quantity"] and row["conditions"])] == []
    kinds = {"measured", "fit to measurements", "maker's table", "published calculation"}
    assert {row["kind"] for row in rows} == kinds


def test_the_page_has_every_point():
    text = measured_points.PAGE.read_text(encoding="utf-8")
    with measured_points.TABLE.open(encoding="utf-8") as file:
        points = list(csv.DictReader(file))
    for name in measured_points.COMPUTED:
        known = measured_points.published(name)[1]
        own = [point for point in points if point["source"] == name]
        assert [(p["quantity"], p["conditions"]) for p in own] == [(k["quantity"], k["conditions"]) for k in known]
        section = text.partition(f"### {name}\n")[2].partition("\n### ")[0]
        lines = re.findall(r"\| \**[\d.]+\** \|$", section, re.MULTILINE)
        assert len(lines) == min(len(known), measured_points.SHOWN), name
        assert measured_points.NOTES[name] in section


@pytest.mark.parametrize("name", QUICK)
def test_the_page_is_up_to_date(name):
    text = measured_points.PAGE.read_text(encoding="utf-8")
    rows = measured_points.rows_of(name)
    assert measured_points.block(name, rows) in text
    with measured_points.TABLE.open(encoding="utf-8") as file:
        kept = [point for point in csv.reader(file) if point[0] == name]
    assert kept == [measured_points.line(name, row) for row in rows]
