"""Command dynamics: a short simulation, its files, its errors, interruption and restart."""

from __future__ import annotations

import io
import json
import math
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console
from typer.testing import CliRunner

from oilfilm.bearing.dynamics.arrays import OIL_VISCOSITY
from oilfilm.bearing.dynamics.statistics import states
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.cases import load_case, run_case
from oilfilm.cases.cli.main import app
from oilfilm.cases.cli.over_time import _write
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shipped import find_case
from oilfilm.cases.runs.dynamics import Interrupted, case_key, run_dynamics
from oilfilm.cases.runs.motion_model import build_model
from oilfilm.postprocess import summary
from oilfilm.postprocess.dynamics.read import averaged, open_history, simulated_speeds
from oilfilm.postprocess.dynamics.results import dynamics_summary, dynamics_table
from oilfilm.postprocess.report.html import figure, number
from oilfilm.postprocess.report.page import report_page

from ...kept import drawn, kept

SHOWN = {}  # of the run in `folder`
SHORT = "end_time_s = 0.004\noutput_interval_us = 50.0\n"
PICTURES = ("speeds", "spin", "forces", "sliding", "states", "orbits", "spectrum", "energy")


# of 7008_combined: an oil whose viscosity is known over temperature; a ring held along x and z
OIL = ("viscosity_mPa_s = 20.0\npressure_viscosity_1_GPa = 18.0\ndensity_kg_m3 = 870.0", 'name = "iso vg 32"')
EXIT_STACK = ("axial_load_N = 100.0", 'displacement_um = [220.0, "free", 0.0]')
WARMER = "temperature_table_C = [[0.0, 40.0], [1.0, 60.0]]"


def run(*arguments):
    return CliRunner().invoke(app, ["dynamics", *map(str, arguments)])


