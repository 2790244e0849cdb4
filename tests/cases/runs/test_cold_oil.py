"""Torque over the temperature by every way of lubrication, bearings written by `oilfilm init`: thick oil brakes.

What may fall is the rolling moment of a contact whose layer stays as it is: below the oil of the flooded film it goes
with the square of layer over film, and so with the viscosity to the power -0.7. That is SKF's dip of a bearing short of
oil, from phi_rs of 0.55 down to 0.2.
"""

from __future__ import annotations

import tomllib

import pytest
from typer.testing import CliRunner

from oilfilm.bearing.supply.supply import ReplenishedInlet
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.runs.bearing import run_case
from oilfilm.postprocess import summary

# temperatures from the pour point of the thickest mineral oil on [C]
TEMPERATURES = (-15.0, -5.0, 5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0)
# of the torque 10 K warmer, at least; a bearing of oil-air is short of oil from 25 C down
FALL = {"grease": 0.9, "oil bath": 0.9, "low oil bath": 0.9, "oil air": 0.7, "oil jet": 0.7}


def written(folder, bearing):
    """The document of a new case."""
    path = folder / f"{bearing}.toml"
    if not path.exists():
        done = CliRunner().invoke(app, ["init", str(path.with_suffix("")), "--bearing", bearing])
        assert done.exit_code == 0, done.output
    return tomllib.loads(path.read_text(encoding="utf-8"))


def at(folder, temperature, bearing, oil, speed, radial, axial, lubrication):
    """The case of a bearing at a temperature [C], films of the atlas."""
    document = written(folder, bearing)
    operation = {"inner_speed_rpm": speed, "radial_load_N": radial, "axial_load_N": axial}
    document["lubricant"]["name"] = oil
    document["operation"] |= {"temperature": "given", "temperature_C": temperature, **operation}
    for key in (
        "oil_level_mm",
        "oil_fraction",
        "cooling_oil_mL_min",
        "cooling_oil_C",
        "heat_transfer_W_K",
        "ambient_C",
    ):
        document["friction"].pop(key, None)
    document["friction"]["lubrication"] = lubrication
    document["ehl"]["film_maps"] = "none"
    document["assumed"] = []
    return case_of_document(document)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("cold")


# bearing, oil, speed [r/min], radial and axial load [N], lubrication
GREASED_6205 = ("6205", "iso vg 100", 1500.0, 700.0, 0.0, "grease")
BEARINGS = (
    GREASED_6205,
    ("6310", "iso vg 150", 1000.0, 4000.0, 0.0, "grease"),
    ("6208", "iso vg 68", 3000.0, 1500.0, 0.0, "oil bath"),
    ("7208B", "iso vg 46", 2500.0, 800.0, 1200.0, "oil bath"),
    ("6206", "iso vg 68", 300.0, 1000.0, 0.0, "low oil bath"),
    ("6208", "iso vg 68", 3000.0, 1500.0, 0.0, "oil air"),
)


def torques(folder, temperatures, given):
    """Totals at temperatures [N mm]."""
    return [run_case(at(folder, t, *given)).torque.total * 1e3 for t in temperatures]


@pytest.mark.parametrize("given", BEARINGS, ids=lambda given: f"{given[0]} {given[-1]}")
def test_torque_does_not_fall_into_the_cold(folder, given):
    found = torques(folder, TEMPERATURES, given)
    falls = [cold / warm for cold, warm in zip(found, found[1:], strict=False)]
    hot = [warm for warm, fall in zip(TEMPERATURES[1:], falls, strict=True) if fall < FALL[given[-1]]]
    assert hot == [], found


def test_greased_bearing_brakes_in_the_cold(folder):
    """Within a fifth of Palmgren's torque; light balls, between two films, roll on both.

    At -20 C, below the pour point, films fill the clearance and no balance of the balls is found; that is said.
    """
    palmgren, found = [], []
    for temperature in (-20.0, -10.0, 0.0, 20.0, 40.0):
        results = run_case(at(folder, temperature, *GREASED_6205))
        palmgren.append(results.torque.models["palmgren"].total * 1e3)
        found.append(results.torque.total * 1e3)
        unbalanced = any("torque_N_mm.total" in m and "not converged" in m for m in summary(results)["messages"])
        assert unbalanced is (temperature == -20.0)
    assert palmgren == pytest.approx([817.2, 293.7, 132.7, 43.4, 21.6], rel=0.01)
    assert found[1:] == pytest.approx(palmgren[1:], rel=0.2)
    assert palmgren[0] < found[0] < 2.0 * palmgren[0]
    assert found[1:] == pytest.approx([261.0, 111.8, 37.6, 24.2], rel=0.05)


def test_cold_oil_is_named_first(folder):
    messages = summary(run_case(at(folder, -25.0, *GREASED_6205)))["messages"]
    assert any("below its pour point, -19 C" in message for message in messages)
    assert any("torque_N_mm.total: an estimate, SKF's factors of the inlet" in message for message in messages)
    warm = summary(run_case(at(folder, 60.0, *GREASED_6205)))["messages"]
    assert not any("pour point" in message or "an estimate, SKF" in message for message in warm)


def test_films_stand_behind_the_layer_of_the_torque(folder):
    """Of oil-air: at 20 C with a phi_rs of 0.3; at 45 C, in the atlas, those of results and torque are one."""
    oil_air = ("6208", "iso vg 68", 3000.0, 1500.0, 0.0, "oil air")
    warm = run_case(at(folder, 45.0, *oil_air))
    pairs = [
        (film.supply, other.supply)
        for film, other in zip(warm.operating, warm.torque.shear.films, strict=True)
        if film is not None
    ]
    assert pairs and all(film == other for film, other in pairs)
    assert warm.replenishment_range is None
    results = run_case(at(folder, 20.0, *oil_air))
    assert isinstance(results.supply.oil, ReplenishedInlet)
    for film in results.torque.shear.films:
        if film is not None:
            assert film.supply.rolling_moment == pytest.approx(results.supply.oil.rolling_moment, rel=5e-3)
            # of a rigid contact, as of balls between two films, as little as of the moment
            assert film.supply.rolling_moment < film.supply.central < 0.97
            assert film.supply.central > 0.8 or film.conditions.load < 100.0
            assert film.central.value < film.central.value + film.central.supply < 1.05 * film.flooded_central
    low, high = results.replenishment_range
    assert low == pytest.approx(results.torque.total) and results.torque.total < high  # held nowhere


def test_a_bath_is_its_own_layer(folder):
    given = ("6208", "iso vg 68", 3000.0, 1500.0, 0.0)
    bath, low = (at(folder, 40.0, *given, kind).lubricant.flooded_layer for kind in ("oil bath", "low oil bath"))
    assert (bath, low) == (1.0e-3, 1.0e-4)
