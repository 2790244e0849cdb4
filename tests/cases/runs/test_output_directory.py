"""Results appear complete or not at all, and replace nobody else's files."""

from __future__ import annotations

import pytest

from cases import CaseError
from cases.runs.output_directory import MANIFEST, check_output, save


def writer(**files):
    def write(folder):
        for name, text in files.items():
            path = folder / name.replace("__", "/")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return ()

    return write


def contents(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_text()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != MANIFEST
    }


def test_a_new_directory(tmp_path):
    target = tmp_path / "new" / "results"
    assert save(writer(a="1", vtk__b="2"), target) == ()
    assert contents(target) == {"a": "1", "vtk/b": "2"}
    assert [path.name for path in target.parent.iterdir()] == ["results"]
    assert target.stat().st_mode & 0o777 == (tmp_path / "new").stat().st_mode & 0o777


def test_a_failure_leaves_nothing(tmp_path):
    def fail(folder):
        (folder / "half").write_text("1")
        raise OSError(28, "No space left on device")

    with pytest.raises(OSError, match="No space left"):
        save(fail, tmp_path / "results")
    assert list(tmp_path.iterdir()) == []


def test_an_earlier_result_is_replaced_and_other_files_stay(tmp_path):
    target = tmp_path / "results"
    save(writer(a="1", vtk__b="2", old__c="3"), target)
    (target / "notes.txt").write_text("mine")
    (target / "old" / "more.txt").write_text("mine too")
    save(writer(a="10", vtk__d="4"), target)
    assert contents(target) == {"a": "10", "vtk/d": "4", "notes.txt": "mine", "old/more.txt": "mine too"}


def test_a_failure_keeps_the_earlier_result(tmp_path):
    target = tmp_path / "results"
    save(writer(a="1"), target)

    def fail(folder):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save(fail, target)
    assert contents(target) == {"a": "1"}


def test_a_file_of_somebody_else_is_not_replaced(tmp_path):
    (tmp_path / "a").write_text("mine")
    with pytest.raises(CaseError, match="not written by oilfilm"):
        save(writer(a="1"), tmp_path)
    assert contents(tmp_path) == {"a": "mine"}


def test_a_manifest_cannot_reach_outside(tmp_path):
    target = tmp_path / "results"
    save(writer(a="1"), target)
    (tmp_path / "precious").write_text("mine")
    (target / MANIFEST).write_text('["a", "../precious", "/etc/hostname", 3]')
    save(writer(b="2"), target)
    assert (tmp_path / "precious").read_text() == "mine"
    assert contents(target) == {"b": "2"}


def test_bad_targets_are_told_before_anything_is_computed(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(CaseError, match="is not a directory"):
        check_output(tmp_path / "file")
    with pytest.raises(CaseError, match="cannot be written"):
        check_output(tmp_path / "file" / "below")