def short(path, name="7008_combined", *changes):
    """A shipped case with a short end time and replacements of its text."""
    text = find_case(name).read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith(("end_time_s", "output_interval_us"))]
    text = "\n".join(lines).replace("[dynamics]\n", "[dynamics]\n" + SHORT)
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path.write_text(text + "\n", encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dynamics")
    with drawn(as_well=True) as SHOWN["pictures"]:
        found = run(short(folder / "case.toml"), "-o", folder / "out")
    assert found.exit_code == 0, found.output
    return folder / "out", found


def numbers(node):
    if isinstance(node, dict):
        node = list(node.values())
    if isinstance(node, list):
        return [value for child in node for value in numbers(child)]
    return [node] if isinstance(node, float) else []


def test_summary_has_the_keys_of_the_contract(folder):
    document = json.loads((folder[0] / "summary.json").read_text(encoding="utf-8"))
    wanted = {
        "simulated_s", "wall_s", "steps", "equations", "cage_speed_rpm", "cage_speed_ratio", "energy_balance_error",
        "cage_speed_interval_rpm", "ball_orbit_speed_interval_rpm", "ring_whirl_speed_rpm", "cage_whirl_speed_rpm",
        "cage_whirl", "cage_orbit_radius_um", "contact_angle_deg",
        "converged", "messages", "case",
    }  # fmt: skip
    assert wanted <= document.keys()
    assert document["equations"] == 3 + 6 + 6 * 18  # both loads leave no symmetry; the tilt is held
    assert document["simulated_s"] == pytest.approx(0.004)
    assert document["energy_balance_error"] < 1e-3
    assert document["converged"]
    energy = document["energy"]
    assert energy["films_J"] == 0.0  # no lubricated contacts
    assert "films" not in energy["dissipated_J"]
    left = sum(energy["input_J"].values()) - sum(energy["dissipated_J"].values()) - energy["films_J"]
    assert energy["stored_J"] == pytest.approx(left)
    assert all(math.isfinite(value) for value in numbers(document))
    for ball in document["balls"]:
        for race in ("inner", "outer"):
            assert sum(ball[race][state] for state in ("free", "contact", "impact")) == pytest.approx(1.0, abs=1e-6)


def test_defect_frequencies_follow_the_cage(folder):
    """Z balls pass a standing outer race in a turn of the cage, the inner one in a turn of the ring less that."""
    document = json.loads((folder[0] / "summary.json").read_text(encoding="utf-8"))
    bearing = document["case"]["bearing"]
    turns = document["case"]["operation"]["inner_speed_rpm"] / 60.0
    gamma = bearing["ball_diameter_mm"] / bearing["pitch_diameter_mm"]
    assert 15.0 < document["contact_angle_deg"] < 18.0  # of the loaded bearing, larger than the free one
    cosine = math.cos(math.radians(document["contact_angle_deg"]))
    cages = {"kinematic": 0.5 * turns * (1.0 - gamma * cosine), "with_slip": document["ball_orbit_speed_rpm"] / 60.0}
    spins = {
        "kinematic": 0.5 * turns / gamma * (1.0 - (gamma * cosine) ** 2),
        "with_slip": document["ball_spin_speed_rpm"] / 60.0,
    }
    assert spins["with_slip"] == pytest.approx(spins["kinematic"], rel=0.02)
    for name, cage in cages.items():
        found = document["frequencies_Hz"][name]
        wanted = {
            "cage": cage, "ball_pass_outer": 18 * cage, "ball_pass_inner": 18 * (turns - cage),
            "ball_spin": spins[name],
        }  # fmt: skip
        assert found == pytest.approx(wanted, rel=1e-6)
    ratio = document["cage_speed_rpm"] / 60.0 / cages["kinematic"]
    assert document["cage_speed_ratio"] == pytest.approx(ratio)
    assert document["cage_slip_ratio"] == pytest.approx(1.0 - ratio, abs=1e-9)


def test_history_has_named_quantities_with_units(folder):
    with open_history(folder[0]) as data:
        assert data.sizes["time"] == 80
        assert data["contact_load"].dims == ("time", "race", "ball")
        assert data["contact_load"].attrs["units"] == "N"
        # the cage, which is free to move, lifts balls off the outer race when it starts with them
        assert float((data["contact_load"].sel(race="outer") > 0.0).mean()) > 0.995
        speed = data["cage_velocity"].sel(cage_coordinate="rotation")
        assert float(speed[-1]) == pytest.approx(2180.0 * np.pi / 30.0, rel=0.05)
        quaternion = data["ball_attitude"].to_numpy()
        assert np.abs(np.linalg.norm(quaternion, axis=-1) - 1.0).max() < 1e-6
        assert (np.diff(data["time"]) > 0.0).all()


def test_pictures_and_table(folder):
    for name in PICTURES:
        assert (folder[0] / f"{name}.png").stat().st_size > 10_000
    text = folder[1].stdout  # not that kernels are compiled, which is said elsewhere
    assert "117 (combined: 3 ring + 6 cage + 108 balls)" in text
    assert max(len(line.rstrip()) for line in text.splitlines() if "results in" not in line) <= 80


def test_slip_over_time_is_that_of_the_summary(folder):
    """By one rule: mean over the averaged third beside the ratio of the means, at angles that hardly change."""
    document = json.loads((folder[0] / "summary.json").read_text(encoding="utf-8"))
    with open_history(folder[0]).load() as data:
        found, late = simulated_speeds(data, document), averaged(data)
    assert float(found.cage.slip[late].mean()) == pytest.approx(document["cage_slip_ratio"], abs=1e-3)
    orbit = float(found.orbit.speed[late].mean()) * 30.0 / np.pi
    assert orbit == pytest.approx(document["ball_orbit_speed_rpm"], rel=1e-6)
    spin = float(found.spin.speed[late].mean()) * 30.0 / np.pi
    assert spin == pytest.approx(document["ball_spin_speed_rpm"], rel=1e-5)


def test_the_report_of_a_simulation(folder):
    """Speeds, slip, loads, sliding, friction and pictures have a place; nothing stands twice."""
    document = json.loads((folder[0] / "summary.json").read_text(encoding="utf-8"))
    page = report_page(folder[0])
    assert page.count("<img") == len(PICTURES)
    for words in (
        "Time simulation", "slip of the cage", "cage slip ratio", "ball spin speed", "inner: mean sliding",
        "outer: mean friction", "inner: largest load", "pocket friction", "BSF",
    ):  # fmt: skip
        assert words in page
    assert "Further" not in page
    for key in ("mean_load_N", "mean_sliding_m_s", "mean_friction_N"):
        assert f"<td>{figure(document['balls'][0]['outer'][key])}</td>" in page
    assert f"{number(100.0 * document['cage_slip_ratio'], 3)} <small>%" in page


@pytest.mark.parametrize(("films", "words"), [(-0.25, "0.25 J given, lifting balls"), (0.5, "0.5 J taken up")])
def test_work_of_films_is_told_beside_what_is_lost(folder, films, words):
    document = json.loads((folder[0] / "summary.json").read_text(encoding="utf-8"))
    document["energy"]["films_J"] = films
    console = Console(width=80, record=True, file=io.StringIO())
    console.print(dynamics_table(document))
    text = console.export_text()
    assert words in text
    assert "N mm by four constants, without rolling resistance" in " ".join(text.split())
    assert f"{sum(document['energy']['dissipated_J'].values()):.4g} J lost" in text


def test_json_alone_writes_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    case = short(tmp_path / "case.toml", "7008_axial", ("end_time_s = 0.004", "end_time_s = 0.0002"))
    found = CliRunner().invoke(app, ["dynamics", str(case), "--json"])
    assert found.exit_code == 0
    document = json.loads(found.stdout)
    assert document["load_type"] == "axial"
    assert [path.name for path in tmp_path.iterdir()] == ["case.toml"]


def test_an_interrupt_while_results_are_written_leaves_out_the_other_pictures(tmp_path):
    case = load_case(short(tmp_path / "case.toml", "7008_axial"))
    results = run_dynamics(case, "case", tmp_path / "whole.nc")
    answers = iter((False, False, False))
    problems = _write(results, tmp_path / "out", lambda: next(answers, True))
    assert problems == ("the other pictures not written: interrupted",)
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"history.nc", "summary.json"} < written
    assert sum(name.endswith(".png") for name in written) == 2
    assert "motion.pvd" not in written


