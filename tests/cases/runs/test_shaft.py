"""`oilfilm shaft`: the shipped shaft, its bearings, and faults told at their lines."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import pyvista as pv
from typer.testing import CliRunner

import oilfilm
from oilfilm.bearing.heating.network import NODES
from oilfilm.bearing.shaft.equilibrium import solve_shaft
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shaft_case import load_shaft
from oilfilm.cases.format.shipped import shipped_cases
from oilfilm.cases.runs.heating import self_heated
from oilfilm.cases.runs.shaft import balance_of_heat, run_shaft
from oilfilm.postprocess.batch.results import main_results, result_names, scalar_numbers
from oilfilm.postprocess.report.page import report_page
from oilfilm.postprocess.scene.scene import check_scene
from oilfilm.postprocess.scene.vtk import write_shaft_collection
from oilfilm.postprocess.shaft.results import shaft_summary
from oilfilm.postprocess.shaft.ross import ross_rotor
from oilfilm.postprocess.shaft.write import write_shaft

from ...kept import drawn, kept

TEXT = shipped_cases()["spindle_two_bearings"].read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def results():
    return run_shaft(load_shaft("spindle_two_bearings"))


def test_the_summary_has_shaft_bearings_and_critical_speeds(results):
    document = json.loads(json.dumps(shaft_summary(results), allow_nan=False))
    assert document["converged"], document["messages"]
    assert [support["bearing"] for support in document["supports"]] == ["6207 CN", "6206 CN"]
    assert document["supports"][0]["force_N"][1] == pytest.approx(-1143.0, abs=1.0)
    assert len(document["shaft"]["x_mm"]) == len(document["shaft"]["deflection_um"])
    assert document["critical_speeds_rpm"] == sorted(document["critical_speeds_rpm"])
    lives = [bearing["life"]["basic_reference_rating_h"] for bearing in document["bearings"]]
    assert 0.5 * min(lives) < document["system"]["basic_reference_rating_h"] < min(lives)


def test_each_bearing_has_the_loads_that_the_shaft_puts_on_it(results):
    for state, bearing in zip(results.solution.bearings, results.bearings, strict=True):
        assert bearing.elastic.inner_load == pytest.approx(state.inner_load, rel=1e-6, abs=1e-6)
        assert bearing.quasistatic.ring_force[1:] == pytest.approx(state.ring_force[1:], rel=1e-6, abs=1e-3)
        assert bearing.torque.total > 0.0


def test_files_and_pictures_are_written(results, tmp_path):
    assert write_shaft(results, tmp_path, write_shaft_collection) == ()
    names = {path.name for path in tmp_path.iterdir()}
    tables = {"summary.json", "shaft.csv", "campbell.csv", "results.nc", "shaft.png", "campbell.png"}
    assert names == tables | {"fields.pvd", "vtk"}
    with oilfilm.open_results(tmp_path) as tree:
        assert tree.attrs["kind"] == "shaft"
    # the scene: the shaft with its displacement, each bearing at its place
    shaft = pv.read(tmp_path / "vtk" / "shaft.vtp")
    assert shaft.bounds == pytest.approx((0.0, 280.0, -22.0, 22.0, -22.0, 22.0), abs=1e-3)
    largest = abs(results.solution.displacement[:, 1]).max() * 1e6
    assert abs(shaft["displacement [um]"][:, 1]).max() == pytest.approx(largest, rel=1e-5)
    for number, place in ((1, 60.0), (2, 268.0)):
        ring = pv.read(tmp_path / "vtk" / f"bearing_{number}_inner_ring.vtp")
        assert ring.center[0] == pytest.approx(place, abs=0.2)
    check_scene(tmp_path)
    page = report_page(tmp_path)
    assert "6207 CN" in page
    assert "Natural frequencies over the speed" in page


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("at_mm = 268.0", "at_mm = 468.0", "support.1.at_mm: found 468.0; allowed: on the shaft, up to 280 mm"),
        ("to_mm = 70.0", "to_mm = 30.0", "shaft.section.1.to_mm: found 30.0; allowed: more than 40 mm"),
        ('fixed = "both"', 'fixed = "none"', "no support holds the shaft along x"),
        ('"6207 CN"', '"6297 CN"', "support.0.bearing: unknown bearing"),
        ("force_N", "forces_N", "did you mean 'force_N'?"),
        ("outside_mm = 44.0", 'outside_mm = 44.0\nmaterial = "bearing stel"', "did you mean 'bearing steel'?"),
        ('fixed = "both"', "preload_N = 100.0", "support.0.loaded_by: missing"),
    ],
)
def test_a_fault_is_told_at_its_key(tmp_path, before, after, message):
    path = tmp_path / "shaft.toml"
    path.write_text(TEXT.replace(before, after), encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        load_shaft(path)
    assert message in str(caught.value)
    assert f"{path}:" in str(caught.value)


def test_a_shaft_is_not_run_as_a_bearing_nor_a_bearing_as_a_shaft():
    runner = CliRunner()
    run = runner.invoke(app, ["run", "spindle_two_bearings"])
    assert (run.exit_code, "oilfilm shaft" in run.output + run.stderr) == (2, True)
    shaft = runner.invoke(app, ["shaft", "6208_full_ceramic"])
    assert (shaft.exit_code, "oilfilm run" in shaft.output + shaft.stderr) == (2, True)
    assert runner.invoke(app, ["validate", "spindle_two_bearings"]).exit_code == 0


HEATED = """
schema_version = 1
title = "Spindle"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 8000.0
temperature = "self-heated"
[shaft]
gravity_m_s2 = [0.0, 0.0, 0.0]
[[shaft.section]]
to_mm = 250.0
outside_mm = 40.0
{supports}
[[load]]
at_mm = 100.0
force_N = [150.0, 400.0, 0.0]
[housing]
conductance_W_K = 0.5
thermal_expansion_um_m_K = 12.0
[friction]
heat_transfer_W_K = 1.5
lubrication = "grease"
heating_torque = "palmgren"
"""
SUPPORT = '[[support]]\nbearing = "7008C"\nat_mm = {}\nloaded_by = "{}x"\npreload_N = 200.0\n'


def heated(tmp_path, supports: str):
    """A shaft that warms itself on supports, read and solved."""
    path = tmp_path / "spindle.toml"
    path.write_text(HEATED.format(supports=supports), encoding="utf-8")
    case = load_shaft(path)
    return case, balance_of_heat(case, solve_shaft(case.system))


def test_one_bearing_on_a_shaft_has_the_balance_of_heat_of_the_bearing_alone(tmp_path):
    one = SUPPORT.format(100.0, "+")
    case, heat = heated(tmp_path, one)
    operation = {**case.documents[0]["operation"], "force_N": [150.0, 400.0, 0.0], "tilt": "free"}
    alone = self_heated(case_of_document({**case.documents[0], "operation": operation}))
    own = heat.bearings[0]
    assert own.converged
    assert heat.stable
    assert own.balance.temperature == pytest.approx(alone.balance.temperature, abs=1e-3)
    assert own.state.temperatures == pytest.approx(alone.state.temperatures, abs=1e-3)
    assert heat.links == ()
    ends = np.array([alone.stability.coldest, alone.stability.hottest])
    assert heat.node_range[:, 0] == pytest.approx(ends, abs=0.02)


def test_the_estimate_of_the_housing_widens_the_ranges(tmp_path):
    """Balances with a conductance at either end of the estimate lie between the coldest and the hottest."""
    path = tmp_path / "spindle.toml"
    supports = SUPPORT.format(60.0, "+") + SUPPORT.format(200.0, "-")
    path.write_text(HEATED.replace("conductance_W_K = 0.5\n", "").format(supports=supports), encoding="utf-8")
    case = load_shaft(path)
    heat = balance_of_heat(case, solve_shaft(case.system))
    (walls,) = [link.conductance for link in heat.links if link.node == "housing"]
    for end in (walls.low, walls.high):
        system = replace(case.system, housing_conductance=end)
        other = balance_of_heat(replace(case, system=system), solve_shaft(system))
        assert (heat.node_range[0] < other.temperatures).all()
        assert (other.temperatures < heat.node_range[1]).all()
    known = replace(case.system, housing_conductance=walls.value)
    narrow = balance_of_heat(replace(case, system=known), solve_shaft(known)).node_range
    assert (np.ptp(heat.node_range, axis=0) > np.ptp(narrow, axis=0) - 1e-6).all()


def test_bearings_warm_each_other_and_growth_between_them_frees_the_pair(tmp_path):
    case, heat = heated(tmp_path, SUPPORT.format(60.0, "+") + SUPPORT.format(200.0, "-"))
    flows = np.zeros(2)
    for link, flow in zip(heat.links, heat.flows, strict=True):
        flows[link.bearings[0]] += flow
        flows[link.bearings[1]] -= flow
    assert len(heat.links) == 2
    for own, flow in zip(heat.bearings, flows, strict=True):
        # 1. each bearing in balance with what goes to its neighbour
        assert own.converged
        assert own.balance.residual == pytest.approx(0.0, abs=1e-6)
        assert own.state.film_temperature == pytest.approx(own.state.resulting_temperature, abs=1e-3)
        by_hand = own.balance.power - sum(
            flow
            for path, flow in zip(own.state.network.paths, own.state.network.flows(own.state.temperatures), strict=True)
            if path.second in ("ambient", "oil_supply")
        )
        assert by_hand == pytest.approx(flow, abs=1e-4 * own.balance.power)
    # 2. growth of the shaft against the housing by the temperatures of both at the bearings
    shaft, housing = (heat.temperatures[:, NODES.index(name)] - 293.15 for name in ("shaft", "housing"))
    steel = case.system.sections[0].material.thermal_expansion
    by_hand = 0.14 * (steel * shaft.mean() - 12e-6 * housing.mean())
    growth = [support.growth for support in heat.shaft.system.supports]
    assert growth[1] - growth[0] == pytest.approx(by_hand, rel=1e-3)
    # 3. back to back it unloads the pair: fewer newtons on the bearing that the load does not press
    cold = solve_shaft(case.system)
    assert growth[1] > growth[0]
    assert abs(heat.shaft.reactions[1, 0]) < abs(cold.reactions[1, 0])


def test_temperatures_are_given_or_wanted_and_need_a_way_out(tmp_path):
    path = tmp_path / "spindle.toml"
    text = HEATED.format(supports=SUPPORT.format(60.0, "+"))
    faults = {
        'temperature = "self-heated"\nshaft_temperature_C = 50.0': "operation.shaft_temperature_C: found together",
        'temperature = "self-heated"': "",
    }
    for line, message in faults.items():
        path.write_text(text.replace('temperature = "self-heated"', line), encoding="utf-8")
        if message:
            with pytest.raises(CaseError, match=message):
                load_shaft(path)
        else:
            load_shaft(path)
    path.write_text(text.replace("heat_transfer_W_K = 1.5", ""), encoding="utf-8")
    with pytest.raises(CaseError, match=r"support.0.heat_transfer_W_K: missing"):
        load_shaft(path)


def test_a_housing_by_its_matrix_is_that_of_its_springs(tmp_path, monkeypatch):
    """Diagonal springs as numbers and as a file in N and mm; a rotation about the axis gives way freely."""
    monkeypatch.chdir(tmp_path)
    matrix = np.diag([2e5, 1e5, 1e5, 7.0, 3e7, 3e7])  # N/mm, N mm/rad
    matrix[1, 3] = matrix[3, 1] = 100.0
    np.savetxt("k.csv", matrix, delimiter=",")
    matrix[1, 1] -= 100.0**2 / 7.0  # of a seat that turns with it
    springs = "radial_stiffness_N_um = {}\naxial_stiffness_N_um = 200.0\ntilting_stiffness_N_m_mrad = 30.0"
    found = []
    for housing in ('stiffness = "k.csv"\nstiffness_units = "N mm rad"', springs.format(100.0)):
        path = tmp_path / "shaft.toml"
        path.write_text(f"{TEXT}\n[housing]\n{housing}\n", encoding="utf-8")
        found.append(load_shaft(path).system.housing)
    file, numbers = found
    assert file.shape == (10, 10)
    assert file[1, 1] == pytest.approx(1e3 * matrix[1, 1])
    file[[1, 6], [1, 6]] = numbers[1, 1]
    assert file == pytest.approx(numbers, rel=1e-9, abs=1.0)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("1,2\n3,4\n", "2 rows of 2 numbers; needed: a symmetric matrix of 6 rows and columns, or 12"),
        (np.triu(np.ones((6, 6))), "not symmetric"),
        (-np.eye(6), "not positive definite"),
        (np.full((6, 6), np.nan), "k.csv"),
    ],
)
def test_a_housing_of_another_shape_is_told_at_its_key(tmp_path, content, message):
    file = tmp_path / "k.csv"
    file.write_text(content, encoding="utf-8") if isinstance(content, str) else np.savetxt(file, content, delimiter=",")
    path = tmp_path / "shaft.toml"
    path.write_text(f'{TEXT}\n[housing]\nstiffness = "{file}"\n', encoding="utf-8")
    with pytest.raises(CaseError, match=r"housing\.stiffness") as caught:
        load_shaft(path)
    assert message in str(caught.value)


SWEEP = """
case = "spindle_two_bearings"
[sweep]
"load.0.force_N.1" = [-500.0, -900.0]
"support.1.at_mm" = [{}]
"""


def test_a_batch_varies_loads_and_supports_by_their_numbers(results):
    sweep = sweep_from_text(SWEEP.format("240.0, 268.0"), "sweep.toml")
    values = [point.values for point in sweep.points]
    assert values[0] == {"load.0.force_N.1": -500.0, "support.1.at_mm": 240.0}
    document = sweep.points[0].document
    assert document["load"][0]["force_N"] == [0.0, -500.0, 0.0]
    assert document["load"][1] == sweep.points[3].document["load"][1]
    # the last point is the case itself, and its main results are those of the run
    assert sweep.points[3].resolved["load"] == results.case["load"]
    summary = shaft_summary(results)
    main = main_results(summary)
    assert tuple(main) == result_names("shaft")
    assert main["critical_speed_rpm"] == summary["critical_speeds_rpm"][0]
    assert main["torque_N_mm"] == summary["system"]["torque_N_mm"]
    assert scalar_numbers(summary)["bearings.1.torque_N_mm.total"] == summary["bearings"][1]["torque_N_mm"]["total"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("268.0", "468.0"), "allowed: on the shaft, up to 280 mm"),
        (("support.1", "support.7"), "the case has no entry 7 of support"),
        (("[sweep]", 'compute = "torque"\n[sweep]'), "the case is a shaft"),
    ],
)
def test_a_fault_of_a_point_is_told_at_its_key_of_the_sweep(change, message):
    with pytest.raises(CaseError) as caught:
        sweep_from_text(SWEEP.format("268.0").replace(*change), "sweep.toml")
    assert message in str(caught.value)


class Elements(list):
    """ROSS as far as its lines go: every element by its class, its numbers and its names."""

    def __getattr__(self, name):
        return lambda *values, **named: self.append((name, values, named)) or (name, values, named)

    def run_modal(self, speed):
        return SimpleNamespace(wn=[], log_dec=[])


def test_lines_for_ross_have_the_whole_shaft(results, monkeypatch):
    """Nodes and sections of the vibration's mesh; stiffness and films of each bearing, the axis of the shaft last."""
    made = Elements()
    made.Rotor = lambda *parts: made
    monkeypatch.setitem(sys.modules, "ross", made)
    exec(ross_rotor(results), {})
    shaft = [values for name, values, _ in made if name == "ShaftElement"]
    assert np.cumsum([0.0, *(one[0] for one in shaft)]) == pytest.approx(results.vibration.positions)
    system = results.solution.system
    assert {one[2] for one in shaft} == {section.outside_diameter for section in system.sections}
    discs = [values for name, values, _ in made if name == "DiskElement"]
    assert [one[1] for one in discs] == [load.mass for load in system.loads if load.mass]
    bearings = [(values[0], named) for name, values, named in made if name == "BearingElement"]
    assert len(bearings) == len(system.supports)
    for (node, found), support, state in zip(bearings, system.supports, results.solution.bearings, strict=True):
        assert results.vibration.positions[node] == pytest.approx(support.position)
        assert (found["kyy"], found["kxx"]) == pytest.approx((state.stiffness[1, 1], state.stiffness[2, 2]), rel=0.02)
        assert found["cxx"] > 0.0 and found["cyy"] > 0.0
    first, second = (named for _, named in bearings)
    assert first["kzz"] > 1e6 and first["czz"] > 0.0
    assert second["kzz"] == second["czz"] == 0.0  # it floats


def test_lines_for_ross_need_an_equilibrium(tmp_path, monkeypatch):
    """Told in one line beside the flagged results."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lost.toml").write_text(TEXT.replace("-900.0", "-5.0e6"), encoding="utf-8")
    found = CliRunner().invoke(app, ["shaft", "lost.toml", "--ross", "-q", "-o", "out"])
    assert found.exit_code == 1 and "--ross: the shaft has no equilibrium" in found.stderr
    assert (
        "BearingElement" not in found.stdout
        and not json.loads((tmp_path / "out/summary.json").read_text())["converged"]
    )


def test_every_number_is_kept(results, tmp_path):
    with drawn() as pictures:
        write_shaft(results, tmp_path, write_shaft_collection)
    kept("shaft", {"summary": shaft_summary(results), "files": tmp_path, "pictures": pictures})
