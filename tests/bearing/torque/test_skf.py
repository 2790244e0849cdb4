"""SKF's friction model and Palmgren's.

Sources of the numbers: Table 2 of the sliding friction paper of deep groove bearings (axial load, printed there; radial
and combined re-computed from the catalogue's formulas, the paper prints half the radial part), and values computed
independently from the catalogue's formulas. Units of the tables: N, mm, r/min, mm^2/s, N mm.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing import Operation, solve_quasistatic
from oilfilm.bearing.torque.models import ring_loads
from oilfilm.bearing.torque.skf import (
    Lubrication,
    Series,
    SkfBearing,
    SkfOperation,
    directed_load,
    load_factor,
    palmgren_torque,
    skf_constants,
    skf_series,
    skf_torque,
    sliding_friction,
    viscous_factor,
)
from oilfilm.ehl.units import MILLIMETRE as MM
from oilfilm.ehl.units import NEWTON_MILLIMETRE as N_MM
from oilfilm.ehl.units import RPM, to_si

MM2_S = to_si("viscosity_mm2_s", 1.0)

B6206 = SkfBearing(
    constants=skf_constants(Series.DEEP_GROOVE, "62"), bore=30 * MM, outside_diameter=62 * MM, static_rating=11200.0
)
B6208 = SkfBearing(
    constants=skf_constants(Series.DEEP_GROOVE, "62"), bore=40 * MM, outside_diameter=80 * MM, static_rating=19000.0
)
B7210 = SkfBearing(constants=skf_constants(Series.ANGULAR_CONTACT, "72 B"), bore=50 * MM, outside_diameter=90 * MM)


def operation(speed, radial, axial, viscosity=20.0, **more):
    return SkfOperation(radial_load=radial, axial_load=axial, speed=speed * RPM, viscosity=viscosity * MM2_S, **more)


@pytest.mark.parametrize(
    ("loads", "expected"),
    [
        ((0.0, 500.0), (26.36453, 14.10144, 14.10132)),
        ((500.0, 0.0), (3.51479, 1.87993, 1.87992)),
        ((1000.0, 1000.0), (63.34364, 33.88024, 33.87994)),
    ],
)
def test_sliding_moment_of_the_6206(loads, expected):
    """500, 5000, 15000 r/min, mu_bl 0.12, mu_EHL 0.05; seven figures."""
    for speed, moment in zip((500.0, 5000.0, 15000.0), expected, strict=True):
        assert skf_torque(B6206, operation(speed, *loads)).sliding / N_MM == pytest.approx(moment, abs=6e-6)


def test_6208():
    """3000 r/min, 2000 N radial, without and with 800 N axial, nu 20, K_rs 3e-8, mineral oil; mu_bl 0.12."""
    torque = skf_torque(B6208, operation(3000.0, 2000.0, 0.0))
    assert torque.inlet_shear_factor == pytest.approx(0.9375, abs=5e-5)
    assert torque.replenishment_factor == pytest.approx(0.9584, abs=5e-5)
    assert torque.rolling / N_MM == pytest.approx(47.77, abs=5e-3)
    assert torque.sliding / N_MM == pytest.approx(17.70, abs=5e-3)
    torque = skf_torque(B6208, operation(3000.0, 2000.0, 800.0))
    assert torque.rolling / N_MM == pytest.approx(106.46, abs=5e-3)
    assert torque.sliding / N_MM == pytest.approx(36.22, abs=5e-3)


def test_7210_BE():
    torque = skf_torque(B7210, operation(6000.0, 0.0, 2000.0, viscosity=15.0))
    assert torque.rolling / N_MM == pytest.approx(153.2, abs=0.05)
    assert torque.sliding / N_MM == pytest.approx(123.4, abs=0.05)


def test_a_load_in_kilonewtons_is_another_load():
    """The formulas are not homogeneous: 2000 N must not come out as 2 N times a power of ten."""
    heavy, light = (skf_torque(B6208, operation(3000.0, load, 0.0)) for load in (2000.0, 2.0))
    assert heavy.sliding / light.sliding == pytest.approx(1000.0 ** (5 / 3), rel=1e-9)
    assert heavy.rolling / light.rolling == pytest.approx(1000.0**0.54, rel=1e-9)


def test_at_rest_only_boundary_friction_and_seals_are_left():
    torque = skf_torque(replace(B6208, sealed=True), operation(0.0, 1000.0, 0.0, oil_level=0.02))
    assert torque.friction_coefficient == pytest.approx(0.12)
    assert torque.rolling == torque.drag == 0.0
    assert torque.seal / N_MM == pytest.approx(0.018 * 40.0**2.25 + 20.0)


def test_drag_grows_with_the_level_and_doubles_in_a_jet():
    levels = (0.0, 0.002, 0.006, 0.02, 0.05)
    drags = [skf_torque(B6208, operation(6000.0, 500.0, 0.0, oil_level=h)).drag for h in levels]
    assert drags[0] == 0.0
    assert all(a < b for a, b in zip(drags, drags[1:], strict=False))
    near, full, over = (skf_torque(B6208, operation(6000.0, 500.0, 0.0, oil_level=h)).drag for h in (0.07, 0.072, 0.2))
    assert drags[-1] < near < full == pytest.approx(over)  # no deeper than 1.2 d_m
    jet = operation(6000.0, 500.0, 0.0, oil_level=0.02, lubrication=Lubrication.OIL_JET)
    assert skf_torque(B6208, jet).drag == pytest.approx(2.0 * drags[3])
    grease = replace(jet, lubrication=Lubrication.GREASE)
    assert skf_torque(B6208, grease).drag == 0.0


def test_the_two_parts_of_the_drag():
    """6208 in oil up to 0.6 d_m above the lowest contact, where t = pi, f_t = 1, R_s = 0.36 d_m^2 pi f_A; by hand."""
    bath = operation(3000.0, 500.0, 0.0, oil_level=0.6 * 60 * MM, drag_factor=0.0)
    area = 0.36 * 60.0**2 * np.pi * 0.05 * 3.1 * 120.0 / 40.0  # K_Z = 3.1
    around = 1.093e-7 * 3000.0**2 * 60.0**3 * (3000.0 * 60.0**2 / 20.0) ** -1.379 * area
    assert skf_torque(B6208, bath).drag / N_MM == pytest.approx(around, rel=1e-12)
    churned = 0.4 * 1e-3 * 3.1 * 120.0 / 40.0 * 1e-12 * 60.0**5 * 3000.0**2  # 26 N mm
    both = skf_torque(B6208, replace(bath, drag_factor=1e-3)).drag / N_MM
    assert both - around == pytest.approx(churned, rel=1e-12)


def test_replenishment_by_the_lubrication():
    """ln phi_rs = -K_rs nu n (d + D) sqrt(K_Z/(2 (D - d))), 6208 at 20 mm^2/s and 3000 r/min, K_Z = 3.1."""
    unit = 20.0 * 3000.0 * 120.0 * (3.1 / 80.0) ** 0.5
    expected = {"oil bath": 0.0, "low oil bath": 3e-8, "oil jet": 3e-8, "grease": 6e-8, "oil air": 6e-8}
    for way in set(Lubrication) - {Lubrication.DRY}:
        torque = skf_torque(B6208, operation(3000.0, 2000.0, 0.0, lubrication=way))
        assert -np.log(torque.replenishment_factor) / unit == pytest.approx(expected[way.value], abs=1e-20)


def test_sliding_friction_between_its_ends():
    """Boundary at rest, full film at speed; between them phi_bl = exp(-2.6e-8 (n nu)^1.4 d_m) at 100 r/min."""
    assert sliding_friction(0.0, 20 * MM2_S, 60 * MM, 0.05) == 0.12
    assert sliding_friction(3000 * RPM, 20 * MM2_S, 60 * MM, 0.05) == pytest.approx(0.05, abs=1e-3)
    share = np.exp(-2.6e-8 * 2000.0**1.4 * 60.0)
    slow = sliding_friction(100 * RPM, 20 * MM2_S, 60 * MM, 0.05)
    assert slow == pytest.approx(share * 0.12 + (1.0 - share) * 0.05, rel=1e-12)


def test_every_series_gives_a_moment():
    for kind in Series:
        for series in skf_series(kind):
            bearing = replace(B6208, constants=skf_constants(kind, series))
            assert skf_torque(bearing, operation(3000.0, 1000.0, 500.0)).total > 0.0


def test_unknown_series_and_missing_rating():
    with pytest.raises(ValueError, match="known: 2, 3"):
        skf_constants(Series.DEEP_GROOVE, "99")
    with pytest.raises(ValueError, match="static_rating"):
        skf_torque(replace(B6208, static_rating=None), operation(3000.0, 0.0, 500.0))


def test_palmgren_is_continuous_where_its_branches_meet():
    """160 = 2000^(2/3) to 0.8 %: what the printed constants allow; and f_0 multiplies both branches."""
    for factor in (1.0, 2.0):
        below, above = (palmgren_torque(60 * MM, n * RPM, 20 * MM2_S, factor, (0.0, 0.0))[0] for n in (99.99, 100.01))
        assert below == pytest.approx(above, rel=0.009)
        assert below == pytest.approx(factor * 160e-7 * 60.0**3 * N_MM, rel=1e-12)


def test_palmgren_of_a_6208():
    """nu n = 60000: M_0 = 2e-7 60000^(2/3) 60^3 = 66.2 N mm; M_1 = f_1 P_1 d_m."""
    f_1 = load_factor("deep groove", 2000.0, 19000.0)
    f_0 = viscous_factor("deep groove", "oil bath")
    viscous, load = palmgren_torque(60 * MM, 3000 * RPM, 20 * MM2_S, f_0, (f_1, 2000.0))
    assert viscous / N_MM == pytest.approx(2e-7 * 60000.0 ** (2 / 3) * 60.0**3)
    assert load / N_MM == pytest.approx(0.00075 * (2 / 19) ** 0.55 * 2000.0 * 60.0)


def test_directed_load():
    assert directed_load("deep groove", 1000.0, 100.0) == 1000.0
    assert directed_load("deep groove", 100.0, 1000.0) == pytest.approx(3290.0)
    assert directed_load("angular contact", 100.0, -1000.0) == pytest.approx(990.0)


def test_round_off_of_an_axial_load_is_none(bearings):
    """SKF's formulas for radial and combined load do not meet: a thrust of rounding must not choose between them."""
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=500.0, force=(0.0, 1000.0, 0.0)))
    noisy = replace(state, ring_force=np.array([1e-9, 1000.0, 0.0]))
    assert ring_loads(noisy) == (1000.0, 0.0)
    assert ring_loads(state) == (pytest.approx(1000.0), 0.0)
    assert ring_loads(replace(state, ring_force=np.array([-1.0, 3.0, 4.0]))) == (5.0, 1.0)