def test_an_interrupted_run_goes_on(tmp_path):
    """The restart file leads to the end that an uninterrupted run reaches."""
    case = load_case(
        short(tmp_path / "case.toml", "7008_axial", ("output_interval_us = 50.0", "output_interval_us = 5.0"))
    )
    whole = run_dynamics(case, "case", tmp_path / "whole.nc")

    def stop(done, total, state):
        if done:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted) as caught:
        run_dynamics(case, "case", tmp_path / "part.nc", progress=stop)
    from oilfilm.bearing.dynamics.simulation import save_restart

    part = caught.value.simulation
    assert 0.0 < part.state.time < 0.004
    save_restart(part, tmp_path / "restart.npz", case_key(case))
    rest = run_dynamics(case, "case", tmp_path / "rest.nc", restart=tmp_path / "restart.npz")
    assert rest.simulation.state.time == whole.simulation.state.time
    np.testing.assert_array_equal(rest.simulation.state.y, whole.simulation.state.y)
    with open_history(tmp_path / "part.nc") as first, open_history(tmp_path / "rest.nc") as second:
        assert float(first["time"][-1]) < float(second["time"][0])
    other = load_case(short(tmp_path / "other.toml", "7008_radial"))
    with pytest.raises(CaseError, match="another case"):
        run_dynamics(other, "other", tmp_path / "x.nc", restart=tmp_path / "restart.npz")
    with np.load(tmp_path / "restart.npz") as data:
        old = json.dumps(json.loads(str(data["head"])) | {"format": 1})
        np.savez(tmp_path / "old.npz", **{**data, "head": np.array(old)})
    with pytest.raises(CaseError, match=r"old\.npz: was written by another version of the program; start anew"):
        run_dynamics(case, "case", tmp_path / "z.nc", restart=tmp_path / "old.npz")
    (tmp_path / "bad.npz").write_bytes(b"no archive")
    with pytest.raises(CaseError, match="no restart file"):
        run_dynamics(case, "case", tmp_path / "y.nc", restart=tmp_path / "bad.npz")


