"""Drives in REXS: a gearbox of three stages (FVA, Apache-2, beside its licence), faults in files."""

from __future__ import annotations

import json
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm.bearing.shaft.equilibrium import solve_shaft
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shaft_case import load_shaft
from oilfilm.cases.rexs import bearing_text, bearings, drive, gear_load, is_ball_bearing, read_rexs, shaft_text
from oilfilm.cases.rexs_results import ATTRIBUTES

GEARBOX = Path(__file__).parents[1] / "data" / "rexs" / "SEW_3-stage_cylindrical_gearbox_1.0.rexs"


@pytest.fixture(scope="module")
def found():
    return drive(read_rexs(GEARBOX))


USED = {
    "shaft": {"rotational_speed"},
    "shaft_section": {"u_coordinate_on_shaft", "length", "outer_diameter_begin"},
    "cylindrical_gear": {"number_of_teeth", "support_vector", "helix_angle_reference_diameter", "face_width"},
    "external_load": {"torque_around_u_axis"},
}


def as_json(model):
    """The model in REXS' JSON."""
    components = [
        {
            "id": c.id,
            "type": c.type,
            "name": c.name,
            "attributes": [{"id": key, "unit": unit, "string": value} for key, (value, unit) in c.attributes.items()],
        }
        for c in model.components.values()
    ]
    relations = [
        {"type": kind, "refs": [{"role": role, "id": number} for role, number in roles.items()]}
        for kind, roles in model.relations
    ]
    return json.dumps({"model": {"version": model.version, "components": components, "relations": relations}})


def test_all_bearings_are_listed_with_their_shafts(found):
    listed = bearings(found.model)
    assert [is_ball_bearing(bearing) for bearing, _ in listed].count(True) == 8
    assert [shaft.id for _, shaft in listed] == ["4", "4", "5", "5", "36", "36", "36", "54", "54"]


def test_speeds_and_torques_follow_the_teeth(found):
    ratio = 67 / 23 * 76 / 13 * 87 / 14
    assert found.speeds["54"] == pytest.approx(-1400.0 / ratio, rel=1e-12)
    torque = -gear_load(found.stages[-1][1], found.tangential[-1])[1][0]
    assert torque == pytest.approx(4724.562306435156 * ratio, rel=1e-9)  # 500 N m at the output


def test_forces_of_a_mesh_are_equal_and_opposite(found):
    for (one, other), tangential in zip(found.stages, found.tangential, strict=True):
        assert gear_load(one, tangential)[0] == pytest.approx(-gear_load(other, tangential)[0], rel=1e-9)


def test_the_first_pinion_is_pressed_against_its_turn(found):
    pinion = found.stages[0][0]
    force, _ = gear_load(pinion, found.tangential[0])
    turning = np.cross([np.sign(found.speeds["4"]), 0.0, 0.0], pinion.towards)
    assert force @ turning < 0.0  # a driver is held back
    assert force @ pinion.towards < 0.0  # and pushed off its mate


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_shafts_with_ball_bearings_have_an_equilibrium(found, number, tmp_path):
    path = tmp_path / "shaft.toml"
    path.write_text(shaft_text(found, number), encoding="utf-8")
    solution = solve_shaft(load_shaft(path).system)
    assert solution.converged, solution.message


def test_the_output_shaft_has_the_reactions_of_the_hand_calculation(found, tmp_path):
    """500 N m at the pitch circle of 87 teeth; the 6207 by the lever about the 6308 (docs/user/shaft.md)."""
    path = tmp_path / "shaft.toml"
    path.write_text(shaft_text(found, 4), encoding="utf-8")
    solution = solve_shaft(load_shaft(path).system)
    tangential = 500.0 / (0.077 * 87 / 101)
    axial = tangential * np.tan(np.radians(10.0))
    across = tangential * np.hypot(1.0, np.tan(np.radians(20.0)) / np.cos(np.radians(10.0)))
    reaction = solution.reactions
    assert reaction[:, 0] == pytest.approx([0.0, -axial], abs=1e-3)
    assert np.hypot(*reaction[:, 1:3].sum(axis=0)) == pytest.approx(across, rel=3e-3)  # and 20 N of weight
    load = solution.system.loads[0]
    moments = load.moment[1] - reaction[1, 3] - reaction[0, 3]
    assert reaction[0, 2] == pytest.approx((load.force[2] * (0.1195 - 0.0443) + moments) / 0.1027, rel=1e-6)


