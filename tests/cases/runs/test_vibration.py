"""Command vibration: a whole run, its files, and input that cannot be computed."""

from __future__ import annotations

import json
import wave

import numpy as np
import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.quasistatic.solution import bearing_frequencies
from oilfilm.bearing.vibration.assembly import assembled
from oilfilm.bearing.vibration.inputs import ContactLaw, VibrationModel, VibrationOptions, WaveFilter
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.new_case import FirstOperation, case_of_designation
from oilfilm.cases.runs.bearing import run_case
from oilfilm.cases.runs.motion_model import build_model
from oilfilm.postprocess import open_results

from ...kept import drawn, kept

CASE = """
schema_version = 1
title = "6205, pit on the inner race"
[bearing]
name = "6205"
diametral_clearance_um = 8.0
[lubricant]
name = "iso vg 100"
[operation]
inner_speed_rpm = 6000.0
radial_load_N = 200.0
axial_load_N = 100.0
temperature_C = 40.0
[form]
inner_waviness = [{ order = 10, amplitude_um = 0.05 }]
outer_waviness = [{ order = 300, amplitude_um = 0.01 }]
ball_waviness = [{ order = 2, amplitude_um = 0.02, ball = 2 }]
ball_diameter_um = [0.2, 0, 0, 0, 0, 0, 0, 0, -0.1]
defects = [{ place = "inner ring", kind = "pit", width_mm = 0.4, depth_um = 10.0, azimuth_deg = 10.0 }]
[support]
shaft_mass_kg = 1.0
seat_stiffness_N_um = 80.0
seat_damping_N_s_m = 400.0
sensor_mass_kg = 0.01
sensor_frequency_Hz = 4000.0
sensor_damping_ratio = 0.05
[vibration]
duration_s = 0.05
settling_time_s = 0.03
sample_rate_Hz = 25600.0
contact_law = "dry"
wave_filter = "dry"
loss_time_us = 2.0
"""


SHOWN = {}  # of the run in `folder`


def run(*arguments, command="vibration"):
    return CliRunner().invoke(app, [command, *arguments])


def written(folder, text):
    path = folder / "case.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("vibration")
    with drawn(as_well=True) as SHOWN["pictures"]:
        found = run(written(folder, CASE), "-o", str(folder / "out"), "--quiet")
    assert found.exit_code == 0, found.output
    return folder / "out"


