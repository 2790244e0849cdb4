"""Results appear complete or not at all, and replace nobody else's files."""

from __future__ import annotations

import sys

import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.runs import output_directory
from oilfilm.cases.runs.output_directory import (
    DIGESTS,
    MANIFEST,
    check_file,
    check_output,
    check_replaceable,
    damaged_files,
    one_writer,
    save,
)


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
        if path.is_file() and path.name not in (MANIFEST, DIGESTS)
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


def test_two_writers_are_detected_and_a_killed_one_is_not_in_the_way(tmp_path):
    target = tmp_path / "results"
    with one_writer(target):
        with pytest.raises(CaseError, match="another oilfilm is writing there"), one_writer(target):
            pass
        with one_writer(tmp_path / "others"):
            pass
    assert list(tmp_path.iterdir()) == []
    (tmp_path / ".results.lock").touch()  # of a killed program: the system has taken its lock
    with one_writer(target):
        pass
    assert list(tmp_path.iterdir()) == []


def test_what_killed_writers_have_left_is_swept(tmp_path):
    target = tmp_path / "results"
    target.mkdir()
    left = [tmp_path / ".results-abcd1234.partial", target / ".a-abcd1234.part.json", target / "b" / ".c-abcd1234.part"]
    kept = [tmp_path / ".others-abcd1234.partial", target / ".a.part.json", target / ".profile"]
    for path in (*left, *kept):
        path.parent.mkdir(exist_ok=True)
        path.mkdir() if path.suffix == ".partial" else path.touch()
    with one_writer(target):
        assert not any(path.exists() for path in left)
        assert all(path.exists() for path in kept)


def test_scratch_folders_of_killed_programs_are_swept(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(output_directory, "YOUNG", -1.0)
    (tmp_path / f"{output_directory.SCRATCH}old").mkdir()
    with output_directory.scratch_folder() as first, output_directory.scratch_folder() as second:
        assert first.is_dir() and second.is_dir()  # a living one stays
        assert {path.name for path in tmp_path.iterdir()} == {first.name, second.name}
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="permissions of POSIX")
def test_results_go_into_a_folder_whose_parent_cannot_be_written(tmp_path, monkeypatch):
    target = tmp_path / "results"
    target.mkdir()
    monkeypatch.setattr("os.access", lambda path, mode: path != tmp_path)  # root may write everywhere
    check_output(target)
    assert output_directory.home(target) == target
    save(writer(a="1"), target)
    assert contents(target) == {"a": "1"}


def test_a_file_that_cannot_be_written_is_told_before_anything_is_computed(tmp_path):
    with pytest.raises(CaseError, match="is a directory"):
        check_file(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(CaseError, match="cannot be written"):
        check_file(tmp_path / "file" / "below.png")


def test_damaged_files_are_found(tmp_path):
    target = tmp_path / "results"
    save(writer(a="12", vtk__b="34", c="56"), target)
    assert damaged_files(target) == []
    (target / "a").write_text("13")
    (target / "vtk" / "b").unlink()
    assert damaged_files(target) == [target / "a", target / "vtk" / "b"]
    save(writer(a="10", d="4"), target)
    assert damaged_files(target) == []
    assert contents(target) == {"a": "10", "d": "4"}
    for text in ("", "[]", "1", "{", '{"a": 3, "b": null}'):
        (target / DIGESTS).write_text(text)
        assert damaged_files(target) == ([target / "a", target / "b"] if "b" in text else [])


def test_a_damaged_manifest_makes_all_files_those_of_others(tmp_path):
    target = tmp_path / "results"
    save(writer(a="1"), target)
    for text in ("3", "{}", "null", "[", ""):
        (target / MANIFEST).write_text(text)
        with pytest.raises(CaseError, match="not written by oilfilm"):
            save(writer(a="2"), target)
    assert contents(target) == {"a": "1"}


@pytest.mark.parametrize("name", ["summary.json", MANIFEST, "vtk/b"])
def test_a_folder_in_the_place_of_a_file_is_refused_before_anything_is_computed(name, tmp_path):
    target = tmp_path / "results"
    save(writer(a="1", vtk__b="2"), target)
    check_replaceable(target)
    (target / name).unlink(missing_ok=True)
    (target / name).mkdir()
    for refused in (lambda: check_replaceable(target), lambda: save(writer(a="3", vtk__b="4"), target)):
        with pytest.raises(CaseError, match="will not be replaced"):
            refused()
    assert (target / "a").read_text() == "1"


def test_a_file_in_the_place_of_a_folder_is_refused_and_an_old_folder_stays(tmp_path):
    target = tmp_path / "results"
    save(writer(a="1", b="2"), target)
    (target / "b").unlink()
    (target / "b").mkdir()
    (target / "vtk").write_text("mine")
    with pytest.raises(CaseError, match="will not be replaced"):
        save(writer(a="3", vtk__b="4"), target)
    save(writer(a="5"), target)
    assert contents(target) == {"a": "5", "vtk": "mine"}
    assert (target / "b").is_dir()
