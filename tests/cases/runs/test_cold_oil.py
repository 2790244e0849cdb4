"""Torque over the temperature by every way of lubrication, ten bearings written by `oilfilm init`: thick oil brakes.

What may fall is the rolling moment of a contact whose layer stays as it is: below the oil of the flooded film it goes
with the square of layer over film, and so with the viscosity to the power -0.7. That is SKF's dip of a bearing short of
oil, from phi_rs of 0.55 down to 0.2. Totals lie between SKF's and Palmgren's but for what both leave open; SKF's phi_rs
is not held and leaves next to nothing in the cold.
"""

from __future__ import annotations

import tomllib
from datetime import UTC, datetime

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm.bearing import load_bearing
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.supply.inlet_oil import ReplenishedInlet, Supply
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.runs.bearing import run_case
from oilfilm.postprocess import summary

TEMPERATURES = (-40.0, -10.0, 0.0, 20.0, 40.0, 70.0, 100.0, 120.0)  # [C]
# of the torque of the next warmer temperature, at least; oil-air and jets are short of oil from 25 C down
FALL = {"grease": 0.9, "oil bath": 0.9, "low oil bath": 0.9, "oil air": 0.7, "oil jet": 0.7}
LOW, HIGH = 0.4, 1.5  # of the lesser and the larger one of SKF's and Palmgren's torque


def written(folder, bearing):
    """The document of a new case."""
    path = folder / f"{bearing.replace('/', '_')}.toml"
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
    ("6000", "iso vg 68", 6000.0, 120.0, 0.0, "grease"),
    ("6310", "iso vg 150", 1000.0, 4000.0, 0.0, "grease"),
    ("6306-2Z/C3", "iso vg 68", 2900.0, 1300.0, 0.0, "low oil bath"),
    ("6206", "iso vg 68", 300.0, 1000.0, 0.0, "low oil bath"),
    ("6020", "iso vg 46", 1500.0, 3000.0, 300.0, "oil bath"),
    ("7208B", "iso vg 46", 2500.0, 800.0, 1200.0, "oil bath"),
    ("7012C", "iso vg 32", 9000.0, 500.0, 600.0, "oil air"),
    ("61808", "iso vg 68", 3000.0, 400.0, 50.0, "oil air"),
    ("6005", "iso vg 150", 5000.0, 372.0, 0.0, "oil jet"),
)


@pytest.mark.parametrize("given", BEARINGS, ids=lambda given: f"{given[0]} {given[-1]}")
def test_torque_does_not_fall_into_the_cold(folder, given):
    states = [run_case(at(folder, t, *given)) for t in TEMPERATURES]
    assert not states[0].converged and "pour point" in states[0].broken_laws[0]
    assert summary(states[0])["torque_N_mm"]["total"] is None  # a solid is no oil
    found = [state.torque.total for state in states[1:]]
    pairs = zip(TEMPERATURES[2:], found, found[1:], strict=False)
    assert [warm for warm, cold, less in pairs if cold < FALL[given[-1]] * less] == [], found
    for celsius, total, state in zip(TEMPERATURES[1:], found, states[1:], strict=True):
        if state.converged:
            others = [state.torque.models[name].total for name in ("skf", "palmgren")]
            assert LOW * min(others) < total < HIGH * max(others), (celsius, total, others)


def test_greased_bearing_brakes_in_the_cold(folder):
    """Within half of Palmgren's torque; light balls find no more oil on the tracks than the heavy ones."""
    palmgren, found = [], []
    for temperature in (-10.0, 0.0, 20.0, 40.0):
        results = run_case(at(folder, temperature, *GREASED_6205))
        palmgren.append(results.torque.models["palmgren"].total * 1e3)
        found.append(results.torque.total * 1e3)
        assert results.converged
    assert palmgren == pytest.approx([293.7, 132.7, 43.4, 21.6], rel=0.01)
    assert all(0.45 < ours / theirs < 1.0 for ours, theirs in zip(found, palmgren, strict=True))
    assert found == pytest.approx([198.5, 65.5, 26.5, 19.1], rel=0.05)


