"""Films of a traction table that are kept while it grows."""

from __future__ import annotations

import io
import pickle
from errno import ENOSPC
from math import log

import numpy as np
import pytest

from oilfilm.bearing import solve_quasistatic
from oilfilm.bearing.friction.tables import table_contacts, table_range
from oilfilm.bearing.geometry import Race
from oilfilm.cases import load_case
from oilfilm.cases.batch import shared_tables
from oilfilm.cases.batch.shared_tables import stored_film_sampler
from oilfilm.cases.cli.compute import _film_sampler


def hostile():
    """An npz file with an array of objects, which NumPy reads as a pickle where it is let."""
    content = io.BytesIO()
    np.savez(content, document=np.array([Hostile()], dtype=object))
    return content.getvalue()


class Hostile:
    """Runs a command where a file of it is read without care."""

    def __reduce__(self):
        return (print, ("read without care",))


@pytest.fixture(scope="module")
def place():
    """Contact, range, place and points of one film."""
    case = load_case("6208_full_ceramic")
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    contact = table_contacts(state, case.lubricant, case.rheology)[Race.INNER]
    return contact, table_range(state, case.lubricant), (log(500.0), log(10.0)), 65


def test_a_disk_that_takes_no_film_ends_the_table_and_keeps_those_before(place, tmp_path, monkeypatch, capsys):
    """At once, not after minutes when the table itself does not fit; with room again it goes on from there."""
    film_sample, write_file = shared_tables.film_sample, shared_tables.write_file
    places = [(*place[:2], (log(load), log(10.0)), 65) for load in (500.0, 600.0)]
    solved = []

    def tabulated(room):
        """All films of a table, on a disk with room for so many."""

        def on_disk(path, data):
            if len(list(path.parent.iterdir())) >= room:
                raise OSError(ENOSPC, "No space left on device")
            write_file(path, data)

        monkeypatch.setattr(shared_tables, "write_file", on_disk)
        with _film_sampler(tmp_path / "table.zip") as sample:
            for one in places:
                sample(*one)

    monkeypatch.setattr(shared_tables, "film_sample", lambda *words: solved.append(words[2]) or film_sample(*words))
    with pytest.raises(OSError, match="No space left"):
        tabulated(room=1)
    told = f"finished films are kept in {tmp_path / 'table_films'}; make room, then the same command goes on with them"
    assert capsys.readouterr().err == f"{told}\n"
    tabulated(room=2)
    assert solved == [places[0][2], places[1][2], places[1][2]]
    assert not list(tmp_path.iterdir())
    with pytest.raises(OSError, match="No space left"):
        tabulated(room=0)
    assert capsys.readouterr().err == ""  # nothing is kept, and nothing left
    assert not list(tmp_path.iterdir())


def test_a_kept_film_is_not_solved_again_and_a_damaged_one_is(place, tmp_path, monkeypatch, capsys):
    solved = []

    def counted(*arguments):
        solved.append(arguments)
        return film_sample(*arguments)

    film_sample = shared_tables.film_sample
    monkeypatch.setattr(shared_tables, "film_sample", counted)
    folder = tmp_path / "films"
    first = stored_film_sampler(folder)(*place)
    again = stored_film_sampler(folder)(*place)
    assert len(solved) == 1
    assert (again.moment, again.scales, again.place) == (first.moment, first.scales, first.place)
    assert again.response == first.response
    assert (again.film.solution.film == first.film.solution.film).all()
    assert stored_film_sampler(folder)(*place[:2], (log(600.0), log(10.0)), 65).moment != first.moment
    files = sorted(folder.iterdir(), key=lambda file: file.stat().st_mtime_ns)
    assert len(files) == len(solved) == 2
    whole = files[0].read_bytes()
    for damage in (b"", whole[:-9], whole[:100] + b"\x00" * 50 + whole[150:], pickle.dumps(Hostile()), hostile()):
        files[0].write_bytes(damage)
        assert stored_film_sampler(folder)(*place).moment == first.moment
    assert len(solved) == 7
    assert "read without care" not in capsys.readouterr().out
