"""Parts of results of shipped cases beside their main numbers: torque, stiffness, slip, a simulation, VTK fields.

The numbers are ours, not a reference, as in test_shipped_cases.py; written by `python tests/regression/test_parts.py`.
What follows from closed equations is kept to 1e-6; what films or an integration in time give, to 0.5 %.
"""

from __future__ import annotations

import json
import tempfile
from dataclasses import replace
from pathlib import Path

import pytest

from oilfilm.cases import load_case, run_case, run_contact
from oilfilm.cases.format.document import read_text
from oilfilm.cases.format.shipped import find_case

EXPECTED = Path(__file__).with_name("expected_parts.json")
CLOSED, SOLVED = 1e-6, 5e-3
BALANCED = 1e-7  # of a balance of power, which is round-off and what the balls' search leaves [-]
NOISE = 1e-9  # of values that are zero, in the unit of their key
ROUND_OFF = 1e-14  # of the largest entry of a matrix, whose zeros are differences of such entries
ELECTRICAL = ("6206_motor_steel", "6206_motor_hybrid")
BEARINGS = ("6206_axial_500N", "6206_combined_1000N", "6205_all_silicon_nitride", "7008C_hybrid")


def leaves(node, name=""):
    """Numbers of nested tables and lists by the path to them; those that are null left out."""
    children = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    if isinstance(node, int | float) and not isinstance(node, bool):
        return {name: float(node)}
    return {key: value for child, part in children for key, value in leaves(part, f"{name}/{child}").items()}


def bearing_parts(stem):
    """Torque by model and part, and the stiffness."""
    from oilfilm.postprocess import summary

    found = summary(run_case(load_case(stem)))
    return leaves(found["torque_N_mm"], "torque_N_mm") | leaves(found["ring"]["stiffness"]["matrix"], "stiffness")


def electrical_parts(stem):
    """Capacitance and breakdown voltage of the bearing, and of its contacts by their films, on a coarse grid."""
    from oilfilm.postprocess import summary

    case = load_case(stem)
    found = summary(run_case(replace(case, solver=replace(case.solver, points=65))))
    keys = ("capacitance_pF", "capacitance_uncertainty_pF", "breakdown_voltage_V", "breakdown_voltage_low_V")
    contacts = [{key: contact[key] for key in keys} for contact in found["contacts"][:6]]
    return leaves({"electrical": found["electrical"], "contacts": contacts})


def slip_parts(folder):
    """Critical loads, slip factors and preloads of the 7000C on a coarse mesh."""
    from oilfilm.cases.runs.stiffness_and_slip import run_slip
    from oilfilm.postprocess.slip.results import slip_summary

    text = read_text(find_case("hirano_7000C")).replace("points = 51\n", "points = 3\ncritical_points = 2\n")
    path = folder / "slip.toml"
    path.write_text(text, encoding="utf-8")
    found = slip_summary(run_slip(load_case(path), "slip", workers=1))
    return leaves({key: found[key] for key in ("minimum_preload", "surface", "critical_curves")})


def simulation_parts(folder):
    """The 6304 for 4 ms at speed: cage, work by mechanism, states of contacts."""
    changes = (
        ("end_time_s = 1.0", "end_time_s = 0.004"),
        ("output_interval_us = 200.0", "output_interval_us = 50.0"),
        ('start = "rest"\n', ""),
        ("speed_table_rpm = [[0.0, 0.0], [0.3, 8000.0]]\n", ""),
    )
    return simulated("6304_planar", changes, folder)


def unbalance_parts(folder):
    """The 7008 with a load that goes round, 4 ms: general equations."""
    changes = (("end_time_s = 0.072", "end_time_s = 0.004"), ("interval_us = 50.0", "interval_us = 100.0"))
    return simulated("7008_unbalance", changes, folder)


def warming_parts(folder):
    """The 7008 whose ring is pushed in while the oil warms, the course in 4 ms."""
    changes = (("end_time_s = 0.1", "end_time_s = 0.004"), ("[0.06,", "[0.003,"))
    return simulated("7008_warming", changes, folder)


PROGRAMS = {"unbalance": unbalance_parts, "warming": warming_parts}


def simulated(stem, changes, folder):
    """Numbers of a shipped simulation with changes of its text."""
    from oilfilm.cases.runs.dynamics import run_dynamics
    from oilfilm.postprocess.dynamics.results import dynamics_summary

    text = read_text(find_case(stem))
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "simulation.toml"
    path.write_text(text, encoding="utf-8")
    found = dynamics_summary(run_dynamics(load_case(path), "simulation", folder / "history.nc"))
    kept = ("simulated_s", "equations", "cage_speed_rpm", "cage_speed_ratio", "balls", "work_mJ")
    return leaves({key: found[key] for key in kept if key in found})


def field_parts(folder):
    """Least, mean and largest value of each field of the VTK file of a single contact."""
    import pyvista

    from oilfilm.postprocess.scene.vtk import write_collection

    case = load_case("ball_on_disc")
    write_collection(run_contact(replace(case, solver=replace(case.solver, points=65, tolerance=None))), folder)
    block = pyvista.get_reader(folder / "fields.pvd").read()[0]["contact"]["contact"]
    fields = {name: block[name] for name in block.point_data} | dict(zip("xyz", block.points.T, strict=True))
    return {
        f"{name} {kind}": float(getattr(values, kind)())
        for name, values in fields.items()
        for kind in ("min", "mean", "max")
    }


@pytest.mark.parametrize("stem", BEARINGS)
def test_torque_and_stiffness(stem):
    compare(bearing_parts(stem), stem, CLOSED)


@pytest.mark.parametrize("stem", ELECTRICAL)
def test_electrical(stem):
    compare(electrical_parts(stem), stem, SOLVED)


def test_slip(tmp_path):
    compare(slip_parts(tmp_path), "slip", CLOSED)


def test_simulation(tmp_path):
    compare(simulation_parts(tmp_path), "simulation", SOLVED)


@pytest.mark.parametrize("name", PROGRAMS)
def test_programs(tmp_path, name):
    compare(PROGRAMS[name](tmp_path), name, SOLVED)


def test_vtk_fields(tmp_path):
    pytest.importorskip("pyvista")
    compare(field_parts(tmp_path), "fields", SOLVED)


def compare(found, name, tolerance):
    """Every number, by its path, with the expected one; the offenders are shown."""
    expected = json.loads(EXPECTED.read_text(encoding="utf-8"))[name]
    assert found.keys() == expected.keys()
    stiffest = max((abs(value) for key, value in expected.items() if key.startswith("stiffness")), default=0.0)
    pairs = {key: (found[key], value) for key, value in expected.items()}
    noise = {key: max(NOISE, ROUND_OFF * stiffest) if key.startswith("stiffness") else NOISE for key in pairs}
    noise |= {key: BALANCED for key in pairs if key.startswith("power_balance")}
    off = {key: pair for key, pair in pairs.items() if pair[0] != pytest.approx(pair[1], rel=tolerance, abs=noise[key])}
    assert off == {}


if __name__ == "__main__":
    numbers = {stem: bearing_parts(stem) for stem in BEARINGS}
    numbers |= {stem: electrical_parts(stem) for stem in ELECTRICAL}
    others = {"slip": slip_parts, "simulation": simulation_parts, **PROGRAMS, "fields": field_parts}
    for name, parts in others.items():
        with tempfile.TemporaryDirectory() as directory:
            numbers[name] = parts(Path(directory))
    EXPECTED.write_text(json.dumps(numbers, indent=1) + "\n", encoding="utf-8")
