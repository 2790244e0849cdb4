"""Traction tables of another oil or bearing are refused by every command that takes them, before anything is run."""

from __future__ import annotations

from math import cos, radians

import pytest
from typer.testing import CliRunner

from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.dynamics.statistics import table_limits
from oilfilm.bearing.friction.friction_sources import LawTraction
from oilfilm.bearing.friction.tables import save_race_tables, save_temperature_tables
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.material import load_material
from oilfilm.cases.batch.shared_tables import tables_once
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shipped import find_case
from oilfilm.cases.format.traction import read_race_tables, resisted_traction
from oilfilm.cases.runs.equilibrium import case_equilibrium, traction_messages
from oilfilm.cases.runs.motion_model import build_model
from oilfilm.ehl.messages import OUTSIDE_TABLE
from oilfilm.ehl.traction_table.temperature import TemperatureTable
from oilfilm.postprocess.quantities import is_warning

from ..made_up_tables import made_up_tables

SWEEP = 'case = "case.toml"\ncompute = "{}"\ntable = "made.zip"\n[sweep]\n"operation.axial_load_N" = [100.0, 150.0]\n'
FOREIGN = {
    "oil": ("viscosity_mPa_s = 20.0", "viscosity_mPa_s = 20.1"),
    "shear law": ("[operation]", 'rheology = "newtonian"\n\n[operation]'),
    "moduli": ('ball_material = "bearing steel"', 'ball_material = "silicon nitride"'),
    "groove": ("inner_groove_radius_mm = 3.99", "inner_groove_radius_mm = 3.98"),
    "rolling radius": ("pitch_diameter_mm = 54.0", "pitch_diameter_mm = 150.0"),
}


def text_of(old="", new=""):
    """The shipped 7008 under axial load, its friction from tables, with a change."""
    text = find_case("7008_axial").read_text(encoding="utf-8")
    before, _, after = text.partition("[friction]\n")  # its four constants
    text = before + after[after.index("[dynamics]\n") :]
    text = text.replace("[dynamics]\n", '[dynamics]\nfriction = "table"\n')
    assert old in text
    return text.replace(old, new)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tables")
    save_race_tables(made_up_tables(case_from_text(text_of(), "case.toml")), folder / "made.zip")
    return folder


def file_of(folder, text):
    path = folder / "case.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_tables_of_the_case_itself_are_taken(folder, tmp_path):
    """By the simulation, for another load and clearance, and by a batch."""
    text = text_of("axial_load_N = 100.0", "axial_load_N = 150.0").replace("angle_deg = 15.0", "angle_deg = 16.0")
    case = case_from_text(text, "case.toml")
    model = build_model(case, folder / "made.zip", lambda done, total, state: None)
    assert model.friction.inner.message == "made up"
    file_of(tmp_path, text)
    (tmp_path / "made.zip").write_bytes((folder / "made.zip").read_bytes())
    for compute in ("dynamics", "torque"):
        points = sweep_from_text(SWEEP.format(compute), "sweep.toml", tmp_path).points
        assert len({point.tables for point in points}) == 1


def test_tables_count_where_balls_roll_on_about_their_radius(folder):
    """A free angle of 60 degrees: taken, and contacts at that angle are counted as beyond the table."""
    case = case_from_text(text_of("angle_deg = 15.0", "angle_deg = 60.0"), "case.toml")
    friction = build_model(case, folder / "made.zip", lambda done, total, state: None).friction
    for race, law in ((Race.INNER, friction.inner), (Race.OUTER, friction.outer)):
        least, most = table_limits(law, case.bearing, race)[:, 2]
        assert least < cos(radians(15.0)) < most
        assert cos(radians(60.0)) < least