@pytest.mark.slow
def test_ctrl_c_in_the_middle_of_the_steps(tmp_path):
    """A real signal, at any moment: no time counts twice, and the restart reaches the end of an uninterrupted run."""
    path = short(tmp_path / "case.toml", "7008_axial", ("interval_us = 50.0", "interval_us = 5.0"), ("0.004", "0.012"))
    whole = run_dynamics(load_case(path), "case", tmp_path / "whole.nc")
    command = [
        sys.executable,
        "-c",
        "from oilfilm.cases.cli.main import app; app()",
        "dynamics",
        str(path),
        "-o",
        "out",
        "--quiet",
    ]
    run = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    while run.poll() is None and not any(file.stat().st_size > 20_000 for file in tmp_path.glob(".out-*.partial/*")):
        time.sleep(0.005)
    run.send_signal(signal.SIGINT)
    said = run.communicate()[1]
    assert run.returncode == 3, said
    assert "--restart" in said
    case = load_case(path)
    rest = run_dynamics(case, "case", tmp_path / "rest.nc", restart=tmp_path / "out_restart.npz")
    np.testing.assert_array_equal(rest.simulation.state.y, whole.simulation.state.y)
    np.testing.assert_allclose(rest.simulation.state.shares.sum(axis=2), 0.012, rtol=1e-9)
    assert any("continued at t" in message for message in rest.messages)
    with open_history(tmp_path / "out") as first, open_history(tmp_path / "rest.nc") as second:
        assert first.sizes["time"] + second.sizes["time"] == 2400
        assert 0.0 < float(second["time"][0] - first["time"][-1]) < 5.1e-6


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ([("ball_drag_N = 1.4", "ball_drag_N = 1.4\nmixture_density_kg_m3 = 9.0")], "mixture_density_kg_m3"),
        ([("traction_limit = 0.03", "traction_limit = 0.06")], "below traction_maximum"),
        ([("output_interval_us = 50.0", "output_interval_us = 1e-6")], "rows"),
        ([("restitution = 0.9", 'contact_law = "lubricated"')], 'friction = "table"'),
        ([("restitution = 0.9", "speed_table_rpm = [[0.0, 1.0], [0.0, 2.0]]")], "rising"),
        ([("restitution = 0.9", "load_table_N = [[0.0, 1.0]]")], "rows of 4 numbers"),
        ([("restitution = 0.9", "gravity_m_s2 = [0.0, 9.81]")], "three numbers"),
        ([("restitution = 0.9", "rotating_load_speed_rpm = 9.0")], "rotating_load_N"),
        ([("restitution = 0.9", "rotating_load_N = 9.0\nrotating_load_phase_deg = 400.0")], ">= -360"),
        ([("restitution = 0.9", "moment_table_N_mm = [[0.0, 1.0, 0.0]]")], "where the tilt is held"),
        ([("restitution = 0.9", "temperature_table_C = [[0.0, 40.0], [1.0, 60.0]]")], "at one temperature"),
        ([OIL, ("restitution = 0.9", "temperature_table_C = [[0.0, 40.0], [1.0, 460.0]]")], "allowed: 20 to 100"),
        ([OIL, ("restitution = 0.9", f"cage_film = false\n{WARMER}")], "found with cage_film = false"),
        ([OIL, ("restitution = 0.9", f"cage = false\n{WARMER}")], "found with cage = false"),
        ([OIL, ("restitution = 0.9", f'friction = "table"\n{WARMER}')], "films are of one temperature"),
        ([("restitution = 0.9", "displacement_table_um = [[0.0, 5.0, 0.0, 0.0]]")], "along x, where the ring is free"),
        ([("restitution = 0.9", 'displacement_table_um = [[0.0, 5.0, "fre", 0.0]]')], 'the word "free"'),
        ([("restitution = 0.9", 'tilt_table_mrad = [[0.0, 5.0, "free"]]')], "holds the ring"),
        ([EXIT_STACK, ("restitution = 0.9", "load_table_N = [[0.0, 5.0, 0.0, 0.0]]")], "a load of 5.0 N along x"),
        ([EXIT_STACK, ("restitution = 0.9", "rotating_load_N = 5.0")], "held across the axis"),
        ([("pocket_friction = 0.05", 'guided_by = "outer ring"')], "land_diameter_mm"),
    ],
)
def test_errors_name_line_and_key(tmp_path, changes, words):
    found = run(short(tmp_path / "case.toml", "7008_combined", *changes), "--json")
    assert found.exit_code == 2
    assert words in found.stderr
    assert "case.toml:" in found.stderr