def test_cold_oil_is_named_first(folder):
    """Below the pour point there is no torque; at -10 C an estimate, beside what grease adds to it."""
    frozen = summary(run_case(at(folder, -25.0, *GREASED_6205)))
    names = ("total", "parts", "total_range", "flooded_isothermal", "per_ball_N_mm")
    assert {frozen["torque_N_mm"][name] for name in names} == {None} and not frozen["converged"]
    models = frozen["torque_N_mm"]["models"]
    assert models["palmgren"]["total"] > 0.0 and models["integrated"]["total"] is None
    assert any("below its pour point, -19 C" in message for message in frozen["messages"])
    assert any("torque_N_mm.total: null, the oil lies below" in message for message in frozen["messages"])
    cold = summary(run_case(at(folder, -10.0, *GREASED_6205)))["messages"]
    (estimate,) = [one for one in cold if "torque_N_mm.total: an estimate, SKF's factors of the inlet" in one]
    assert "without yield stress and churning of the grease, which Palmgren's f_0 holds: 294 N mm" in estimate
    warm = summary(run_case(at(folder, 60.0, *GREASED_6205)))["messages"]
    assert not any("pour point" in message or "an estimate, SKF" in message for message in warm)


def test_a_jet_of_a_known_flow_takes_its_layer_from_it(folder):
    """More than its replenishment leaves: 100 mL/min keep five sixths of the films, a quarter of the moment."""
    given = ("6005", "iso vg 150", 10000.0, 372.0, 52.0, "oil jet")
    case = at(folder, 20.0, *given)
    document = written(folder, "6005")
    document["lubricant"]["name"] = "iso vg 150"
    document["operation"] |= case.document["operation"]
    document["friction"] |= {"lubrication": "oil jet", "cooling_oil_mL_min": 100.0}
    document["ehl"]["film_maps"] = "none"
    document["assumed"] = []
    jet = case_of_document(document)
    assert isinstance(jet.friction.jet, Supply) and jet.inlet.replenishment == 1.0 > case.inlet.replenishment
    films = [film for film in run_case(jet).torque.shear.films if film is not None]
    heavy = [film.supply for film in films if film.conditions.load > 100.0]
    assert all(own.central > 0.84 and own.rolling_moment > 0.23 > case.inlet.replenishment for own in heavy)


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
    left = results.supply.oil.rolling_moment
    for race in Race:
        pairs = zip(results.contacts, results.torque.shear.films, strict=True)
        films = [film for contact, film in pairs if film is not None and contact.race is race]
        heaviest = max(films, key=lambda film: film.conditions.load)
        assert heaviest.supply.rolling_moment == pytest.approx(left, rel=5e-3)
        for film in films:
            # lighter balls find the layer of the heaviest one, and have thicker flooded films
            assert film.supply.rolling_moment < left * 1.005
            assert film.supply.rolling_moment < film.supply.central < 0.97
            assert film.central.value <= film.central.value + film.central.supply < 1.05 * film.flooded_central
        free = [film.central.value for film in films if film.conditions.load < 0.01 * heaviest.conditions.load]
        assert free and max(free) < 1.5 * heaviest.central.value
    low, high = results.replenishment_range
    assert low == pytest.approx(results.torque.total) and results.torque.total < high  # held nowhere


def test_a_bath_is_its_own_layer(folder):
    given = ("6208", "iso vg 68", 3000.0, 1500.0, 0.0)
    bath, low = (at(folder, 40.0, *given, kind).lubricant.flooded_layer for kind in ("oil bath", "low oil bath"))
    assert (bath, low) == (1.0e-3, 1.0e-4)


def test_thick_oil_in_a_bath_loses_its_films_to_the_heat_of_the_inlets(folder):
    """At -20 C L_T is 250: films of 20 to 30 um would press all balls with kilonewtons. Displacement, loads and life
    are those of the balance with films.
    """
    at_20, cold = (run_case(at(folder, t, "6306", "iso vg 68", 2900.0, 1300.0, 0.0, "oil bath")) for t in (20.0, -20.0))
    palmgren = cold.torque.models["palmgren"].total
    assert 0.5 * palmgren < cold.torque.total < 1.6 * palmgren
    assert cold.converged
    for results in (at_20, cold):
        state = results.quasistatic
        loads = [contact.load for contact in results.contacts[::2]]
        assert state.inner_load == pytest.approx(loads, rel=1e-9)
    # thin films lift the ring; thick ones push it down from above, too
    assert 0.5e-6 < at_20.elastic.displacement[1] - at_20.quasistatic.displacement[1] < 4e-6
    assert cold.life.basic_life < 0.8 * at_20.life.basic_life
    messages = summary(cold)["messages"]
    assert any("an estimate, the heat of some inlets lies beyond" in message for message in messages)


