"""Small parts of results and texts by values that a hand can compute."""

from __future__ import annotations

from math import cos, pi, sin
from types import SimpleNamespace

import numpy as np
import pytest
import xarray

from oilfilm.bearing.contacts.contact import Race
from oilfilm.bearing.heating.over_speed import SpeedBranch, SpeedLimit
from oilfilm.bearing.rating.life import LARGEST_A_ISO
from oilfilm.postprocess.batch import write
from oilfilm.postprocess.bearing.contact_quantities import finite_body_messages
from oilfilm.postprocess.bearing.summary import _life_text
from oilfilm.postprocess.bearing.torque import CHURNING_SHARE, _both_rings_message, _churning_share
from oilfilm.postprocess.dynamics import results
from oilfilm.postprocess.files import plain
from oilfilm.postprocess.report.page import _rows
from oilfilm.postprocess.report.pdf_and_workbook import _is_table
from oilfilm.postprocess.scene.patch import Patch
from oilfilm.postprocess.scene.vtk_history import MovingBearing, shown_rows
from oilfilm.postprocess.shaft.results import _heat
from oilfilm.postprocess.temperatures.results import balance_columns, temperature_study_messages


def test_defect_frequencies_of_a_simulation():
    """Z times the speed of the cage against each ring, that turns at the last of the schedule; gamma = D cos a/d_m."""
    schedule = np.zeros((2, 99))
    schedule[-1, results.INNER_SPEED], schedule[-1, results.OUTER_SPEED] = 2.0 * pi * 40.0, 2.0 * pi * -10.0
    simulation = SimpleNamespace(
        data=SimpleNamespace(schedule=schedule),
        bearing=SimpleNamespace(balls=8, ball_diameter=10.0, pitch_diameter=40.0),
    )
    numbers = SimpleNamespace(contact_angle=0.3, orbit_speed=2.0 * pi * 7.0, spin_speed=2.0 * pi * 90.0)
    found = results._frequencies(simulation, numbers)
    gamma = 0.25 * cos(0.3)
    cage = 0.5 * (40.0 * (1.0 - gamma) - 10.0 * (1.0 + gamma))
    assert found["kinematic"] == pytest.approx(
        {
            "cage": cage,
            "ball_pass_outer": 8 * (cage + 10.0),
            "ball_pass_inner": 8 * (40.0 - cage),
            "ball_spin": 0.5 * 50.0 * 4.0 * (1.0 - gamma**2),
        }
    )
    slipping = {"cage": 7.0, "ball_pass_outer": 8 * 17.0, "ball_pass_inner": 8 * 33.0, "ball_spin": 90.0}
    assert found["with_slip"] == pytest.approx(slipping)


def test_drag_is_told_where_it_is_much_of_the_total():
    def share(drag, total=10.0, chosen="films"):
        models = {"films": SimpleNamespace(components={"drag": drag})}
        return _churning_share(SimpleNamespace(models=models, chosen=chosen, total=total))

    assert share(4.0) == pytest.approx(0.4)
    assert share(0.99 * CHURNING_SHARE * 10.0) is share(None) is share(4.0, None) is share(4.0, 10.0, None) is None


@pytest.mark.parametrize(("outer", "drag", "told"), [(290.0, 4.0, True), (0.0, 4.0, False), (290.0, 0.5, False)])
def test_drag_over_a_small_difference_of_the_rings_is_told(outer, drag, told):
    """Balls that orbit at half the sum of both speeds lose the same power, whichever ring drives them."""
    models = {"films": SimpleNamespace(components={"drag": drag})}
    torque = SimpleNamespace(models=models, chosen="films", total=5.0)
    state = SimpleNamespace(operation=SimpleNamespace(shaft_speed=300.0 - outer), cage_speed=0.5 * (300.0 + outer))
    found = list(_both_rings_message(SimpleNamespace(quasistatic=state), torque))
    assert ["40 W over that difference" in message for message in found] == [True] * told


def test_life_at_its_limit():
    known = {"basic_reference_rating_h": 1000.0, "modified_reference_rating_h": 50_000.0, "a_1": 1.0}
    assert ", its limit" in _life_text(known | {"a_iso": LARGEST_A_ISO})
    assert "limit" not in _life_text(known | {"a_iso": 0.99 * LARGEST_A_ISO})
    assert "L10mh" in _life_text(known | {"a_iso": 3.0}) and "a_1" not in _life_text(known | {"a_iso": 3.0})
    other = _life_text(known | {"a_iso": 3.0, "a_1": 0.64})
    assert "Lnmh" in other and "a_1 0.64" in other
    assert "modified" not in _life_text(known | {"modified_reference_rating_h": None})


