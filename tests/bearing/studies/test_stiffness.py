"""Stiffness over speed, and the axes of the rotor code it goes to."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Arrangement, Operation, duplex, solve_quasistatic, stiffness_over_speed
from oilfilm.postprocess.stiffness.results import ross_table

LOAD = Operation(inner_speed=0.0, force=(400.0, 150.0, -60.0))


def test_each_speed_is_its_own_equilibrium(bearings):
    speeds = [0.0, 600.0, 1500.0]
    study = stiffness_over_speed(bearings.b7008, LOAD, speeds)
    assert study.converged.all()
    for index, speed in enumerate(speeds):
        alone = solve_quasistatic(bearings.b7008, Operation(inner_speed=speed, force=LOAD.force))
        assert_allclose(study.matrices[index], alone.stiffness, rtol=1e-6, atol=1e-6 * np.abs(alone.stiffness).max())


def test_speed_softens_a_bearing_under_thrust(bearings):
    """Centrifugal force opens the inner and closes the outer contact angle: at constant thrust it gives way axially."""
    study = stiffness_over_speed(bearings.b7008, Operation(inner_speed=0.0, force=(400.0, 0.0, 0.0)), [0.0, 2500.0])
    assert study.matrices[1, 0, 0] < 0.95 * study.matrices[0, 0, 0]


def test_no_equilibrium_is_told_and_left_out(bearings):
    study = stiffness_over_speed(bearings.b6208, Operation(inner_speed=0.0, force=(30000000.0, 0.0, 0.0)), [0.0, 10.0])
    assert not study.converged.any()
    assert len(study.messages) == 2
    assert ross_table(study)["kxx"].size == 0


def test_ross_axes_push_by_push(bearings):
    """A displacement along ROSS' x is one along our -z; the force along ROSS' y is our y: kyx = -k(y, z)."""
    study = stiffness_over_speed(bearings.b7008, LOAD, [800.0])
    k, table = study.matrices[0], ross_table(study, damping=250.0)
    assert table["kxx"][0] == pytest.approx(k[2, 2])
    assert table["kyy"][0] == pytest.approx(k[1, 1])
    assert table["kzz"][0] == pytest.approx(k[0, 0])
    assert table["kxy"][0] == pytest.approx(-k[2, 1])
    assert table["kyx"][0] == pytest.approx(-k[1, 2])
    assert table["speed"][0] == 800.0
    skew = k + np.arange(25.0).reshape(5, 5) * 1e5  # of friction, say: the cross terms differ
    other = ross_table(replace(study, matrices=skew[None]))
    assert other["kxy"][0] == pytest.approx(-skew[2, 1])
    assert other["kyx"][0] == pytest.approx(-skew[1, 2])
    assert [float(table[name][0]) for name in ("cxx", "cyy", "czz", "cxy", "cyx")] == [250.0] * 3 + [0.0] * 2
    with pytest.raises(ValueError, match="damping"):
        ross_table(study, damping=-1.0)


def test_rows_are_counted(bearings):
    rows = duplex(bearings.b7008, Arrangement.BACK_TO_BACK, 15e-3, preload_force=200.0)
    pair = stiffness_over_speed(bearings.b7008, Operation(inner_speed=0.0), [0.0], rows=rows)
    one = stiffness_over_speed(bearings.b7008, Operation(inner_speed=0.0, force=(200.0, 0.0, 0.0)), [0.0])
    assert pair.matrices[0, 0, 0] == pytest.approx(2.0 * one.matrices[0, 0, 0], rel=1e-6)
