"""Slip after Hirano: the 7000C, independent numbers as in test_quasistatic_literature, and bounds that hold always."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import BallKinematics, Operation, QuasistaticModel, solve_quasistatic
from oilfilm.bearing.studies.slip import (
    SlipStudy,
    critical_curves,
    critical_loads,
    minimum_axial_load_skf,
    minimum_preload,
    minimum_preloads,
    minimum_radial_load_skf,
    slip_factors,
    slip_surface,
)

OUTER_CONTROL = QuasistaticModel(ball_kinematics=BallKinematics.OUTER_RACE_CONTROL)


@pytest.fixture
def study(bearings):
    operation = Operation(inner_speed=1.0, force=(0.0, 0.0, 0.0))
    return SlipStudy(bearing=bearings.b7000c, operation=operation, model=OUTER_CONTROL)


def under(study, radial, tilt=0.0):
    operation = replace(study.operation, force=(0.0, radial, 0.0), tilt=(0.0, tilt))
    return replace(study, operation=operation)


def test_minimum_preload_of_the_7000c(study, bearings):
    """Computed by a program that shares no code with this one: 0.03 %."""
    found = minimum_preloads(study, [1e3 * k * bearings.rpm for k in (20, 30, 40, 50, 60, 70)])
    assert_allclose(found, [214.5, 486.9, 873.6, 1377.7, 2002.2, 2750.3], rtol=3e-4)


def test_minimum_preload_under_radial_load(study, bearings):
    """150 N at 63000 r/min needs 2364.9 N; with half the centrifugal force in the factor 1226 N."""
    speed = 63e3 * bearings.rpm
    assert minimum_preload(under(study, 150.0), speed) == pytest.approx(2364.9, rel=1e-4)
    assert minimum_preload(replace(under(study, 150.0), limit=5.0), speed) == pytest.approx(1226.0, rel=5e-4)


def test_at_the_minimum_preload_the_worst_ball_is_at_the_limit(study, bearings):
    """Under radial load and tilt; 1e-5 is a hundred times the precision of the root."""
    tilted, speed = under(study, 100.0, 0.3e-3), 24e3 * bearings.rpm
    load = minimum_preload(tilted, speed)
    assert slip_factors(tilted.solve(speed, load)).min() == pytest.approx(10.0, rel=1e-5)
    assert (
        slip_factors(tilted.solve(speed, 0.99 * load)).min()
        < 10.0
        <= slip_factors(tilted.solve(speed, 1.01 * load)).min()
    )


def test_surface(study, bearings):
    """The printed figures of two loads and three speeds; a warm start gives what a cold one does."""
    surface = slip_surface(study, [k * 1e3 * bearings.rpm for k in (20, 40, 70)], [600.0, 50.0])
    expected = [[27.69, 2.340], [6.901, 0.569], [2.229, 0.176]]
    assert_allclose(surface.minimum, expected, rtol=2e-3)
    assert surface.unsolved == 0
    cold = solve_quasistatic(
        study.bearing, replace(study.operation, inner_speed=surface.speeds[1], force=(50.0, 0.0, 0.0)), OUTER_CONTROL
    )
    assert_allclose(surface.factors[1, 1], slip_factors(cold), rtol=1e-9)


def test_mean_factor_is_the_axial_balance(study, bearings):
    """Sum of Qi sin(ai) is Fa with outer race control, whatever the radial load: to the residual."""
    speed = 30e3 * bearings.rpm
    solution = under(study, 80.0).solve(speed, 400.0)
    assert np.sum(slip_factors(solution) * solution.centrifugal_force) == pytest.approx(400.0, rel=1e-9)


def test_near_solution_gives_the_same_equilibrium_in_fewer_steps(study, bearings):
    loaded = under(study, 100.0)
    near = loaded.solve(40e3 * bearings.rpm, 300.0)
    cold, warm = (loaded.solve(40e3 * bearings.rpm, 310.0, start) for start in (None, near))
    assert warm.iterations < cold.iterations
    assert_allclose(warm.inner_load, cold.inner_load, rtol=1e-9)


def test_critical_curves_meet_without_radial_load_and_part_at_72_degrees(study, bearings):
    """Balls within 72 degrees of the load line need less preload under radial load, the others more."""
    speed = 24e3 * bearings.rpm
    curves = critical_curves(study, speed, [0.0, 100.0])
    preload = minimum_preload(study, speed)
    assert_allclose(curves.axial_loads[0], preload, rtol=1e-5)
    change = curves.axial_loads[1] - curves.axial_loads[0]
    assert (change[[0, 1, 2, 8, 9]] < 0.0).all() and (change[3:8] > 0.0).all()
    assert_allclose(curves.axial_loads[1], np.roll(curves.axial_loads[1][::-1], 1), rtol=1e-5)  # ball k and Z + 2 - k
    assert curves.axial_loads[1].max() == pytest.approx(minimum_preload(under(study, 100.0), speed), rel=1e-5)


def test_critical_load_puts_that_ball_at_the_limit(study, bearings):
    speed = 24e3 * bearings.rpm
    loads = critical_loads(study, speed, 100.0)
    for ball in (0, 3, 5):
        assert slip_factors(under(study, 100.0).solve(speed, loads[ball]))[ball] == pytest.approx(10.0, rel=1e-5)


def test_without_speed_nothing_slips(study):
    assert minimum_preload(study, 0.0) == 0.0
    assert np.isinf(
        slip_factors(solve_quasistatic(study.bearing, Operation(inner_speed=0.0, force=(50.0, 0.0, 0.0))))
    ).all()


def test_catalogue_minimum_loads():
    """By hand: A 3.77 N at 10000 r/min; k_r 95 N, 10 mm2/s, 46 mm: 95 * 100^(2/3) * 0.2116 N."""
    speed = 10e3 * np.pi / 30.0
    assert minimum_axial_load_skf(3.77, speed) == pytest.approx(377.0)
    assert minimum_radial_load_skf(95.0, speed, 1e-5, 0.046) == pytest.approx(95.0 * 21.5443469 * 0.2116)


def test_what_cannot_be_varied_is_refused(study, bearings):
    held = Operation(inner_speed=1.0, force=(None, 0.0, 0.0), displacement=(1e-5, None, None))
    with pytest.raises(ValueError, match="axial load"):
        SlipStudy(bearing=study.bearing, operation=held, model=OUTER_CONTROL)
    with pytest.raises(ValueError, match="limit"):
        replace(study, limit=0.0)
    fixed = replace(study.operation, force=(0.0, None, 0.0), displacement=(None, 0.0, None))
    with pytest.raises(ValueError, match="radial load"):
        critical_loads(replace(study, operation=fixed), 1000.0, 10.0)
