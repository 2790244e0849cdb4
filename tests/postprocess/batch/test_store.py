"""Finished points on disk: what is kept whatever happens, and what a damaged file gives back."""

from __future__ import annotations

import json
import random
import shutil
import sqlite3
from contextlib import closing

import pytest

from oilfilm.postprocess.batch.results import scalar_numbers
from oilfilm.postprocess.batch.store import (
    DONE,
    PointStore,
    Record,
    StoredPoints,
    content_digest,
    is_sound,
    record_of,
    summary_of,
    unpacked_numbers,
    whole_records,
)

SEED = 5_271_803


def summary(number):
    """A summary with numbers of every kind."""
    return {
        "case": {"title": "x"},
        "converged": number % 2 == 0,
        "load_N": float(number),
        "cycles": number,
        "film_central_um": None,
        "messages": ["text " * (number % 50)],
    }


def filled(path, count=300):
    """A file of records, each with what it should be."""
    records = [record_of(f"{number:020x}", summary(number), {"contact.load_N": number}) for number in range(count)]
    with closing(PointStore(path)) as store:
        for record in records:
            store.put(record)
    return records


def test_what_is_put_is_what_comes_back(tmp_path):
    records = filled(tmp_path / "points.sqlite")
    stored = StoredPoints([tmp_path / "points.sqlite"])
    keys = [record.key for record in records]
    assert stored.records(keys[::-1]) == records[::-1]
    assert stored.records(["no such point"]) == [None]
    assert summary_of(records[7]) == summary(7)
    assert [path.name for path in tmp_path.iterdir()] == ["points.sqlite"]  # closed without a journal


def test_a_record_whose_summary_has_changed_is_damaged(tmp_path):
    path = tmp_path / "points.sqlite"
    records = filled(path, 40)
    with closing(sqlite3.connect(path)) as file, file:
        damaged = bytearray(records[6].summary)
        damaged[-9] ^= 4
        file.execute("UPDATE points SET summary = ? WHERE id = 7", (bytes(damaged),))
    stored = StoredPoints([path])
    assert stored.damaged == {path: 1}
    assert stored.records([record.key for record in records]) == [*records[:6], None, *records[7:]]


def test_no_changed_byte_of_a_row_goes_unnoticed():
    whole = record_of("a" * 20, summary(49), {"contact.load_N": 3}, {".nc": "0" * 20})
    texts = (whole.key, whole.status, whole.message, whole.values, whole.files)
    for part, data in enumerate((whole.numbers, whole.summary)):
        for place in range(len(data)):
            changed = bytearray(data)
            changed[place] ^= 1 << place % 8
            parts = [whole.numbers, whole.summary]
            parts[part] = bytes(changed)
            assert content_digest(texts, whole.layout, *parts) != whole.digest
    cut = content_digest(texts, whole.layout, whole.numbers, whole.summary[:-1])
    assert whole.digest not in (cut, content_digest(texts, whole.layout, whole.numbers, b""))


def test_numbers_keep_their_kinds():
    record = record_of("a", summary(3))
    names = [name for part in json.loads(record.layout) for name in part]
    kinds, values = unpacked_numbers(record.numbers, len(names))
    assert dict(zip(names, bytes(kinds).decode(), strict=True)) == {
        "load_N": "f",
        "film_central_um": "-",
        "converged": "b",
        "cycles": "i",
    }
    assert values[[names.index(name) for name in ("load_N", "converged", "cycles")]].tolist() == [3.0, 0.0, 3.0]


def test_the_last_of_a_key_counts_and_a_result_before_all(tmp_path):
    with closing(PointStore(tmp_path / "points.sqlite")) as store:
        store.put(Record(key="a", status="failed", message="first"))
        store.put(Record(key="a", status="failed", message="second"))
        store.put(record_of("b", summary(1)))
        store.put(Record(key="b", status="lost"))
    stored = StoredPoints([tmp_path / "points.sqlite"])
    assert stored.status == {"a": "failed", "b": DONE}
    assert stored.records(["a"])[0].message == "second"


def test_what_was_on_disk_before_a_kill_is_there_after_it(tmp_path):
    """The journal of a writer that did not close its file is merged by the next reader."""
    store = PointStore(tmp_path / "points.sqlite")
    for number in range(60):
        store.put(record_of(f"{number}", summary(number)))
    killed = tmp_path / "killed"
    killed.mkdir()
    for path in list(tmp_path.glob("points.sqlite*")):
        shutil.copy(path, killed)
    store.close()
    assert len(StoredPoints([killed / "points.sqlite"]).status) == 50  # 50 are put on disk together


def test_nobody_else_writes_a_file(tmp_path, monkeypatch):
    monkeypatch.setattr("oilfilm.postprocess.batch.store.WAIT", 0.01)
    with closing(PointStore(tmp_path / "points.sqlite")), pytest.raises(OSError, match="locked"):
        PointStore(tmp_path / "points.sqlite")


@pytest.mark.parametrize("kind", ["flipped", "truncated", "emptied", "zeroed", "text", "header"])
def test_a_damaged_file_gives_back_whole_records_or_none(kind, tmp_path):
    """Whatever is damaged, no record comes back that is not as it was put there."""
    rng = random.Random(SEED)
    path = tmp_path / "points.sqlite"
    records = {record.key: record for record in filled(path)}
    whole = path.read_bytes()
    for _ in range(12):
        data = bytearray(whole)
        place = rng.randrange(100, len(data) - 5000)
        if kind == "flipped":
            data[place] ^= 1 << rng.randrange(8)
        elif kind == "truncated":
            del data[place:]
        elif kind == "emptied":
            data.clear()
        elif kind == "zeroed":
            data[place : place + 4096] = bytes(4096)
        elif kind == "text":
            data[:] = b"no data base " * 500
        else:
            data[rng.randrange(100)] ^= 0xFF
        path.write_bytes(data)
        found = [record for _, record in whole_records(path) if record is not None]
        assert all(records[record.key] == record for record in found)
        if kind == "flipped":
            assert len(found) >= 0.8 * len(records) or not is_sound(path) or place < 20_000
        path.write_bytes(whole)


def test_rows_that_cannot_be_read_are_counted(tmp_path):
    path = tmp_path / "points.sqlite"
    filled(path, 5)
    with closing(sqlite3.connect(path)) as file:
        file.execute("UPDATE points SET message = 'changed' WHERE id = 2")
        file.commit()
    stored = StoredPoints([path])
    assert stored.damaged == {path: 1}
    assert len(stored.status) == 4


def test_numbers_that_balls_have_in_other_tables_are_columns():
    """The balls' temperature and the safety of the contacts had no column: lists of that name were left out by it."""
    parts = {"temperatures_C": {"balls": 41.0}, "strength": {"contacts": {"rim_safety": 2.0}}}
    lists = {"balls": [{"ball": 1}], "contacts": [{"load_N": 3.0}]}
    assert scalar_numbers(parts | lists) == {"temperatures_C.balls": 41.0, "strength.contacts.rim_safety": 2.0}