def test_conductances_of_a_shaft_and_its_housing():
    link = SimpleNamespace(
        node="shaft", bearings=(0, 1), description="", conductance=SimpleNamespace(value=2.0, low=1.0, high=5.0)
    )
    (path,) = _heat(
        SimpleNamespace(
            bearings=(),
            temperatures=np.zeros((2, 9)),
            stable=True,
            links=[link],
            flows=[7.0],
            film_range=np.zeros((2, 2)),
        )
    )["paths"]
    numbers = ("bearings", "conductance_W_K", "conductance_low_W_K", "conductance_high_W_K", "heat_W")
    assert [path[name] for name in numbers] == [[1, 2], 2.0, 1.0, 5.0, 7.0]


def test_changes_by_finite_bodies_are_told_for_both_races():
    changes = {
        Race.INNER: SimpleNamespace(pressure_share=0.01, film_share=-0.02),
        Race.OUTER: SimpleNamespace(pressure_share=-0.03, film_share=None),
    }
    (text,) = finite_body_messages(SimpleNamespace(finite_bodies=SimpleNamespace(reason="", at=changes.get)))
    assert "inner race +1.00% of Hertz' pressure, -2.00% of the central film; outer race -3.00%" in text
    assert list(finite_body_messages(SimpleNamespace(finite_bodies=None))) == []


@pytest.mark.parametrize(
    ("limit", "text"),
    [
        (SpeedLimit.RUNAWAY, "limiting speed 3000 r/min by heat, films at 80 C"),
        (SpeedLimit.NOT_REACHED, "limiting speed null: none up to 3000 r/min"),
        (SpeedLimit.NO_STATE, "limiting speed null: not converged beyond 2000 r/min, films at 60 C: stuck"),
    ],
)
def test_the_limit_of_the_speed_in_words(limit, text):
    speeds = [(3000.0, 80.0), (2000.0, 60.0)]
    balances = tuple(
        SimpleNamespace(speed=speed * pi / 30.0, state=SimpleNamespace(film_temperature=273.15 + film))
        for speed, film in speeds
    )
    branch = SpeedBranch(balances=balances, limited_by=limit, message="stuck")
    ended = SimpleNamespace(ended=True)
    results = SimpleNamespace(branch=branch, heating=SimpleNamespace(converged=True), warm_up=ended)
    (message,) = temperature_study_messages(results)
    assert message.startswith(text)


def test_records_of_vibrations_have_their_rate(tmp_path, monkeypatch):
    """n samples take n - 1 steps; shorter records end in NaN, points without one have no rate."""
    series = {"a": (np.linspace(1.0, 1.5, 6), np.arange(6.0)), "b": (np.linspace(0.0, 1.0, 3), np.ones(3))}
    for name in series:
        (tmp_path / f"{name}.nc").touch()
    monkeypatch.setattr(write, "read_variables", lambda path, *_: series[path.stem])
    monkeypatch.setattr(write, "_defects", lambda case: "none")
    points = [SimpleNamespace(key=key, summary={"vibration": {"strongest_line": key}}, case={}) for key in "abc"]
    found = write._records(SimpleNamespace(points=points), tmp_path)
    assert found["record.sample_rate_Hz"][1].tolist()[:2] == pytest.approx([10.0, 2.0])
    assert np.isnan(found["record.sample_rate_Hz"][1][2])
    whole = found["record.acceleration_m_s2"][1]
    assert whole.shape == (3, 6) and whole[0].tolist() == list(range(6)) and np.isnan(whole[1, 3:]).all()
    assert found["record.strongest_line"][1].tolist() == ["a", "b", "c"]


def test_what_is_a_table():
    assert _is_table([{"a": 1}]) and not any(map(_is_table, ([], [1], [{"a": 1}, 2], {"a": 1}, "text")))
    assert _rows([]) is _rows([{"a": 1}, 2]) is None
    table = _rows([{"a": 1, "b": 2}, {"a": 3}])
    assert len(table.rows) == 2 and all(len(cells) == 2 for _, cells in table.rows)


def test_values_become_plain_json():
    """Numbers and arrays of NumPy, also in tuples; what is not finite is null, with its path."""
    lost = []
    whole = {"a": np.array([1.0, np.inf]), "b": np.int64(3), "c": (1.0, float("nan")), "d": {"e": np.float64(0.5)}}
    found = plain(whole, "", lost)
    assert found == {"a": [1.0, None], "b": 3, "c": [1.0, None], "d": {"e": 0.5}}
    assert type(found["b"]) is int and type(found["d"]["e"]) is float and lost == ["a[1]", "c[1]"]


