"""Traction tables of the ceramic 6208 at random points against films solved and sheared there.

Errors count everything a table does: films interpolated over load and speed, shear over the motions. They are measured
against kappa_max Q, kappa_max the largest coefficient at that load and speed. The shear is integrated by the
trapezoidal rule on lines six times as close across the entrainment as those of the film's grid: on the grid itself, one
line after the other changes the sign of its sliding, and the force has steps of 2 %.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from oilfilm.bearing import solve_quasistatic
from oilfilm.bearing.friction.tables import load_tables, save_race_tables, table_contacts, table_range
from oilfilm.bearing.geometry import Race
from oilfilm.cases import load_case
from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.conditions import ContactKinematics
from oilfilm.ehl.traction.rolling_moment import rolling_moment
from oilfilm.ehl.traction.shear import integrate_traction
from oilfilm.ehl.traction_table.build import TableOptions, build_traction_table

from ..reference.ehl.traction import largest_force

POINTS, FILMS = 257, 20  # 10 motions in each of 20 films


@pytest.mark.slow
@pytest.mark.parametrize("race", list(Race), ids=lambda race: race.value)
def test_error_at_200_random_points(table_of, race):
    """All points within 1 % of kappa_max Q, what the tables are built to at points of their own."""
    table = table_of(race)
    assert table.converged
    contact, limits = table.contact, table.range
    rng = np.random.default_rng(660471)
    errors = []
    for _ in range(FILMS):
        load, speed = (float(np.exp(rng.uniform(*np.log(ends)))) for ends in (limits.load, limits.speed))
        conditions = contact.conditions(load, speed)
        film = solve_contact(conditions, SolverOptions(points=POINTS))
        resistance = rolling_moment(film).value
        b, film = film.semi_axis_x * film.semi_axis_ratio, finer(film)
        for x, y, n in rng.uniform(-1.0, 1.0, (10, 3)) ** 3 * [limits.slide_x, limits.slide_y, limits.spin]:
            slide_x, slide_y, spin = x * speed, y * speed, n * speed / contact.radius_x
            motion = ContactKinematics(
                entrainment_speed=speed,
                sliding_x=slide_x,
                sliding_y=slide_y,
                spin=spin,
                rolling=speed / contact.radius_x - 0.5 * contact.curvature_difference * slide_x,
                curvature_radius=contact.curvature_radius,
                curvature_width=b,
                curvature_difference=contact.curvature_difference,
            )
            wanted = integrate_traction(
                film, motion, contact.rheology, temperature=contact.temperature, rolling_resistance=resistance
            )
            found = table.forces(load, speed, slide_x, slide_y, spin)
            off = np.hypot(found.force_x - wanted.force_x, found.force_y - wanted.force_y)
            errors.append(off / largest_force(table, load, speed))
    assert len(errors) == 200
    assert max(errors) < 0.01


def finer(film, lines=6):
    """A film interpolated across the entrainment; where a neighbour on the grid is dry, the pressure stays below it."""
    Y = np.linspace(film.Y[0], film.Y[-1], lines * (film.Y.size - 1) + 1)
    linear = np.array([np.interp(Y, film.Y, row) for row in film.P])
    P = np.where(linear > 0.0, np.maximum(CubicSpline(film.Y, film.P, axis=1)(Y), 0.0), 0.0)
    return replace(film, Y=Y, P=P, H=CubicSpline(film.Y, film.H, axis=1)(Y))


@pytest.fixture(scope="module")
def table_of():
    """Function `table_of(race)`: its table, made when it is first asked for."""
    case = load_case("6208_full_ceramic")
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    contacts = table_contacts(state, case.lubricant, case.rheology)
    options = TableOptions(points=POINTS, workers=2)
    return cache(lambda race: build_traction_table(contacts[race], table_range(state, case.lubricant), options))


@pytest.mark.slow
def test_both_races_in_one_file(table_of, tmp_path):
    tables = {race: table_of(race) for race in Race}
    path = tmp_path / "tables.zip"
    save_race_tables(tables, path)
    read = load_tables(path)
    for race in Race:
        assert read[race].forces(500.0, 12.0, 0.1, 0.0, 0.0) == tables[race].forces(500.0, 12.0, 0.1, 0.0, 0.0)
    path.write_bytes(path.read_bytes()[:1000])
    with pytest.raises(ValueError, match="damaged"):
        load_tables(path)