def test_a_bearing_has_the_load_that_its_shaft_puts_on_it(found):
    text = bearing_text(found, 3)
    assert 'name = "6202"' in text
    assert "force_N = [" in text


def test_a_roller_bearing_is_a_spring_and_told(found, tmp_path):
    """NUP 204: Palmgren's line contacts by hand under 3250 N, 11 rollers of 7.4 x 9.1 mm."""
    text = shaft_text(found, 3)
    assert "[[spring]]  # radial roller bearing, not computed" in text
    assert "an estimate, to a factor of 1.5" in text
    path = tmp_path / "shaft.toml"
    path.write_text(text, encoding="utf-8")
    system = load_shaft(path).system
    by_hand = 3250.0 / (0.9 * 7.68e-5 * (4.08 * 3250.0 / 11) ** 0.9 / 9.1**0.8) * 1e3
    assert [spring.radial_stiffness for spring in system.springs] == pytest.approx([by_hand], rel=5e-3)
    solution = solve_shaft(system)
    assert solution.converged, solution.message
    # bearings and spring together hold the loads
    load = system.load_vector(system.beam()).reshape(-1, 6)[:, :3].sum(axis=0)
    held = solution.reactions[:, :3].sum(axis=0) + solution.spring_loads[:, :3].sum(axis=0)
    assert held == pytest.approx(load, rel=1e-6, abs=1e-3)
    with pytest.raises(CaseError, match="no ball bearing"):
        bearing_text(found, 6)


@pytest.mark.parametrize(("stiffness", "text"), [("0.0", None), ("2.0e8", "axial_stiffness_N_um = 200")])
def test_a_roller_bearing_that_holds_the_shaft_along_its_axis_needs_a_stiffness(found, stiffness, text):
    bearing = found.model.components["50"]
    changes = {"axial_force_absorption": ("both_directions", ""), "axial_stiffness": (stiffness, "N / m")}
    changed = replace(bearing, attributes=bearing.attributes | changes)
    model = replace(found.model, components=found.model.components | {"50": changed})
    other = replace(found, model=model)
    if text:
        assert text in shaft_text(other, 3)
        return
    with pytest.raises(CaseError, match="axial_stiffness is needed"):
        shaft_text(other, 3)


def test_json_and_zip_hold_the_same_model(found, tmp_path):
    text = as_json(found.model)
    (tmp_path / "drive.json").write_text(text, encoding="utf-8")
    with zipfile.ZipFile(tmp_path / "drive.rexsz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("drive.rexs", GEARBOX.read_bytes())
    for name in ("drive.json", "drive.rexsz"):
        same = shaft_text(drive(read_rexs(tmp_path / name)), 2).replace(str(tmp_path / name), str(GEARBOX))
        assert same == shaft_text(found, 2)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b'<?xml version="1.0"?><!DOCTYPE m [<!ENTITY a "b">]><model>&a;</model>', "document type"),
        (b"<model><components>", "not valid XML"),
        (b"<drive/>", "not a REXS model"),
        (b'{"model": []}', "not a REXS model in JSON"),
        (b"<model><components/></model>", "a REXS model without components"),
        (b'{"model": {"components": [], "relations": []}}', "a REXS model without components"),
        (b'<model><component id="1" type="shaft"/></model>', "rotational_speed"),
        (b'<model><component id="1"/><relation><ref role="part" id="7"/></relation></model>', "component 7, which"),
    ],
)
def test_a_file_that_is_no_model_is_told_in_one_line(content, message, tmp_path):
    path = tmp_path / "drive.rexs"
    path.write_bytes(content)
    answer = CliRunner().invoke(app, ["import", str(path), "--shaft", "1", "-o", str(tmp_path / "out.toml")])
    assert answer.exit_code == 2
    assert message in answer.stderr
    assert answer.stderr.count("\n") == 1
    assert not (tmp_path / "out.toml").exists()


def test_a_model_without_components_is_not_listed(tmp_path):
    path = tmp_path / "drive.rexs"
    path.write_bytes(b"<model><components/></model>")
    answer = CliRunner().invoke(app, ["import", str(path)])
    assert (answer.exit_code, answer.stdout) == (2, "")