def test_a_run_tells_contacts_at_other_rolling_radii(folder):
    case = case_from_text(text_of("angle_deg = 15.0", "angle_deg = 60.0"), "case.toml")
    tables = read_race_tables(folder / "made.zip", case.bearing, case.lubricant, case.rheology)
    source = LawTraction(laws=dict(tables))
    traction = resisted_traction(source, case.friction, case.bearing, case.lubricant, 500.0, case.inlet)
    state = case_equilibrium(case)
    _, message = traction_messages(traction, state, contact_conditions(state, case.lubricant))
    assert message.startswith(OUTSIDE_TABLE) and "rolling radius" in message
    assert is_warning(message)


@pytest.mark.parametrize(("what", "change"), FOREIGN.items(), ids=FOREIGN)
def test_a_simulation_refuses_foreign_tables(folder, tmp_path, what, change):
    case = file_of(tmp_path, text_of(*change))
    arguments = ("dynamics", str(case), "--table", str(folder / "made.zip"), "-o", str(tmp_path / "out"))
    found = CliRunner().invoke(app, arguments)
    assert found.exit_code == 2, found.output
    assert f"made.zip is for another bearing or oil (inner race: {what}" in found.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("compute", ["dynamics", "torque"])
@pytest.mark.parametrize(("what", "change"), FOREIGN.items(), ids=FOREIGN)
def test_a_batch_refuses_foreign_tables(folder, tmp_path, what, change, compute):
    """With the line of the sweep, before a point is run."""
    file_of(tmp_path, text_of(*change))
    (tmp_path / "made.zip").write_bytes((folder / "made.zip").read_bytes())
    sweep = tmp_path / "sweep.toml"
    sweep.write_text(SWEEP.format(compute), encoding="utf-8")
    found = CliRunner().invoke(app, ["batch", str(sweep), "-o", str(tmp_path / "out")])
    assert found.exit_code == 2, found.output
    assert f"sweep.toml:3: table: made.zip is for another bearing or oil (inner race: {what}" in found.stderr
    assert "point 1 and 1 others" in found.stderr
    assert not (tmp_path / "out").exists()


def test_a_batch_names_the_points_of_another_oil(folder, tmp_path):
    file_of(tmp_path, text_of())
    (tmp_path / "made.zip").write_bytes((folder / "made.zip").read_bytes())
    text = SWEEP.format("torque") + '"lubricant.viscosity_mPa_s" = [20.0, 30.0]\n'
    with pytest.raises(CaseError, match=r"\(inner race: oil\): point 2 and 1 others"):
        sweep_from_text(text, "sweep.toml", tmp_path)


def test_tables_that_a_simulation_has_no_use_for(folder, tmp_path):
    case = file_of(tmp_path, text_of().replace('friction = "table"', 'friction = "coulomb"'))
    found = CliRunner().invoke(app, ["dynamics", str(case), "--table", str(folder / "made.zip"), "--json"])
    assert found.exit_code == 2
    assert 'dynamics.friction = "table"' in found.stderr
    missing = CliRunner().invoke(app, ["dynamics", str(file_of(tmp_path, text_of())), "--table", "no.zip", "--json"])
    assert missing.exit_code == 2
    assert "no.zip cannot be read" in missing.stderr


def test_tables_with_heat_are_of_the_bodies_of_a_case_with_heat(tmp_path):
    """Another conductivity is another table; a case without heat takes the tables it is given."""
    steel = load_material("bearing steel")
    own = f"""
[materials."bearing steel"]
youngs_modulus_GPa = {1e-9 * steel.youngs_modulus!r}
poisson_ratio = {steel.poisson_ratio!r}
density_kg_m3 = {steel.density!r}
thermal_conductivity_W_m_K = 20.0
"""
    cold = text_of(
        "viscosity_mPa_s = 20.0\npressure_viscosity_1_GPa = 18.0\ndensity_kg_m3 = 870.0", 'name = "iso vg 32"'
    )
    cold = cold[cold.index("[bearing]") :]
    heat = "schema_version = 1\n" + cold.replace("[ehl]\n", '[ehl]\nfilm_model = "thermal"\n')
    save_race_tables(made_up_tables(case_from_text(heat, "case.toml")), tmp_path / "made.zip")
    named = f'[friction]\ntraction = "table"\ntraction_table = "{tmp_path / "made.zip"}"\n'
    for text in (heat, "schema_version = 1\n" + cold):
        case_from_text(text + named, "case.toml")
    with pytest.raises(CaseError, match=r"inner race: thermal properties"):
        case_from_text(heat + named + own, "case.toml")


