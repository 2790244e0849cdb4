"""Folders of others: what lies in them is data, never a program."""

from __future__ import annotations

import json
import pickle
import sqlite3
import zlib
from contextlib import closing
from hashlib import blake2b

import pytest

from oilfilm.cases.batch.shared_tables import ContactCache
from oilfilm.cases.batch.store import open_folder, open_store
from oilfilm.cases.format.film_model import NEWTONIAN
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.output_directory import MANIFEST, save
from oilfilm.ehl import Lubricant, MoesConditions, SolverOptions
from oilfilm.ehl.foreign_files import DamagedFileError
from oilfilm.postprocess.batch.store import PointStore, Record, holds_rows, is_sound, summary_of, whole_records

PROGRAMS = (
    "CREATE TRIGGER t AFTER INSERT ON points BEGIN DELETE FROM points; END",
    "DROP TABLE points; CREATE VIEW points AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n) "
    "SELECT id, 1 AS digest, 'a' AS key FROM n",
    "ALTER TABLE points ADD COLUMN more GENERATED ALWAYS AS (length(key)) VIRTUAL",
    "CREATE INDEX i ON points (length(key))",
)

OIL = Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
CONTACT = MoesConditions(load_parameter=10.0, lubricant_parameter=5.0, lubricant=OIL)
OPTIONS = SolverOptions(points=33)


def stacked(module, name, target):
    """A pickle that runs `touch target`; in protocol 4 names may have dots: an attribute of an attribute."""
    texts = [module, name, "touch", str(target)]
    short = [b"\x8c" + bytes([len(text)]) + text.encode() for text in texts]
    return b"\x80\x04" + short[0] + short[1] + b"\x93](" + short[2] + short[3] + b"e\x85R."


@pytest.mark.parametrize("module", ["ehl.oil.lubricant", "oilfilm.ehl.oil.lubricant"])
@pytest.mark.parametrize("name", ["np.f2py.subprocess.Popen", "np.lib.format.os.system"])
@pytest.mark.parametrize("signed", [True, False])
def test_a_contact_of_another_folder_runs_nothing(tmp_path, module, name, signed, capsys):
    """With a digest as an older version wrote it, which anybody can compute, and without."""
    cache = ContactCache(tmp_path)
    whole = cache.solve(CONTACT, OPTIONS, NEWTONIAN)
    (file,) = tmp_path.iterdir()
    target = tmp_path / "ran"
    data = stacked(module, name, target)
    head = blake2b(data, digest_size=16, key=file.name.encode()[:64]).digest()
    file.write_bytes(head + data if signed else data)
    again = cache.solve(CONTACT, OPTIONS, NEWTONIAN)
    assert not target.exists()
    assert again.converged == whole.converged and (again.P == whole.P).all()
    assert f"{file}: damaged; the contact is solved anew" in capsys.readouterr().err


def test_the_attack_would_run_where_it_is_read_as_a_pickle(tmp_path):
    target = tmp_path / "ran"
    pickle.loads(stacked("subprocess", "Popen", target)).wait()
    assert target.exists()


@pytest.mark.parametrize("program", PROGRAMS)
def test_points_with_a_program_in_their_file_are_computed_anew(tmp_path, program):
    path = tmp_path / "points.sqlite"
    PointStore(path).close()
    with closing(sqlite3.connect(path)) as file:
        file.executescript(program)
    assert not is_sound(path) and holds_rows(path)
    assert list(whole_records(path)) == []
    with pytest.raises(OSError, match="not the tables of oilfilm"):
        PointStore(path)
    open_store(path, broken=True).close()
    assert is_sound(path) and (tmp_path / "points.sqlite.damaged").exists()


def test_a_summary_that_unpacks_without_end_is_damaged():
    packed = zlib.compress(b" " * 200_000_000)
    with pytest.raises(DamagedFileError, match="declares more than it holds"):
        summary_of(Record(key="a", status="done", summary=packed))


@pytest.mark.parametrize("name", ["../outside.txt", "link/outside.txt"])
def test_a_list_of_files_names_none_outside_its_folder(tmp_path, name):
    """A folder of results lists its files, which the next run into it removes."""
    folder = tmp_path / "results"
    folder.mkdir()
    (folder / "link").symlink_to(tmp_path)
    outside = tmp_path / "outside.txt"
    outside.write_text("mine")
    (folder / MANIFEST).write_text(json.dumps([name, str(outside), "summary.json"]))
    (folder / "summary.json").write_text("{}")
    save(lambda target: (target / "summary.json").write_text("{}") and (), folder)
    assert outside.read_text() == "mine"


@pytest.mark.parametrize("name", ["points", "contacts", "tables", "points.sqlite", "sweep.toml", "points/x.nc"])
def test_links_in_a_folder_lead_nowhere(tmp_path, name):
    """Neither is anything written to where a link of another's folder leads, nor removed there."""
    away, folder = tmp_path / "away", tmp_path / "batch"
    (folder / "points").mkdir(parents=True)
    away.mkdir()
    (away / ".mine.part1").write_text("kept")
    (folder / "sweep.toml").touch()
    place = folder / name
    if place.is_dir():
        place.rmdir()
    place.unlink(missing_ok=True)
    place.symlink_to(away if "." not in name else away / ".mine.part1")
    with pytest.raises(CaseError, match="is a link in the place of a file of the batch"):
        open_folder(folder, resume=True)
    assert (away / ".mine.part1").read_text() == "kept"


def test_results_are_not_written_through_a_linked_folder(tmp_path):
    away, folder = tmp_path / "away", tmp_path / "result"
    away.mkdir()
    folder.mkdir()
    (folder / "vtk").symlink_to(away)

    def write(target):
        (target / "vtk").mkdir()
        (target / "vtk" / "new.vtp").touch()
        return ()

    with pytest.raises(CaseError, match="not written by oilfilm, will not be replaced"):
        save(write, folder)
    assert list(away.iterdir()) == []
