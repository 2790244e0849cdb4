"""Traction tables of the ceramic 6208 at random points against films solved and sheared there.

Errors count everything a table does: films interpolated over load and speed, shear over the motions. They are measured
against kappa_max Q, kappa_max the largest coefficient at that load and speed.
"""

from __future__ import annotations

import numpy as np
import pytest

from bearing import solve_quasistatic
from bearing.geometry import Race
from bearing.traction_tables import build_race_tables, load_race_tables, save_race_tables
from cases import load_case
from ehl import SolverOptions, solve_contact
from ehl.traction import ContactKinematics, integrate_traction
from ehl.traction.sampling import TableOptions

POINTS, FILMS = 257, 20  # 10 motions in each of 20 films


@pytest.mark.slow
@pytest.mark.parametrize("race", list(Race), ids=lambda race: race.value)
def test_error_at_200_random_points(tables, race):
    """95 % of the points within 1 % of kappa_max Q (what the tables are built to), all of them within 10 %."""
    table = tables[race]
    contact, limits = table.contact, table.range
    rng = np.random.default_rng(660471)
    errors = []
    for _ in range(FILMS):
        load, speed = (float(np.exp(rng.uniform(*np.log(ends)))) for ends in (limits.load, limits.speed))
        conditions = contact.conditions(load, speed)
        film = solve_contact(conditions, SolverOptions(points=POINTS))
        b = film.semi_axis_x * film.semi_axis_ratio
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
            wanted = integrate_traction(film, motion, contact.rheology, temperature=contact.temperature)
            found = table.forces(load, speed, slide_x, slide_y, spin)
            off = np.hypot(found.force_x - wanted.force_x, found.force_y - wanted.force_y)
            errors.append(off / table.largest(load, speed)[0])
    assert np.quantile(errors, 0.95) < 0.01
    assert max(errors) < 0.10


@pytest.fixture(scope="module")
def tables():
    case = load_case("6208_full_ceramic")
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    return build_race_tables(state, case.lubricant, case.rheology, TableOptions(points=POINTS, workers=2))


@pytest.mark.slow
def test_both_races_in_one_file(tables, tmp_path):
    path = tmp_path / "tables.zip"
    save_race_tables(tables, path)
    read = load_race_tables(path, tables)
    for race in Race:
        assert read[race].forces(500.0, 12.0, 0.1, 0.0, 0.0) == tables[race].forces(500.0, 12.0, 0.1, 0.0, 0.0)
    path.write_bytes(path.read_bytes()[:1000])
    with pytest.raises(ValueError, match="damaged"):
        load_race_tables(path)