@pytest.fixture(scope="module")
def over_temperature(tmp_path_factory):
    """Tables at three temperatures of an oil of the library, whose Eyring stress is assumed and goes with 1/alpha."""
    tables = [made_up_tables(case_from_text(warm_text(celsius), "case.toml")) for celsius in (30.0, 50.0, 70.0)]
    found = {race: TemperatureTable(tables=tuple(one[race] for one in tables)) for race in Race}
    path = tmp_path_factory.mktemp("warm") / "made.zip"
    save_temperature_tables(found, path)
    return path


def warm_text(celsius, oil="iso vg 32"):
    old = "viscosity_mPa_s = 20.0\npressure_viscosity_1_GPa = 18.0\ndensity_kg_m3 = 870.0"
    text = text_of(old, f'name = "{oil}"').replace("[operation]\n", f"[operation]\ntemperature_C = {celsius}\n")
    return f"schema_version = 1\n[bearing]{text.partition('[bearing]')[2]}"


def test_tables_over_the_temperature_are_taken_at_that_of_the_case(over_temperature, tmp_path):
    """By run, the simulation and a batch over temperatures, at and between those of the tables."""
    for celsius in (50.0, 57.0):
        case = case_from_text(warm_text(celsius), "case.toml")
        model = build_model(case, over_temperature, lambda done, total, state: None)
        assert model.friction.outer.contact.temperature == celsius + 273.15
        assert model.friction.outer.contact.rheology == case.rheology
        named = f'[friction]\ntraction = "table"\ntraction_table = "{over_temperature}"\n'
        laws = case_from_text(warm_text(celsius) + named, "case.toml").traction.source.laws
        assert laws[Race.INNER].contact == model.friction.inner.contact
    file_of(tmp_path, warm_text(40.0))
    (tmp_path / "made.zip").write_bytes(over_temperature.read_bytes())
    sweep = 'case = "case.toml"\ncompute = "{}"\ntable = "made.zip"\n[sweep]\n"operation.temperature_C" = [{}]\n'
    for compute in ("dynamics", "torque"):
        points = sweep_from_text(sweep.format(compute, "35.0, 50.0, 65.0"), "sweep.toml", tmp_path).points
        assert len({point.tables for point in points}) == 1
        with pytest.raises(CaseError, match=r"made.zip: temperature must lie within .*: point 2;"):
            sweep_from_text(sweep.format(compute, "35.0, 80.0"), "sweep.toml", tmp_path)
    case = case_from_text(warm_text(57.0), "case.toml")
    tables = tables_once(str(over_temperature))(case.lubricant)
    assert tables[Race.OUTER].contact.lubricant == case.lubricant


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (("iso vg 32", "iso vg 68"), "another oil"),
        (("[operation]", "eyring_stress_MPa = 9.0\n[operation]"), "shear law"),
        (("inner_groove_radius_mm = 3.99", "inner_groove_radius_mm = 3.98"), "groove"),
    ],
)
def test_foreign_tables_over_the_temperature_are_refused(over_temperature, tmp_path, change, told):
    case = file_of(tmp_path, warm_text(57.0).replace(*change))
    found = CliRunner().invoke(app, ["dynamics", str(case), "--table", str(over_temperature), "--json"])
    assert found.exit_code == 2, found.output
    assert "made.zip" in found.stderr
    assert told in found.stderr