def test_errors_without_a_line(tmp_path):
    assert run("6208_full_ceramic", "--json").exit_code == 2
    assert "[dynamics]" in run("6208_full_ceramic", "--json").stderr
    assert run("ball_on_disc", "--json").exit_code == 2
    without = short(tmp_path / "bare.toml", "7008_axial", ("bore_mm = 40.0\n", ""))
    assert "bore" in run(without, "--json").stderr


def test_tables_over_time_and_planar_equations(tmp_path):
    """A run-up with a load that grows: the schedule reaches ring and balls; the cage is estimated, and named so."""
    changes = [
        (
            "[[0.0, 0.0], [0.3, 8000.0]]",
            "[[0.0, 0.0], [0.002, 800.0]]\nload_table_N = [[0.0, 0, 50, 0], [0.004, 0, 90, 0]]",
        ),
        ("pocket_clearance_mm = 0.2\n", ""),
    ]
    case = load_case(short(tmp_path / "case.toml", "6304_planar", *changes))
    results = run_dynamics(case, "case", tmp_path / "h.nc")
    assert results.simulation.equations["dynamic"] == 2 + 3 + 3 * 7
    assert any("cage.pocket_clearance" in message for message in results.messages)
    with open_history(tmp_path / "h.nc") as data:
        assert float(data["ring_rotation"][-1]) == pytest.approx(0.003 * 800.0 * np.pi / 30.0, rel=1e-6)


def test_a_load_that_goes_round_beside_thrust(tmp_path):
    """At the speed of the ring, left out, it goes round with it: the general equations, and a ring that follows."""
    load = "restitution = 0.9\nrotating_load_N = 40.0\nrotating_load_phase_deg = 90.0"
    case = load_case(short(tmp_path / "case.toml", "7008_axial", ("restitution = 0.9", load)))
    results = run_dynamics(case, "case", tmp_path / "h.nc")
    made = results.simulation
    assert made.model.rotating is not None
    assert made.model.rotating.speed == pytest.approx(5000.0 * np.pi / 30.0)
    assert made.equations["dynamic"] == 117
    with open_history(tmp_path / "h.nc") as data:
        y, z = (float(value) for value in data["ring_position"][0, 1:3])
    assert z > 3.0 * abs(y)  # a start in equilibrium, towards the phase


def test_a_ring_that_is_moved_and_oil_that_warms(tmp_path):
    """Displacement, tilt and temperature over time: the history follows the rows, the oil its law, told."""
    moved = (
        "restitution = 0.9\n"
        'displacement_table_um = [[0.0, 215.0, "free", "free"], [0.002, 230.0, "free", "free"]]\n'
        "tilt_table_mrad = [[0.0, 0.0, 0.0], [0.004, 0.5, 0.0]]\n"
        "temperature_table_C = [[0.0, 20.0], [0.004, 100.0]]"
    )
    held = ("axial_load_N = 100.0", 'displacement_um = [200.0, "free", "free"]')
    oil = (OIL[0], 'name = "ISO VG 46"')
    case = load_case(short(tmp_path / "case.toml", "7008_axial", held, oil, ("restitution = 0.9", moved)))
    results = run_dynamics(case, "case", tmp_path / "h.nc")
    made = results.simulation
    assert made.converged
    assert made.equations["ring"] == 2
    with open_history(tmp_path / "h.nc") as data:
        ring = data["ring_position"].to_numpy()
    assert ring[-1, 0] == pytest.approx(230e-6, rel=1e-12)
    assert ring[-1, 3] == pytest.approx(0.5e-3, rel=1e-12)
    assert np.abs(ring[:, 1]).max() > 0.0  # it is free across the axis
    # Vogel: 0.0762 exp(866/(t + 95)) mm2/s, at the density of each temperature; no row is farther off than told
    times, thinner = made.data.times, made.data.schedule[:, OIL_VISCOSITY]
    oil = load_lubricant("iso vg 46", 313.15)
    for share in (0.0, 0.3, 0.77, 1.0):
        wanted = load_lubricant("iso vg 46", 293.15 + 80.0 * share).viscosity / oil.viscosity
        assert np.interp(0.004 * share, times, thinner) == pytest.approx(wanted, rel=1.1e-3)
    (told,) = (message for message in results.messages if "mPa s over time" in message)
    assert "do not follow the temperature" in told