def test_films_within_the_roughness_rub(folder):
    """Without [surface] a typical roughness is assumed, and named: 1 r/min has the friction of the boundary."""
    document = at(folder, 70.0, "6306", "iso vg 68", 1.0, 1300.0, 0.0, "oil bath").file.model_dump(exclude_none=True)
    del document["surface"]
    document = {key: value for key, value in document.items() if value} | {"assumed": []}
    results = run_case(case_of_document(document))
    assert results.torque.total == pytest.approx(results.torque.models["skf"].total, rel=0.25)
    found = summary(results)
    assert found["case"]["surface"]["ball_roughness_um"] == 0.02
    assert "surface.ball_roughness_um" in found["case"]["assumed"]
    assert any("asperities carry 9" in message for message in found["messages"])
    assert found["torque_N_mm"]["total_range"]["parts"]["roughness"]["high"] > found["torque_N_mm"]["total"]
    assert all(one["lambda_ratio"] for one in found["contacts"] if one["film_minimum_um"])


def strangers():
    """Two bearings drawn by the date: designation, oil, speed, radial and axial load, lubrication."""
    generator = np.random.default_rng(int(datetime.now(tz=UTC).strftime("%Y%m%d")))
    for names in (("6004", "6207", "6308", "6212", "16006", "6403"), ("7206B", "7305C", "7010AC", "6008", "61907")):
        name = str(generator.choice(names))
        entry = load_bearing(name)
        speed = generator.uniform(2e4, 2.5e5) / (1e3 * entry.pitch_diameter)
        load = generator.uniform(0.02, 0.1) * 2.6e7 * entry.balls * entry.ball_diameter**2
        axial = float(generator.choice([0.0, 0.6])) if name[0] == "6" else 0.8
        lubrication = str(generator.choice(["oil bath", "grease", "low oil bath"]))
        yield name, f"iso vg {generator.choice([32, 68, 150])}", speed, load, axial * load, lubrication


@pytest.mark.parametrize("given", list(strangers()), ids=lambda given: f"{given[0]} {given[-1]}")
def test_film_torque_life_and_temperature_tell_one_story(folder, given):
    """At -30, 20 and 110 C: one film in table, torque and lambda, one equilibrium in loads, life and position; below
    the pour point none of oil; as thick oil gets thin, films and kappa fall.
    """
    kappas, films = [], []
    for celsius in (-30.0, 20.0, 110.0):
        results = run_case(at(folder, celsius, *given))
        found = summary(results)
        heavy = max(found["contacts"], key=lambda one: one["load_N"])
        state = results.quasistatic
        assert state.operation.temperature == pytest.approx(celsius + 273.15)
        assert found["life"]["basic_reference_rating_h"] > 0.0
        if results.frozen:
            nothing = (found["torque_N_mm"]["total"], found["life"]["kappa"], found["life"]["a_iso"])
            assert nothing == (None, None, None) and not found["converged"]
            assert all(one["film_central_um"] is None for one in found["contacts"])
            assert state is results.elastic
            continue
        assert found["converged"] or any("not converged" in message for message in found["messages"])
        for contact, film, sheared in zip(results.contacts, results.operating, results.torque.shear.films, strict=True):
            if film is not None:
                assert sheared.central.value == pytest.approx(film.central.value, rel=1e-9)
                assert contact.load == pytest.approx(
                    (state.inner_load if contact.race is Race.INNER else state.outer_load)[contact.ball - 1], rel=1e-6
                )
        others = [results.torque.models[name].total for name in ("skf", "palmgren")]
        assert 0.3 * min(others) < results.torque.total < 2.0 * max(others), (given, celsius, others)
        kappas.append(found["life"]["kappa"])
        films.append(heavy["film_central_um"])
    assert kappas == sorted(kappas, reverse=True)
    known = [film for film in films if film is not None]
    assert known == sorted(known, reverse=True)