@pytest.fixture(scope="module")
def document(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def test_levels_and_lines_are_those_of_the_record(folder, document):
    found = document["vibration"]
    assert found["measured"] == "sensor, y"
    assert found["reference_m_s2"] == 1e-6
    assert_allclose(found["acceleration_dB"], 20.0 * np.log10(found["acceleration_m_s2"] / 1e-6))
    assert list(found["bands_um_s"]) == ["low", "medium", "high"]
    assert found["bands_Hz"]["low"] == pytest.approx([50.0 / 0.3, 1000.0])
    sources = {line["source"] for line in found["lines"]}
    assert {"inner ring waviness", "outer ring waviness", "ball waviness", "ball diameters"} <= sources
    assert {"defect of the inner ring", "varying compliance"} <= sources
    passes = document["frequencies_Hz"]["with_slip"]
    first = next(line for line in found["lines"] if line["source"] == "defect of the inner ring")
    assert_allclose(first["frequency_Hz"], passes["ball_pass_inner"])
    with open_results(folder) as tree:
        assert tree.attrs["kind"] == "vibration"
        assert_allclose(tree["acceleration"].std(), found["acceleration_m_s2"], rtol=1e-9)
        assert tree["inner_load"].shape == (1280, 9)
    assert document["energy_balance_error"] < 1e-3
    assert document["friction_torque_N_mm"] is None  # the cage is prescribed
    assert {"shaft_m_s2", "ball_spin_twice_m_s2"} <= set(found["envelope_lines"]["with_slip"])
    assert all(peak["name"] for peak in found["envelope_peaks"] + found["peaks"])


def test_bands_that_a_record_does_not_cover_are_null(document):
    """The high band reaches 33 kHz at 6000 r/min; 25.6 kHz are sampled."""
    assert document["vibration"]["bands_um_s"]["high"] is None
    assert document["vibration"]["bands_um_s"]["medium"] > 0.0
    assert any("bands_um_s" in message and "high" in message for message in document["messages"])


def test_files_for_ears_and_eyes(folder):
    with wave.open(str(folder / "vibration.wav")) as file:
        assert (file.getframerate(), file.getnframes()) == (25600, 1280)
    names = {path.stem for path in (folder / "plots").glob("*.png")}
    assert names == {"time", "spectrum", "orders", "envelope", "waterfall", "ball_loads"}
    assert run(str(folder), "--quiet", command="report").exit_code == 0
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "anderon" in page
    assert "defect of the inner ring" in page


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("order = 300", "order = 3000"), "half of the"),
        (("ball = 2", "ball = 12"), "ball 12; allowed: up to 9"),
        (("0, -0.1]", "-0.1]"), "8 values"),
        (("shaft_mass_kg = 1.0", 'shaft_mass_kg = 1.0\ninner_ring = "held"\n#'), ""),
        (("seat_damping_N_s_m = 400.0", ""), "seat_damping_N_s_m: missing"),
        (("sensor_damping_ratio = 0.05", ""), "sensor_damping_ratio: missing"),
        (('contact_law = "dry"', ""), 'contact_law = "film"'),
        (("duration_s = 0.05", "duration_s = 0.001"), "256 samples"),
        (("inner_speed_rpm = 6000.0", "inner_speed_rpm = 0.0"), "nothing turns"),
        (("seat_stiffness_N_um = 80.0", "seat_stiffness_N_um = 0.0"), "without a hold"),
        (('kind = "pit"', 'kind = "hole"'), "kind"),
        (("loss_time_us = 2.0", "loss_time_us = 2.0\nstart_speed_rpm = 7000.0"), "below inner_speed_rpm"),
        (("[form]", '[form]\ninner_profile = "none.txt"'), "none.txt cannot be read"),
        (("[form]", '[dynamics]\nend_time_s = 0.1\nintegration = "implicit"\n[form]'), "leaves out vibration"),
    ],
)
def test_what_cannot_be_computed_is_told(tmp_path, change, words):
    text = CASE.replace(*change)
    assert text != CASE
    found = run(written(tmp_path, text), "--json", "--quiet")
    if words:
        assert found.exit_code == 2, found.output
        assert words in found.output


def test_a_spall_with_friction_and_a_free_cage(tmp_path):
    """One set of equations: the cage slips by the drag, the lines follow it, energies close, friction costs torque."""
    start, end = CASE.index("[form]"), CASE.index("[support]")
    defect = """[form]
defects = [{ place = "outer ring", kind = "spall", width_mm = 0.4, depth_um = 10.0 }]
"""
    text = CASE[:start] + defect + CASE[end:] + "[dynamics]\nend_time_s = 0.05\nball_drag_N = 0.3\n"
    found = run(written(tmp_path, text), "--json", "--quiet", command="dynamics")
    assert found.exit_code == 0, found.output
    document = json.loads(found.stdout)
    assert document["energy_balance_error"] < 1e-3
    assert 0.9 < document["cage_speed_ratio"] < 0.9999
    assert document["friction_torque_N_mm"] > 1.0
    passes = document["frequencies_Hz"]["with_slip"]
    # of the cage over the last third of the time, of the balls there, and of the balls over all of it
    assert_allclose(passes["ball_pass_outer"], 9.0 * document["cage_speed_rpm"] / 60.0, rtol=1e-3)
    first = next(line for line in document["vibration"]["lines"] if line["source"] == "defect of the outer ring")
    assert_allclose(first["frequency_Hz"], passes["ball_pass_outer"], rtol=1e-3)
    assert any("BPFO" in peak["name"] for peak in document["vibration"]["envelope_peaks"][:3])
    peaks = {peak["name"]: peak["source"] for peak in document["vibration"]["peaks"]}
    assert not [name for name, source in peaks.items() if name.endswith("*BPFO") and source == "unknown"]
    assert len(document["balls"]) == 9
    assert document["balls"][0]["outer"]["mean_load_N"] > 1.0
    again = run(written(tmp_path, text), "--json", "--quiet")
    assert again.exit_code == 0, again.output
    seen = json.loads(again.stdout)["vibration"]
    assert_allclose(seen["acceleration_m_s2"], document["vibration"]["acceleration_m_s2"], rtol=1e-6)
    refused = run(written(tmp_path, text + "starts = 3\n"), "--json", "--quiet")
    assert refused.exit_code == 2
    line = 1 + (text + "starts = 3\n").splitlines().index("starts = 3")
    assert f"case.toml:{line}: dynamics.starts" in refused.output