@pytest.mark.slow
def test_the_shipped_unbalance_moves_the_ring_as_its_stiffness_says(tmp_path):
    """The centre goes round with the ring at F/|k - m w^2 + i c w| of the equilibrium's stiffness."""
    case = load_case("7008_unbalance")
    results = run_dynamics(case, "case", tmp_path / "h.nc")
    document = dynamics_summary(results)
    assert document["ring_whirl_speed_rpm"] == pytest.approx(5000.0, rel=5e-3)
    assert document["energy_balance_error"] < 1e-4
    with open_history(tmp_path / "h.nc") as data:
        late = data["ring_position"].to_numpy()[-480:, 1:3]  # two turns
    radius = float(np.hypot(*(late - late.mean(axis=0)).T).mean())
    given = results.simulation.model
    speed = case.operation.inner_speed
    stiff = stiffness(case)
    pull = complex(stiff - given.ring.mass * speed**2, given.ring.damping * speed)
    assert radius == pytest.approx(given.rotating.force / abs(pull), rel=0.02)


def stiffness(case):
    """Of the ring along y, all other coordinates but the tilts free [N/m]."""
    matrix = np.array(summary(run_case(case))["ring"]["stiffness"]["matrix"])[:3, :3]
    return 1.0 / np.linalg.inv(matrix)[1, 1]


def test_the_shipped_ring_that_is_pushed_in_ends_in_equilibrium(tmp_path):
    """Loads of the balls at the end are those of the quasi-static ring at the last displacement."""
    case = load_case("7008_warming")
    results = run_dynamics(case, "case", tmp_path / "h.nc")
    assert results.simulation.converged
    end = replace(case.operation, displacement=(235e-6, None, None))
    wanted = solve_quasistatic(case.bearing, end)
    with open_history(tmp_path / "h.nc") as data:
        loads = data["contact_load"][-200:].mean("time").to_numpy()
    np.testing.assert_allclose(loads[0], wanted.inner_load, rtol=5e-3)
    np.testing.assert_allclose(loads[1], wanted.outer_load, rtol=5e-3)


def test_shipped_cases_are_copied_whole(tmp_path):
    """Every shipped simulation is a case that validates."""
    for name in ("7008_axial", "7008_radial", "7008_combined", "7008_unbalance", "7008_warming", "6304_planar"):
        copied = shutil.copy(find_case(name), tmp_path)
        assert load_case(copied).file.dynamics is not None


def test_standstill_is_no_error(tmp_path):
    """A drag that is given at the speed of the operation has none to count at, which a message says.

    With a ramp over the sliding speed: that of four constants, over the entrainment, has no width at rest, and the
    energies are flagged.
    """
    still = (
        ("inner_speed_rpm = 5000.0", "inner_speed_rpm = 0.0"),
        ("end_time_s = 0.004", "end_time_s = 0.0004"),
        ("restitution = 0.9", 'restitution = 0.9\nfriction = "coulomb"'),
    )
    found = run(short(tmp_path / "case.toml", "7008_axial", *still), "--json")
    assert found.exit_code == 0, found.stderr
    document = json.loads(found.stdout)
    assert abs(document["cage_speed_rpm"]) < 1.0
    assert document["cage_speed_ratio"] is None
    assert any("ball_drag_N has no speed to count at" in message for message in document["messages"])


def test_a_friction_that_knows_no_oil_says_so(folder):
    document = json.loads((folder[0] / "summary.json").read_text(encoding="utf-8"))
    assert any("whatever oil and temperature" in message for message in document["messages"])


def test_outer_ring_and_moment_over_time(tmp_path):
    """Both rings run up at the same rate, and the ring tilts under a moment that grows."""
    changes = [
        ("axial_load_N = 100.0", "axial_load_N = 100.0\nmoment_N_mm = [0.0, 0.0]"),
        (
            "restitution = 0.9",
            "restitution = 0.9\nouter_speed_table_rpm = [[0.0, 0.0], [0.004, 500.0]]\n"
            "moment_table_N_mm = [[0.0, 0.0, 0.0], [0.004, 300.0, 0.0]]",
        ),
    ]
    case = load_case(short(tmp_path / "case.toml", "7008_axial", *changes))
    results = run_dynamics(case, "case", tmp_path / "h.nc")
    assert results.simulation.equations["dynamic"] == 5 + 6 + 6 * 18
    assert results.simulation.data.schedule[-1, 1] == pytest.approx(500.0 * math.pi / 30.0)
    with open_history(tmp_path / "h.nc") as data:
        tilt = np.abs(data["ring_position"].sel(ring_coordinate=["tilt_y", "tilt_z"]).to_numpy()).max(axis=1)
    assert tilt[-1] > 10.0 * tilt[3]