def test_a_relief_has_its_quantity_as_height():
    """The films' scale ends at its own top, that of pressures at the largest; both end at the height asked for."""
    x, y = np.meshgrid([0.0, 1.0, 2.0], [5.0, 6.0], indexing="ij")
    values = np.array([[1.0, 2.0], [0.0, 4.0], [3.0, 1.0]])
    plane = SimpleNamespace(
        x=x, y=y, film=values, pressure=10.0 * values, film_range=(0.0, 8.0), _grid=lambda points: points
    )
    for quantity, top in (("film", 8.0), ("pressure", 4.0)):
        points = Patch.relief(plane, quantity, 0.5)
        assert (points[..., 0] == x).all() and (points[..., 1] == y).all()
        assert points[..., 2] == pytest.approx(0.5 * values / top)


def balls_of_a_history(azimuths, angle=0.0):
    """Two samples of two balls on a pitch radius of 5, one race after the other under the same load."""
    places = np.stack([[(0.0, 5.0 * cos(psi), 5.0 * sin(psi)) for psi in row] for row in azimuths])
    size = (len(azimuths), 2, len(azimuths[0]))
    return xarray.Dataset(
        {
            "ball_position": (("time", "ball", "direction"), places),
            "contact_load": (("time", "race", "ball"), np.full(size, 7.0)),
            "contact_contact_angle": (("time", "race", "ball"), np.full(size, angle)),
        },
        coords={"time": 0.5 * np.arange(len(azimuths)), "race": ["inner", "outer"], "ball": range(1, size[2] + 1)},
        attrs={"ball_diameter": 2.0},
    )


def test_forces_of_the_races_on_balls():
    """The outer race pushes inwards at the far side of the ball, the inner one outwards; both lean by the angle."""
    data = balls_of_a_history([[0.0, 0.5 * pi]], angle=pi / 6.0)
    moving = MovingBearing(data=data, ball=None, marks=None, cage=None, ring=None)
    points, forces = moving.forces_at(0, "outer")
    lean, rise = 0.5, cos(pi / 6.0)
    assert points == pytest.approx(np.array([[lean, 5.0 + rise, 0.0], [lean, 0.0, 5.0 + rise]]))
    assert forces == pytest.approx(-7.0 * np.array([[lean, rise, 0.0], [lean, 0.0, rise]]))
    points, forces = moving.forces_at(0, "inner")
    assert points[0] == pytest.approx([-lean, 5.0 - rise, 0.0])
    assert forces[0] == pytest.approx([7.0 * lean, 7.0 * rise, 0.0])


def test_samples_shown_are_those_of_the_last_turns_or_of_a_window():
    """Ten samples a turn, of three turns the last; a window in seconds with both ends; not more than asked."""
    history = balls_of_a_history([[0.2 * pi * k, 0.0] for k in range(31)])
    assert shown_rows(history, 100, 1.0).tolist() == list(range(21, 31))
    assert shown_rows(history, 3, 1.0).tolist() == [21, 26, 30]
    assert shown_rows(history, 100, 9.0, (1.0, 3.0)).tolist() == [2, 3, 4, 5, 6]
    with pytest.raises(ValueError, match="1000 to 1200 ms"):
        shown_rows(history, 100, 1.0, (1.0, 1.2))


def test_columns_of_balances_over_the_speed():
    """Power over speed is the torque; temperatures in degrees Celsius, a column a node."""
    nodes = 273.15 + np.arange(8.0)
    states = [
        SimpleNamespace(
            friction=SimpleNamespace(power=power), film_temperature=300.0, clearance=2e-5, temperatures=nodes + k
        )
        for k, power in enumerate((6.0, 50.0))
    ]
    balances = [SimpleNamespace(speed=speed, state=state) for speed, state in zip((30.0, 100.0), states, strict=True)]
    found = balance_columns(SimpleNamespace(branch=SimpleNamespace(balances=balances)))
    by_unit = {"rpm": 30.0 / pi * np.array([30.0, 100.0]), "W": [6.0, 50.0], "N_mm": [200.0, 500.0], "um": [20.0, 20.0]}
    for unit, values in by_unit.items():
        (key,) = (key for key in found if key.endswith(f"_{unit}"))
        assert found[key] == pytest.approx(values), key
    assert found["shaft_temperature_C"] == pytest.approx([0.0, 1.0])
    assert found["housing_temperature_C"] == pytest.approx([7.0, 8.0])
