"""`oilfilm temperatures`: balances over the speed, what bounds it, and the course from the start."""

from __future__ import annotations

import json

import pytest
from typer.testing import CliRunner

from oilfilm import postprocess
from oilfilm.cases.cli.main import app

from ...kept import drawn, kept

CASE = """
schema_version = 1
title = "warm"
[bearing]
name = "6208"
bore_mm = 40.0
outside_diameter_mm = 80.0
width_mm = 18.0
inner_ring_material = "bearing steel"
outer_ring_material = "bearing steel"
ball_material = "bearing steel"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 6000.0
radial_load_N = 2000.0
temperature_C = 40.0
[ehl]
film_maps = "none"
[friction]
heating_torque = "palmgren"
heat_transfer_W_K = 2.0
"""
NODES = ("shaft", "inner_ring", "balls", "outer_ring_loaded", "outer_ring_unloaded", "cage", "oil", "housing")


SHOWN = {}  # of the run in `written`


def oilfilm(*words):
    return CliRunner().invoke(app, list(words))


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Summary and folder of a run."""
    folder = tmp_path_factory.mktemp("temperatures")
    (folder / "case.toml").write_text(CASE)
    with drawn(as_well=True) as SHOWN["pictures"]:
        answer = oilfilm("temperatures", str(folder / "case.toml"), "-o", str(folder / "out"), "--json", "-q")
    assert answer.exit_code == 0, answer.output
    return json.loads(answer.stdout), folder


def test_balances_rise_with_the_speed_to_the_limit(written):
    """Oil that thins: films warm with the speed, up to the highest temperature; the case's own balance among them."""
    document, _ = written
    speeds = [row["speed_rpm"] for row in document["balances"]]
    films = [row["film_temperature_C"] for row in document["balances"]]
    assert speeds == sorted(speeds)
    assert films == sorted(films)
    assert document["limited_by"] == "temperature"
    assert document["limiting_speed_rpm"] == pytest.approx(speeds[-1])
    assert films[-1] == pytest.approx(150.0)
    assert any(speed == pytest.approx(6000.0) for speed in speeds)
    assert any("limiting speed" in message for message in document["messages"])


def test_the_course_ends_at_the_balance(written):
    """From 20 C at 6000 r/min to the balance there, after five time constants within 1 % of the rise."""
    document, _ = written
    course = document["warm_up"]["course"]
    assert course[0]["time_s"] == 0.0
    assert all(course[0][f"{node}_temperature_C"] == pytest.approx(20.0) for node in NODES)
    (own,) = (row for row in document["balances"] if row["speed_rpm"] == pytest.approx(6000.0))
    for key in (*(f"{node}_temperature_C" for node in NODES), "film_temperature_C"):
        assert course[-1][key] == pytest.approx(own[key], abs=0.01 * (own[key] - 20.0) + 0.05)
    assert course[0]["power_W"] > course[-1]["power_W"]  # of thicker oil
    assert course[-1]["time_s"] == pytest.approx(5.0 * document["thermal_time_constant_s"])


def test_files(written):
    """Tables, picture, data set in SI, all of the same numbers."""
    document, folder = written
    out = folder / "out"
    names = {path.name for path in out.iterdir()}
    assert {"balances.csv", "warm_up.csv", "temperatures.png", "results.nc", "summary.json"} <= names
    assert json.loads((out / "summary.json").read_text())["balances"] == document["balances"]
    with postprocess.open_results(out) as results:
        assert results.attrs["kind"] == "temperatures"
        course = results["course"].values - 273.15
        last = document["warm_up"]["course"][-1]
        assert course[-1] == pytest.approx([last[f"{node}_temperature_C"] for node in NODES])


def test_the_table_and_a_time_of_ones_own(written):
    """A short course by --hours, told in the terminal."""
    _, folder = written
    answer = oilfilm("temperatures", str(folder / "case.toml"), "--hours", "0.01", "-o", str(folder / "short"))
    assert answer.exit_code == 0
    assert "limiting speed by heat" in answer.stdout
    course = json.loads((folder / "short" / "summary.json").read_text())["warm_up"]["course"]
    assert course[-1]["time_s"] == pytest.approx(36.0)


@pytest.mark.parametrize(
    ("old", "new", "wanted"),
    [
        ("heat_transfer_W_K = 2.0", "", "friction.heat_transfer_W_K"),
        ("inner_speed_rpm = 6000.0", "inner_speed_rpm = 0.0", "a ring that turns"),
        ("[friction]\n", "[contact]\nload_N = 1.0\n[friction]\n", "contact"),
    ],
)
def test_what_has_no_temperatures_is_told(tmp_path, old, new, wanted):
    (tmp_path / "case.toml").write_text(CASE.replace(old, new))
    answer = oilfilm("temperatures", str(tmp_path / "case.toml"), "-o", str(tmp_path / "out"), "-q")
    assert answer.exit_code == 2
    assert wanted in answer.output
    assert not (tmp_path / "out").exists()


def test_a_ring_without_equilibrium_is_told(tmp_path):
    """Balls that climb out of their grooves, as lightly loaded ones of steep angles at high speed."""
    unloaded = CASE.replace('"6208"', '"7208B"').replace("2000.0", "282.0\naxial_load_N = 282.0")
    (tmp_path / "case.toml").write_text(unloaded.replace("6000.0", "12617.0").replace("bore_mm = 40.0\n", ""))
    answer = oilfilm("temperatures", str(tmp_path / "case.toml"), "-q")
    assert answer.exit_code == 2
    assert "no temperatures: no equilibrium: a contact angle passes 80 degrees" in answer.output


@pytest.mark.slow
def test_a_new_case_of_a_greased_bearing_has_temperatures(tmp_path, monkeypatch):
    """A light load at 6000 r/min: the films leave a little of the balance, beside which the branch begins."""
    monkeypatch.chdir(tmp_path)
    loads = ("--speed", "6000", "--radial", "800", "--axial", "150")
    assert oilfilm("init", "light", "--bearing", "6306-2Z/C3", *loads).exit_code == 0
    answer = oilfilm("temperatures", "light.toml", "--json", "-q")
    assert answer.exit_code == 0, answer.output
    document = json.loads(answer.stdout)
    assert document["limiting_speed_rpm"] > 12000.0
    assert min(abs(row["speed_rpm"] / 6000.0 - 1.0) for row in document["balances"]) < 0.05


def test_every_number_is_kept(written):
    document, folder = written
    kept("temperatures", {"summary": document, "files": folder / "out", **SHOWN}, 1e-5)