@pytest.mark.parametrize(
    "junk", [None, [], {}, "x", "nan", "1e999", 10**400, [1, 2], [None] * 3, "a\nb = 1\r[operation]"]
)
def test_junk_in_any_attribute_is_told_with_its_place(found, junk, tmp_path):
    """One attribute of each name and type of component: a case all the same, or a message that names it."""
    path = tmp_path / "drive.json"
    model = json.loads(as_json(found.model))
    kinds = {(c["type"], a["id"]): (k, n) for k, c in enumerate(model["model"]["components"])
             for n, a in enumerate(c["attributes"])}  # fmt: skip
    used = [(key, place) for key, place in kinds.items() if key[0] in USED and key[1] in USED[key[0]]]
    assert len(used) == sum(map(len, USED.values()))
    for (_, name), (k, n) in used:
        changed = json.loads(json.dumps(model))
        changed["model"]["components"][k]["attributes"][n]["string"] = junk
        path.write_text(json.dumps(changed), encoding="utf-8")
        try:
            text = shaft_text(drive(read_rexs(path)), 2)
        except CaseError as error:
            assert any(word in str(error) for word in (name, "rotational_speed", "torques of the gears"))
        else:
            assert "\r" not in text and "\nb = 1" not in text


OIL = b"""<component id="99" name="gear oil" type="lubricant">
      <attribute id="viscosity_at_40_degree_celsius" unit="mm^2 / s">220.0</attribute>
      <attribute id="viscosity_at_100_degree_celsius" unit="mm^2 / s">19.0</attribute>
      <attribute id="density_at_15_degree_celsius" unit="kg / dm^3">0.89</attribute>
    </component>
    """


def test_the_oil_of_the_model_is_that_of_the_case(tmp_path):
    first = GEARBOX.read_bytes().index(b"<component ")
    data = GEARBOX.read_bytes()
    (tmp_path / "oil.rexs").write_bytes(data[:first] + OIL + data[first:])
    (tmp_path / "shaft.toml").write_text(shaft_text(drive(read_rexs(tmp_path / "oil.rexs")), 1), encoding="utf-8")
    assert "lubricant.name" not in (tmp_path / "shaft.toml").read_text(encoding="utf-8")
    document = load_shaft(tmp_path / "shaft.toml").documents[0]["lubricant"]
    expected = {
        "kinematic_viscosity_40C_mm2_s": 220.0,
        "kinematic_viscosity_100C_mm2_s": 19.0,
        "density_15C_kg_m3": 890.0,
    }
    assert {key: document.get(key) for key in expected} == pytest.approx(expected)


def result_folder(folder, source, converged=(True, True)):
    """Results of a shaft with two bearings, as much of them as the drive takes."""
    bearings = [
        {
            "converged": good,
            "ring": {"force_N": [10.0, -200.0 * k, 30.0], "stiffness": {"matrix": (np.eye(5) * 1e6).tolist()}},
            "life": {"basic_reference_rating_Mrev": 3.5, "modified_reference_rating_h": None},
            "torque_N_mm": {"total": 42.0},
        }
        for k, good in enumerate(converged, 1)
    ]
    document = {"oilfilm": "0", "case": {"source": source}, "converged": True, "messages": [], "bearings": bearings}
    folder.mkdir(exist_ok=True)
    (folder / "summary.json").write_text(json.dumps(document), encoding="utf-8")
    return folder


def exported(folder, output, *options):
    return CliRunner().invoke(app, ["export", str(folder), "--format", "rexs", "-o", str(output), *options])


def test_results_are_written_into_the_model_and_nothing_else_changes(found, tmp_path):
    source = shaft_text(found, 1).split('source = "')[1].split('"')[0]
    answer = exported(result_folder(tmp_path / "r", source), tmp_path / "out.rexs")
    assert answer.exit_code == 0, answer.stderr
    before, after = GEARBOX.read_bytes().splitlines(), (tmp_path / "out.rexs").read_bytes().splitlines()
    names = {entry[1] for names in ATTRIBUTES.values() for entry in names}
    added = [line for line in after if line not in before]
    assert [line for line in after if line in before or line not in added] == before
    assert all(line.decode().split('id="')[1].split('"')[0] in names for line in added)
    model = read_rexs(tmp_path / "out.rexs")
    assert model.relations == found.model.relations
    first, second = (model.components[number] for number in ("20", "21"))
    assert second.attributes["radial_force_in_v"] == ("-0.4", "kN")
    assert first.attributes["nominal_reference_rating_life_rotations_din_26281"] == ("3500000.0", "none")
    assert first.attributes["total_frictional_torque"] == ("0.042", "N m")
    assert first.attributes["operating_point_stiffness_dM_w_d_w_rot"] == ("1000000000.0", "N mm / rad")


