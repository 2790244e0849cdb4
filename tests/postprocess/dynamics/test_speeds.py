"""Speeds and slip from a history: balls and cage of known motion between two rings that turn."""

from __future__ import annotations

from math import cos, pi, radians

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose

from oilfilm.postprocess.dynamics.read import averaged, simulated_speeds

RATIO = 0.2  # ball over pitch diameter
ANGLE = radians(25.0)
INNER = 300.0  # [rad/s]
TIME = np.linspace(0.01, 0.31, 61)
OUTER_RPM = 1200.0
LOST = 0.1  # of the cage and of the balls' spin


def history(slips, unloaded=()):
    """Three balls, of which each lacks its part of the orbital speed; the outer ring speeds up from rest."""
    gamma, outer = RATIO * cos(ANGLE), OUTER_RPM * pi / 30.0 * TIME / TIME[-1]
    rolling = 0.5 * (INNER * (1.0 - gamma) + outer * (1.0 + gamma))
    spin = 0.5 * np.abs(INNER - outer) / RATIO * (1.0 - gamma**2)
    orbit = rolling[:, None] * (1.0 - np.array(slips))
    azimuth = np.array([0.1, 2.0, 4.0])
    place, speed, turn = (np.zeros((TIME.size, 3, 3)) for _ in range(3))
    place[..., 1], place[..., 2] = 0.02 * np.cos(azimuth), 0.02 * np.sin(azimuth)
    speed[..., 1], speed[..., 2] = -0.02 * orbit * np.sin(azimuth), 0.02 * orbit * np.cos(azimuth)
    turn[..., 0] = orbit + 0.6 * (1.0 - LOST) * spin[:, None]
    turn[..., 2] = 0.8 * (1.0 - LOST) * spin[:, None]
    load, angle = np.full((TIME.size, 2, 3), 10.0), np.full((TIME.size, 2, 3), ANGLE)
    load[list(unloaded)], angle[list(unloaded)] = 0.0, 0.0
    ball, race = ("time", "ball", "axis"), ("time", "race", "ball")
    data = xarray.Dataset(
        {
            "cage_velocity": (("time", "cage_coordinate"), (1.0 - LOST) * rolling[:, None]),
            "ball_position": (ball, place),
            "ball_velocity": (ball, speed),
            "ball_angular_velocity": (ball, turn),
            "ring_rotation": ("time", INNER * TIME),
            "contact_load": (race, load),
            "contact_contact_angle": (race, angle),
        },
        coords={"time": TIME, "cage_coordinate": ["rotation"]},
        attrs={"ball_diameter": 8e-3, "pitch_diameter": 40e-3},
    )
    table = [[0.0, 0.0], [float(TIME[-1]), OUTER_RPM]]
    case = {"operation": {"outer_speed_rpm": 50.0}, "dynamics": {"outer_speed_table_rpm": table}}
    return data, {"case": case}


@pytest.mark.parametrize("unloaded", [(), (0, 1), (20, 21, 60)])
def test_slip_of_a_known_motion(unloaded):
    """At the angles of loaded samples also where nothing is loaded; the outer ring by its table."""
    slips = (0.0, 0.05, -0.02)
    found = simulated_speeds(*history(slips, unloaded))
    assert_allclose(found.cage.slip, LOST, rtol=1e-9)
    assert_allclose(found.orbit.slip, np.tile(slips, (TIME.size, 1)), atol=1e-9)
    assert_allclose(found.spin.slip, LOST, rtol=1e-9)


def test_there_is_no_slip_at_standstill():
    """Nor of a ring that hardly turns; neither is a number divided by zero."""
    data, document = history((0.0, 0.0, 0.0))
    data = data.assign(ring_rotation=("time", np.zeros(TIME.size)))
    document["case"]["dynamics"] = {}
    document["case"]["operation"] = {"outer_speed_rpm": 0.0}
    assert np.isnan(simulated_speeds(data, document).cage.slip).all()


def test_the_last_third_is_averaged():
    data, _ = history((0.0, 0.0, 0.0))
    assert TIME[averaged(data)][0] == pytest.approx(2.0 / 3.0 * TIME[-1], abs=0.005)
    assert averaged(data)[-1]
