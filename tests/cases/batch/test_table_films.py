"""Films of a traction table that are kept while it grows."""

from __future__ import annotations

import pickle
from math import log

import pytest

from bearing import solve_quasistatic
from bearing.friction.race_tables import table_contacts, table_range
from bearing.geometry import Race
from cases import load_case
from cases.batch import table_films
from cases.batch.table_films import forget_films, kept_films


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


def test_a_kept_film_is_not_solved_again_and_a_damaged_one_is(place, tmp_path, monkeypatch, capsys):
    solved = []

    def counted(*arguments):
        solved.append(arguments)
        return film_sample(*arguments)

    film_sample = table_films.film_sample
    monkeypatch.setattr(table_films, "film_sample", counted)
    folder = tmp_path / "films"
    first = kept_films(folder)(*place)
    again = kept_films(folder)(*place)
    assert len(solved) == 1
    assert (again.moment, again.scales, again.place) == (first.moment, first.scales, first.place)
    assert again.response == first.response
    assert (again.film.solution.film == first.film.solution.film).all()
    assert kept_films(folder)(*place[:2], (log(600.0), log(10.0)), 65).moment != first.moment
    files = sorted(folder.iterdir(), key=lambda file: file.stat().st_mtime_ns)
    assert len(files) == len(solved) == 2
    whole = files[0].read_bytes()
    for damage in (b"", whole[:-9], whole[:100] + b"\x00" * 50 + whole[150:], pickle.dumps(Hostile())):
        files[0].write_bytes(damage)
        assert kept_films(folder)(*place).moment == first.moment
    assert len(solved) == 6
    assert "read without care" not in capsys.readouterr().out
    forget_films(folder)
    assert not folder.exists()