def test_a_shaft_of_ball_and_roller_bearings_takes_results_of_both(found, tmp_path):
    """Loads of the roller bearing, which is a spring; nothing else of the model changes."""
    source = shaft_text(found, 3).split('source = "')[1].split('"')[0]
    folder = result_folder(tmp_path / "r", source)
    document = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    document["springs"] = [{"name": "NUP", "force_N": [0.0, 735.0, 5884.0], "moment_N_mm": [0.0, 1.0, 2.0]}]
    (folder / "summary.json").write_text(json.dumps(document), encoding="utf-8")
    answer = exported(folder, tmp_path / "out.rexs")
    assert "results of 3 bearings written" in answer.stderr
    before, after = GEARBOX.read_bytes().splitlines(), (tmp_path / "out.rexs").read_bytes().splitlines()
    assert [line for line in after if line in before] == before
    model = read_rexs(tmp_path / "out.rexs")
    changed = {n for n, one in model.components.items() if one != found.model.components[n]}
    assert len(changed) == 3
    roller = next(model.components[n] for n in changed if not is_ball_bearing(model.components[n]))
    assert roller.attributes["radial_force_in_w"] == ("5.884", "kN")
    assert roller.attributes["torque_around_the_w_axis"] == ("0.002", "N m")


def test_results_that_are_there_are_replaced(found, tmp_path):
    source = shaft_text(found, 1).split('source = "')[1].split('"')[0]
    folder = result_folder(tmp_path / "r", source)
    assert exported(folder, tmp_path / "one.rexs").exit_code == 0
    assert exported(folder, tmp_path / "two.rexs", "--model", str(tmp_path / "one.rexs")).exit_code == 0
    assert (tmp_path / "one.rexs").read_bytes() == (tmp_path / "two.rexs").read_bytes()


def test_names_and_units_are_those_of_the_version(tmp_path):
    later = GEARBOX.read_bytes().replace(b'version="1.0"', b'version="2.0.0"')
    (tmp_path / "late.rexs").write_bytes(later)
    folder = result_folder(tmp_path / "r", f"{tmp_path / 'late.rexs'}: REXS 2.0.0, shaft 4")
    assert exported(folder, tmp_path / "out.rexs").exit_code == 0
    own = read_rexs(tmp_path / "out.rexs").components["20"].attributes
    assert own["nominal_reference_rating_life_rotations_iso_16281_2008"] == ("3.5", "MRev")
    assert own["operating_point_stiffness_m_w_rot_w"] == ("1000000000.0", "N mm / rad")


def test_json_and_zip_take_results(found, tmp_path):
    (tmp_path / "drive.json").write_text(as_json(found.model), encoding="utf-8")
    with zipfile.ZipFile(tmp_path / "drive.rexsz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("drive.rexs", GEARBOX.read_bytes())
        archive.writestr("notes.txt", b"kept")
    for name in ("drive.json", "drive.rexsz"):
        folder = result_folder(tmp_path / "r", f"{tmp_path / name}: REXS 1.0, shaft 4")
        assert exported(folder, tmp_path / "out.rexs").exit_code == 0
        assert (
            float(read_rexs(tmp_path / "out.rexs").components["20"].attributes["total_frictional_torque"][0]) == 0.042
        )
    with zipfile.ZipFile(tmp_path / "out.rexs") as archive:
        assert archive.read("notes.txt") == b"kept"


def test_only_converged_bearings_are_written(tmp_path):
    folder = result_folder(tmp_path / "r", f"{GEARBOX}: REXS 1.0, shaft 4", converged=(False, True))
    answer = exported(folder, tmp_path / "out.rexs")
    assert "results of 1 bearing written" in answer.stderr
    assert "total_frictional_torque" not in read_rexs(tmp_path / "out.rexs").components["20"].attributes


@pytest.mark.parametrize(
    ("source", "converged", "message"),
    [
        ("a handbook", (True, True), "source names no model"),
        ("nowhere.rexs: REXS 1.0, shaft 4", (True, True), "name it by --model"),
        (f"{GEARBOX}: REXS 1.0, shaft 36", (True, True, True), "has 2 bearings, the results 3"),
        (f"{GEARBOX}: REXS 1.0, shaft 4", (False, False), "no bearing converged"),
    ],
)
def test_results_without_a_place_are_told(source, converged, message, tmp_path):
    answer = exported(result_folder(tmp_path / "r", source, converged), tmp_path / "out.rexs")
    assert answer.exit_code == 2
    assert message in answer.stderr
    assert not (tmp_path / "out.rexs").exists()
