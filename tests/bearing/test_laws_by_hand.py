"""Small laws of a bearing by values that a hand can compute: exponents, signs, factors, sides and ends."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from types import SimpleNamespace

import numpy as np
import pytest

from oilfilm.bearing.contacts.electrical import bearing_electrical
from oilfilm.bearing.dynamics import _implicit_kernels as implicit
from oilfilm.bearing.dynamics.arrays import (
    BODIES,
    CONTACT,
    EXPONENT,
    FREE_TURN,
    INNER,
    KNOTS,
    LINEAR,
    OUTER,
    STIFFNESS,
    Layout,
)
from oilfilm.bearing.dynamics.reduction import solved_indices
from oilfilm.bearing.films.film import ContactFilm, FilmThickness, with_films
from oilfilm.bearing.films.heavy_moment import elastic_moment, heavy_moment, moment_unit
from oilfilm.bearing.heating import heat_state
from oilfilm.bearing.heating.friction_heat import loaded_half
from oilfilm.bearing.invariants import _frequencies
from oilfilm.bearing.quasistatic.solution import _cage_speed
from oilfilm.bearing.rating import dry_running
from oilfilm.bearing.torque import models
from oilfilm.bearing.torque.skf import Series
from oilfilm.bearing.vibration.form import rolled


def contact(radius_x=2.0, radius_y=2.0, speed=3.0, viscosity=0.5, modulus=7.0):
    oil = SimpleNamespace(viscosity=viscosity)
    return SimpleNamespace(
        radius_x=radius_x, radius_y=radius_y, entrainment_speed=speed, lubricant=oil, reduced_modulus=modulus
    )


def test_moments_of_rolling():
    """M_0 = 24 pi eta u Rx^2/((3 + 2 k) sqrt k), k = Rx/Ry; of round contacts beta is one in Biboulet's formula."""
    assert moment_unit(contact()) == pytest.approx(24.0 * pi * 0.5 * 3.0 * 4.0 / 5.0)
    assert moment_unit(contact(radius_y=0.5)) == pytest.approx(24.0 * pi * 0.5 * 3.0 * 4.0 / 22.0)
    round_one = heavy_moment(contact(), 0.1, 0.1)
    assert round_one == pytest.approx(3.6 * 0.1 * (2.0 * 0.5 * 3.0 / (7.0 * 2.0)) ** 0.75 * 7.0 * 8.0)
    assert heavy_moment(contact(viscosity=1.0), 0.1, 0.1) == pytest.approx(2.0**0.75 * round_one)
    assert heavy_moment(contact(modulus=14.0), 0.1, 0.1) == pytest.approx(2.0**0.25 * round_one)
    # E of a flat ellipse is one: beta = (4/pi)/(1 + Rx/Ry), whichever axis is the longer
    flat = heavy_moment(contact(radius_y=8.0), 1e5, 1e-5) / heavy_moment(contact(radius_y=8.0), 1e-5, 1e5)
    assert flat == pytest.approx(1e10)
    wide = heavy_moment(contact(radius_y=8.0), 0.1, 1e-6) / round_one
    assert wide == pytest.approx((4.0 / pi / 1.25) ** -0.25, rel=1e-6)


def test_moment_of_hysteresis():
    hertz = SimpleNamespace(semi_axis_x=0.25, semi_axis_y=9.0)
    assert elastic_moment(SimpleNamespace(hertz=hertz, load=16.0), 0.5) == pytest.approx(0.375)
    assert elastic_moment(SimpleNamespace(hertz=None, load=16.0), 0.5) == 0.0


@pytest.mark.parametrize("direction", [0.0, 90.0, 200.0])
def test_loaded_half_is_that_of_the_load(direction):
    """Balls within a quarter turn of the load's direction; at right angles, and of an axial load, by half."""
    psi = np.radians(direction + np.array([0.0, 60.0, 90.0, 180.0, 270.0, 300.0]))
    load = np.array([5.0, 2.0, 1.0, 0.5, 1.0, 2.0])
    solution = SimpleNamespace(azimuth=psi, outer_load=load)
    assert loaded_half(solution).tolist() == [1.0, 1.0, 0.5, 0.0, 0.5, 1.0]
    even = SimpleNamespace(azimuth=np.radians([0.0, 120.0, 240.0]), outer_load=np.full(3, 7.0))
    assert loaded_half(even).tolist() == [0.5] * 3