def test_further_starts_and_their_states(tmp_path):
    """Three starts of a bearing under thrust end in one state; keys of the summary."""
    change = ("restitution = 0.9", "restitution = 0.9\nstarts = 3")
    found = run(
        short(tmp_path / "case.toml", "7008_axial", change, ("ball_drag_N = 1.4", "ball_drag_N = 0.1")), "--json"
    )
    assert found.exit_code == 0, found.stderr
    document = json.loads(found.stdout)
    assert len(document["starts"]) == 3
    assert document["starts"][0]["cage_speed_rpm"] == document["cage_speed_rpm"]
    assert document["states_found"] >= 1


def test_states_are_told_apart_by_their_intervals():
    def end(speed, width):
        return SimpleNamespace(cage_speed=speed, cage_interval=width)

    ends = [end(300.0, 0.05), end(300.05, 0.1), end(301.2, 0.2), end(300.1, 0.01)]
    assert [len(state) for state in states(ends)] == [3, 1]
    assert [len(state) for state in states(ends[:1])] == [1]
    assert states([]) == []


def test_the_table_of_a_shipped_case_serves_its_simulation():
    """Found from any folder; friction of solved films, drag of balls in oil, no table built."""
    case = load_case("7008_oil")
    model = build_model(case, None, lambda *done: None)
    assert model.friction.inner.range.load == (1.0, 150.0)
    assert model.friction.inner.converged
    assert model.friction.outer.converged
    speed = 2187.0 * 3.14159 / 30.0 * 27e-3
    assert model.options.drag * speed**2 == pytest.approx(0.30, abs=0.005)


@pytest.mark.parametrize(
    ("options", "fault"),
    [
        (("--window", "1,2"), "--window: needs --animate"),
        (("--animate", "x.gif", "--window", "2,1"), "allowed: two rising times in ms up to 4"),
        (("--animate", "x.gif", "--window", "1,9"), "allowed: two rising times in ms up to 4"),
    ],
)
def test_a_window_of_an_animation_is_checked_first(tmp_path, options, fault):
    path = short(tmp_path / "case.toml", "7008_axial")
    done = run(path, "-o", str(tmp_path / "out"), *options)
    assert done.exit_code == 2
    assert fault in " ".join((done.output + done.stderr).split())


def test_a_cage_that_leaves_the_speed_of_other_commands_is_told(tmp_path):
    """A fast, lightly loaded 7012AC spins otherwise than in the equilibrium: 4646 r/min, `run` has 4405."""
    path = tmp_path / "case.toml"
    path.write_text(
        'schema_version = 1\n[bearing]\nname = "7012AC"\n[lubricant]\nname = "iso vg 32"\n'
        "[operation]\ninner_speed_rpm = 10000.0\naxial_load_N = 400.0\ntemperature_C = 60.0\n"
        '[ehl]\nfilm_maps = "none"\n[dynamics]\nend_time_s = 0.04\n'
        "[friction]\ntraction_maximum = 0.05\ntraction_maximum_slide = 0.03\ntraction_limit = 0.03\n",
        encoding="utf-8",
    )
    found = run(path, "--json", "--quiet")
    assert found.exit_code == 0, found.output
    document = json.loads(found.stdout)
    assert document["cage_speed_rpm"] > 1.02 * 4405.0
    assert any("of rolling balls in equilibrium" in message for message in document["messages"])
    assert document["gyroscopic_load_ratio"] > 0.0


def test_every_number_is_kept(folder):
    document = json.loads((folder[0] / "summary.json").read_text(encoding="utf-8"))
    with open_history(folder[0]) as history:
        kept("dynamics", {"summary": document, "history": history.load(), **SHOWN}, 1e-4)