def test_a_simulation_from_rest_with_a_spall_keeps_its_history(tmp_path):
    """[dynamics] keys count beside [form]: start, load table, history with outer ring and sensor."""
    text = CASE + "[dynamics]\nend_time_s = 0.02\nstart = 'rest'\noutput_interval_us = 100.0\n"
    text += "speed_table_rpm = [[0.0, 0.0], [0.01, 3000.0]]\n"
    found = run(written(tmp_path, text), "-o", str(tmp_path / "out"), "--quiet", command="dynamics")
    assert found.exit_code == 0, found.output
    with open_results(tmp_path / "out") as tree:
        assert tree.sizes["time"] == 204  # every tenth of the samples of the vibration, some 98 us apart
        assert float(abs(tree["sensor_acceleration"]).max()) > 0.0
        assert tree["outer_ring_position"].sizes["axis"] == 3
    document = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert document["energy_balance_error"] < 1e-3


def test_a_simulation_with_form_is_a_vibration(tmp_path):
    """Profiles and a given response from files, the time of [dynamics], a run-up."""
    angles = np.arange(0.0, 360.0, 0.5)
    profile = np.column_stack([angles, 0.1 * np.cos(np.radians(10 * angles))])
    np.savetxt(tmp_path / "profile.txt", profile)
    np.savetxt(tmp_path / "response.txt", [[0.0, 0.0, 0.0], [100.0, 1.0, 0.0], [20000.0, 1.0, 90.0]])
    head = CASE[: CASE.index("[form]")].replace("radial_load_N = 200.0\n", "")
    text = f"""{head}
[form]
inner_profile = '{tmp_path / "profile.txt"}'
[support]
frequency_response = '{tmp_path / "response.txt"}'
[dynamics]
end_time_s = 0.04
[vibration]
settling_time_s = 0.02
sample_rate_Hz = 25600.0
contact_law = "dry"
wave_filter = "none"
loss_time_us = 2.0
start_speed_rpm = 600.0
"""
    found = run(written(tmp_path, text), "--json", "--quiet", command="dynamics")
    assert found.exit_code == 0, found.output
    document = json.loads(found.stdout)
    assert document["simulated_s"] == 0.04
    assert document["vibration"]["measured"] == "inner ring, y"
    assert document["vibration"]["bands_um_s"] == {"low": None, "medium": None, "high": None}
    assert document["vibration"]["displacement_um"] > 0.03


@pytest.mark.parametrize(("bearing", "radial", "axial"), [("6306", 900.0, 0.0), ("7205B", 400.0, 700.0)])
def test_run_vibration_and_simulation_have_one_cage_speed(bearing, radial, axial):
    """That of the loaded balls; a simulation begins with it."""
    first = FirstOperation(speed=4000.0, radial_load=radial, axial_load=axial)
    text = case_of_designation(bearing, first).replace('film_maps = "all"', 'film_maps = "none"')
    text = text.replace('temperature = "self-heated"', "") + "[dynamics]\nend_time_s = 1e-5\n"
    case = case_from_text(text, "case.toml")
    state = run_case(case).quasistatic
    contacts = contact_conditions(state, case.lubricant)
    dry = VibrationOptions(law=ContactLaw.DRY, wave_filter=WaveFilter.DRY)
    vibrating = assembled(state, contacts, VibrationModel(options=dry))
    assert vibrating.cage_speed == pytest.approx(state.cage_speed, rel=1e-12)
    run = simulation(case.bearing, case.operation, build_model(case, None, lambda *_: None))
    assert run.state.y[run.layout.cage_speed][3] == pytest.approx(state.cage_speed, rel=1e-6)
    assert bearing_frequencies(state).cage == pytest.approx(state.cage_speed / (2.0 * np.pi), rel=1e-12)


def test_every_number_is_kept(folder, document):
    files = {path.name: path for path in folder.iterdir() if path.suffix == ".nc"}
    kept("vibration", {"summary": document, "files": files, **SHOWN}, 1e-4)