def test_pressures_on_the_lines_of_an_ellipse():
    """sqrt(1 - x^2 - y^2), two thirds in the mean over the circle; lines beside the middle stand for two."""
    pressures, count = heat_state._hertz_pressures()
    assert pressures.max() == 1.0 == pressures[pressures.shape[0] // 2, 0]
    assert pressures[::-1] == pytest.approx(pressures) and count.tolist() == [1.0, *[2.0] * (count.size - 1)]
    inside = (pressures > 0.0).astype(float)
    assert (pressures @ count).sum() / (inside @ count).sum() == pytest.approx(2.0 / 3.0, rel=0.1)
    steps = count.size - 1
    assert pressures[steps, 1] == pytest.approx((1.0 - 1.0 / steps**2) ** 0.5)


def test_unknowns_are_the_free_coordinates_and_their_speeds():
    layout = Layout(3)
    everything = solved_indices(np.ones(FREE_TURN + 3), 3)
    assert everything.tolist() == list(range(layout.size))
    free = np.ones(FREE_TURN + 3)
    free[[1, BODIES + 2]] = 0.0  # ring along y; balls along z
    gone = [1, layout.positions + 1, *range(BODIES + 2, layout.positions, 3)]
    gone += range(layout.positions + BODIES + 2, 2 * layout.positions, 3)
    assert solved_indices(free, 3).tolist() == sorted(set(range(layout.size)) - set(gone))


def test_ball_pass_frequencies_add_up():
    """BPFO + BPFI = Z |n_i - n_o|; a state whose numbers break it, or whose cage overtakes both rings, is told."""

    def faults(cage=80.0, outer=9.0 * 80.0 / (2.0 * pi), inner=9.0 * 120.0 / (2.0 * pi)):
        operation = SimpleNamespace(inner_speed=200.0, outer_speed=0.0)
        state = SimpleNamespace(operation=operation, cage_speed=cage, bearing=SimpleNamespace(balls=9))
        found = SimpleNamespace(ball_pass_outer=outer, ball_pass_inner=inner)
        return list(_frequencies(SimpleNamespace(quasistatic=state, frequencies=found)))

    assert faults() == []
    assert len(faults(outer=90.0)) == len(faults(cage=201.0)) == len(faults(cage=-1.0)) == 1


def test_a_ball_over_a_step_goes_round_its_edge():
    """Over a spike of height d the path of a ball is d - s^2/(2 R), as far as this lies above the groove."""
    profile = np.zeros(3600)
    profile[1000] = 2e-6
    path = rolled(profile, 0.02, 0.005)
    s = 2.0 * pi * 0.02 / 3600 * (np.arange(3600) - 1000)
    assert path == pytest.approx(np.maximum(2e-6 - s**2 / 0.01, 0.0), abs=1e-15)


def test_a_film_without_a_layer_is_its_own_flooded_one():
    field = ContactFilm.flooded_field.fget
    solved, behind = SimpleNamespace(supply=None), SimpleNamespace(supply=SimpleNamespace(flooded="whole"))
    assert field(SimpleNamespace(field=None)) is None
    assert field(SimpleNamespace(field=solved)) is solved and field(SimpleNamespace(field=behind)) == "whole"


def test_balls_that_insulate_have_no_breakdown(monkeypatch):
    from oilfilm.bearing.contacts import electrical

    monkeypatch.setattr(electrical, "_paths", lambda *_: [(1, 2, 3), (1, 2, 3)])
    monkeypatch.setattr(electrical, "_in_series", lambda *_: (2.0, 1.0, 4.0))
    monkeypatch.setattr(electrical, "_first_breakdown", lambda inner, outer, end: 10.0 * inner + end)
    found = [bearing_electrical(SimpleNamespace(ball_material=SimpleNamespace(kind=kind)), (), ())
             for kind in (electrical.INSULATOR, None)]  # fmt: skip
    assert [(one.capacitance, one.capacitance_low, one.capacitance_high) for one in found] == [(4.0, 2.0, 8.0)] * 2
    assert found[0].breakdown_voltage is found[0].breakdown_voltage_low is found[0].breakdown_voltage_high is None
    voltages = found[1].breakdown_voltage, found[1].breakdown_voltage_low, found[1].breakdown_voltage_high
    assert voltages == (10.0, 11.0, 12.0)


def test_the_cage_turns_with_the_loaded_balls():
    orbit = np.array([1.0, 2.0, 4.0])
    assert _cage_speed(orbit, np.array([0.0, 5.0, 3.0])) == 3.0
    assert _cage_speed(orbit, np.zeros(3)) == pytest.approx(7.0 / 3.0)


@dataclass(frozen=True)
class Field:
    """A gap as a film needs it, in units of a micrometre."""

    X: np.ndarray
    Y: np.ndarray
    H: np.ndarray
    film_scale: float = 1e-6
    film_central_dimensionless: object = None
    film_minimum_dimensionless: object = None


def test_a_field_of_other_films():
    """Below the centre linear between both films, above it a shift; a film left out keeps its share of the centre."""
    gap = np.array([[9.0, 3.0, 5.0], [2.0, 4.0, 3.0], [8.0, 3.0, 6.0]])
    field = Field(X=np.array([-1.0, 0.0, 1.0]), Y=np.array([-1.0, 0.0, 1.0]), H=gap)
    central = FilmThickness(2e-6, 1e-7)
    other = with_films(field, central, FilmThickness(0.5e-6, 1e-7)).H
    assert other[1, 1] == pytest.approx(2.0) and other[1, 0] == pytest.approx(0.5)
    assert other[0, 1] == pytest.approx(1.25)  # half way
    assert other[0] - 1.25 == pytest.approx([5.75, 0.0, 1.75])  # 9 and 5 of before, less two
    halved = with_films(field, central, None)
    assert halved.H.min() == pytest.approx(1.0)
    assert halved.film_minimum_dimensionless.uncertainty == pytest.approx(0.05)


@pytest.mark.parametrize(("share", "stiff"), [(0.99, False), (1.01, True)])
def test_friction_is_stiff_where_a_step_is_longer_than_its_rates(monkeypatch, share, stiff):
    """The rates of both races add; of the load of the slopes as it is, none where it has left them."""
    for name in ("sliding_rate", "load_share"):
        monkeypatch.setattr(implicit, name, getattr(implicit, name).py_func)
    law = np.zeros((2, KNOTS))
    law[:, STIFFNESS], law[:, EXPONENT] = 3.0, 1.0
    linear = np.zeros((2, LINEAR.size))
    linear[:, LINEAR.load] = 6.0
    linear[INNER, LINEAR.rate], linear[OUTER, LINEAR.rate] = 10.0, 30.0
    race_out = np.zeros((2, len(CONTACT)))
    race_out[:, CONTACT.approach] = 2.0  # the load of the slopes
    p = SimpleNamespace(implicit_step=[share * implicit.STIFF / 40.0], normal=law, constants=SimpleNamespace(balls=1))
    balls = [SimpleNamespace(race_out=race_out, linear=linear)]
    assert implicit.friction_is_stiff.py_func(p, balls) is stiff
    race_out[:, CONTACT.approach] = 0.0
    assert implicit.friction_is_stiff.py_func(p, balls) is False


def test_life_of_the_film_that_a_cage_gives():
    """Half the share of the pocket's play, D deep, over half the ball's surface, of Z pockets."""
    bearing = SimpleNamespace(ball_diameter=2.0, balls=5)
    play = dry_running.library_data(dry_running.TYPICAL)["cage_pocket_clearance_over_ball"]
    found = dry_running._film_life(bearing, dry_running.Range(4.0, 2.0, 8.0))
    volume = 0.5 * 2.0 * (2.0 * pi) * 5.0
    assert found == pytest.approx(
        (play["value"] * volume / 4.0, play["range"][0] * volume / 8.0, play["range"][1] * volume / 2.0)
    )


def test_loads_and_oil_of_skfs_model(monkeypatch):
    """Radial and axial load of the ring without their signs, kinematic viscosity; round-off is no load."""
    monkeypatch.setattr(models, "bearing_kind", lambda bearing: Series.DEEP_GROOVE)
    monkeypatch.setattr(models, "static_capacity", lambda bearing, friction: 1e4)
    monkeypatch.setattr(models, "_seal_diameter", lambda bearing, friction: None)
    names = ("lubrication", "oil", "oil_level", "boundary", "full_film", "drag_factor", "sealed")
    friction = SimpleNamespace(series="62", **dict.fromkeys(names))
    solution = SimpleNamespace(
        bearing=SimpleNamespace(bore=0.03, outside_diameter=0.062),
        ring_force=(-12.0, 3.0, -4.0),
        operation=SimpleNamespace(shaft_speed=70.0),
    )
    oil = SimpleNamespace(dry=False, viscosity=0.02, density=800.0)
    _, at = models._skf_inputs(solution, oil, friction)
    assert (at.radial_load, at.axial_load, at.speed, at.viscosity) == (5.0, 12.0, 70.0, 2.5e-5)
    assert models.ring_loads(SimpleNamespace(ring_force=(-12.0, 0.0, 1e-14))) == (0.0, 12.0)
    assert models.ring_loads(SimpleNamespace(ring_force=(1e-14, 0.0, -5.0))) == (5.0, 0.0)
