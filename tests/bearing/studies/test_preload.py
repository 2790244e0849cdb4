"""A preload as a force in closed form and by the equilibrium of a row at rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing import (
    Arrangement,
    Curvature,
    Operation,
    QuasistaticModel,
    duplex,
    load_bearing,
    preload_offset,
    solve_quasistatic,
)
from oilfilm.bearing.studies.preload import pair_rigidity

from ..quasistatic.test_random_bearings import load_at, random_bearing


def solved(bearing, force, model):
    """Displacement of the ring at rest [m], or why there is none."""
    solution = solve_quasistatic(bearing, Operation(inner_speed=0.0, force=(force, 0.0, 0.0)), model)
    return solution.displacement[0] if solution.converged else f"preload_force {force!r} N: {solution.message}"


@pytest.mark.parametrize(("highest", "some_fail"), [(5e9, False), (60e9, True)])
@pytest.mark.parametrize("curvature", Curvature)
def test_closed_form_agrees_with_the_equilibrium(curvature, highest, some_fail):
    """Play, contact angles, interference; what no row can carry is refused with the solver's words. With
    interference rounding of the lengths is worth up to 1e-10 of the offset.
    """
    rng = np.random.default_rng(20261128)
    model = QuasistaticModel(curvature=curvature)
    failed = 0
    for _ in range(30):
        bearing = random_bearing(rng)
        if rng.random() < 0.25:
            bearing = replace(bearing, diametral_clearance=-rng.uniform(1e-4, 3e-3) * bearing.ball_diameter)
        carried = load_at(bearing, rng.uniform(0.05e9, highest)) * bearing.balls
        force = carried * np.sin(max(bearing.free_contact_angle, 0.1))
        expected = solved(bearing, force, model)
        if isinstance(expected, str):
            failed += 1
            with pytest.raises(ValueError) as error:
                preload_offset(bearing, force, model)
            assert str(error.value) == expected
        else:
            assert preload_offset(bearing, force, model) == pytest.approx(expected, rel=1e-9)
    assert (failed > 0) == some_fail


@pytest.mark.parametrize("clearance", [None, 0.0, -1e-6])
def test_a_preload_far_below_rounding_stands_at_first_touch(clearance):
    rng = np.random.default_rng(5)
    for _ in range(5):
        bearing = random_bearing(rng)
        bearing = bearing if clearance is None else replace(bearing, diametral_clearance=clearance)
        for power in (-320, -200, -40, -20):
            assert preload_offset(bearing, 10.0**power) == pytest.approx(bearing.free_axial_position, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "force", "rigidity", "off_load"), [("7012C", 211.0, 64.5, 658.0), ("7015C", 283.0, 76.8, 880.0)]
)
def test_a_pair_is_as_a_maker_tables_it(name, force, rigidity, off_load):
    """FAG's B7012C and B7015C, UL, whose grooves are not published: 7 % on the rigidity is what 0.53 leaves."""
    bearing = load_bearing(name)
    rows = duplex(bearing, Arrangement.BACK_TO_BACK, 20e-3, preload_force=force)
    pair = pair_rigidity(bearing, [row.offset for row in rows])
    assert pair.preload == pytest.approx(force, rel=1e-9)
    assert 1e-6 * pair.rigidity == pytest.approx(rigidity, rel=0.07)
    assert pair.off_load_force == pytest.approx(off_load, rel=0.006)
    solution = solve_quasistatic(bearing, Operation(inner_speed=0.0, force=(0.0, 0.0, 0.0)), rows=rows)
    # differences over a thousandth of the way
    assert pair.rigidity == pytest.approx(solution.stiffness[0, 0], rel=1e-5)
    assert pair_rigidity(bearing, [rows[0].offset]) is None
