"""Sweeps of a bearing as `oilfilm init` writes it: clearance, class, fit and temperature in place of the case's."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from oilfilm.cases import load_case
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.rules import CaseError

FIT = '\n[fit]\nshaft_tolerance = "k5"\nhousing_tolerance = "H7"\nhousing_outside_diameter_mm = 90.0\n'


@pytest.fixture(autouse=True)
def own_cases(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, bearing in (("groove", "6206"), ("angular", "7014C"), ("sized", None)):
        size = ["--bore", "60", "--outside", "95", "--width", "18", "--angle", "25"]
        words = ["--bearing", bearing] if bearing else size
        assert CliRunner().invoke(app, ["init", name, *words]).exit_code == 0


def swept(case, **keys):
    lines = (f'"{key.replace("__", ".")}" = {values!r}\n' for key, values in keys.items())
    return sweep_from_text(f'case = "{case}"\n[sweep]\n{"".join(lines)}', "sweep.toml")


def test_a_clearance_takes_the_place_of_the_class_and_is_told():
    sweep = swept("groove", bearing__diametral_clearance_um=[0.0, 33.0])
    told = "bearing.clearance_class of the case is left out, the points give diametral_clearance_um"
    assert sweep.messages == (told,)
    bearings = [point.resolved["bearing"] for point in sweep.points]
    assert [bearing["diametral_clearance_um"] for bearing in bearings] == [0.0, 33.0]
    assert not any("clearance_class" in bearing for bearing in bearings)
    assert {point.resolved["operation"]["temperature"] for point in sweep.points} == {"self-heated"}


def test_a_class_takes_the_place_of_the_clearance():
    sweep = swept("groove", bearing__clearance_class=["C2", "C3"])
    assert not any("diametral_clearance_um" in point.document["bearing"] for point in sweep.points)


@pytest.mark.parametrize(("case", "angle"), [("angular", 15.0), ("sized", 25.0)])
def test_a_clearance_of_an_angular_contact_bearing_leaves_its_nominal_angle(case, angle):
    sweep = swept(case, bearing__diametral_clearance_um=[10.0, 30.0])
    for point in sweep.points:
        assert "free_contact_angle_deg" not in point.resolved["bearing"]
        assert point.resolved["bearing"]["nominal_contact_angle_deg"] == angle


def test_an_interference_takes_the_place_of_a_tolerance_also_where_it_is_zero(tmp_path):
    with (tmp_path / "groove.toml").open("a") as file:
        file.write(FIT)
    sweep = swept("groove", fit__inner_ring_interference_um=[0.0, 10.0])
    assert [point.document["fit"] for point in sweep.points] == [
        {"housing_tolerance": "H7", "housing_outside_diameter_mm": 90.0, "inner_ring_interference_um": value}
        for value in (0.0, 10.0)
    ]


def test_a_temperature_ends_self_heating_but_for_sensitivities():
    given = swept("groove", operation__temperature_C=[40.0, 80.0])
    assert {point.resolved["operation"]["temperature"] for point in given.points} == {"given"}
    both = swept("groove", operation__temperature_C=[40.0], operation__temperature=["self-heated"])
    assert both.points[0].resolved["operation"]["temperature"] == "self-heated"
    text = 'case = "groove"\n[sensitivity]\nkeys = ["operation.temperature_C"]\nstep = 0.02\n'
    near = sweep_from_text(text, "sweep.toml")
    assert {point.resolved["operation"]["temperature"] for point in near.points} == {"self-heated"}


def test_a_load_does_not_take_the_place_of_another(tmp_path):
    path = tmp_path / "groove.toml"
    text = path.read_text().replace("radial_load_N = 980.0", "force_N = [100.0, 980.0, 0.0]")
    path.write_text(text.replace("axial_load_N = 0.0\n", ""))
    assert "force_N" in path.read_text()
    with pytest.raises(CaseError, match="force_N"):
        swept("groove", operation__radial_load_N=[500.0])


def test_a_clearance_in_a_case_leaves_the_nominal_angle_of_the_catalogue(tmp_path):
    (tmp_path / "mine.toml").write_text(
        'schema_version = 1\n[bearing]\nname = "7014C"\ndiametral_clearance_um = 30.0\n'
        '[lubricant]\nname = "iso vg 32"\n[operation]\naxial_load_N = 500.0\n'
    )
    rating = load_case("mine").rating
    assert rating is not None
    assert rating.nominal_contact_angle == pytest.approx(0.2617993878)
