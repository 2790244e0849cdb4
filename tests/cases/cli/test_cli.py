"""The command as a user meets it: exit codes, streams, files."""

from __future__ import annotations

import errno
import json
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rich.console import Group
from typer.testing import CliRunner

from oilfilm.bearing.library.bearings import load_catalogue_entry
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.bearing.torque.skf import viscous_factor
from oilfilm.cases import load_case
from oilfilm.cases.cli import compute, output, terminal
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.contact import FilmSource
from oilfilm.cases.format.shipped import find_case, shipped_cases
from oilfilm.cases.runs import interrupt

AT_REST = "209_radial_8900N"  # no films: quick
OILFILM = [sys.executable, "-m", "oilfilm.cases.cli"]


def oilfilm(*words):
    return CliRunner().invoke(app, list(words))


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_version():
    answer = oilfilm("--version")
    assert answer.exit_code == 0
    assert answer.stdout.startswith("oilfilm ")


def test_validation_imports_no_kernels_and_no_pictures():
    """It is quick: what it takes of the solvers are their types of data."""
    code = (
        "import sys; from oilfilm.cases.format.document import validate_text\n"
        "from oilfilm.cases.format.shipped import shipped_cases\n"
        "for p in shipped_cases().values(): validate_text(p.read_text(), p.name)\n"
        "print([m for m in sys.argv[1:] if m in sys.modules])"
    )
    heavy = [
        "numba",
        "scipy.optimize",
        "scipy.special",
        "oilfilm.ehl.solver",
        "oilfilm.ehl.multigrid.cycle",
        "xarray",
        "matplotlib",
        "pyvista",
        "vtk",
        "rich",
    ]
    answer = subprocess.run([sys.executable, "-c", code, *heavy], capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "[]"


def test_run_writes_files_and_a_table(tmp_path):
    answer = oilfilm("run", AT_REST)
    assert answer.exit_code == 0, answer.output
    folder = tmp_path / f"{AT_REST}_results"
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["converged"] is True
    assert {"contacts.csv", "results.nc"} <= {path.name for path in folder.iterdir()}
    assert "4526" in answer.stdout
    assert max(len(line) for line in answer.stdout.splitlines()) <= 80
    assert "\x1b" not in answer.stdout
    assert "results in" in answer.stderr


def test_json_is_all_there_is_on_standard_output(tmp_path):
    answer = oilfilm("run", AT_REST, "--json")
    assert json.loads(answer.stdout)["case"]["title"]
    assert list(tmp_path.iterdir()) == []
    answer = oilfilm("run", AT_REST, "--json", "--quiet", "-o", "here")
    assert json.loads(answer.stdout) == json.loads((tmp_path / "here" / "summary.json").read_text())
    assert answer.stderr == ""


def test_numbers_first_then_what_changes_a_decision_then_notes(tmp_path):
    """Oil beyond its data, an ellipse cut by the shoulder; estimated geometry with --notes: on standard error."""
    (tmp_path / "warm.toml").write_text(
        'schema_version = 1\n[bearing]\nname = "6205"\n[lubricant]\nname = "ISO VG 68"\n[operation]\n'
        'inner_speed_rpm = 1000.0\naxial_load_N = 9000.0\ntemperature_C = 150.0\n[ehl]\nfilm_maps = "none"\n'
    )
    warnings = ("150.0 C is outside 20.0 to 100.0 C", "cuts the ellipse of balls", "beyond ISO 281")
    answer = oilfilm("run", "warm.toml")
    said = " ".join(answer.stderr.split())
    assert answer.exit_code == 0
    assert said.count("warning: ") == 3
    assert all(words in said for words in warnings)
    assert "note: " not in said and "--notes" in said
    assert answer.output.index("friction torque") < answer.output.index("warning: ")
    noted = oilfilm("run", "warm.toml", "--notes")
    told = " ".join(noted.stderr.split())
    assert told.count("note: ") >= 3
    for words in ("internal geometry is estimated", *warnings):
        assert words in told
    assert "null" not in told
    assert max(map(len, noted.stderr.splitlines())) <= 80
    document = json.loads(oilfilm("run", "warm.toml", "--json").stdout)
    assert len(document["warnings"]) == 3 and set(document["warnings"]) < set(document["messages"])
    for option in ("--quiet", "--json"):
        assert not re.search("note:|warning:", oilfilm("run", "warm.toml", option).stderr)


def test_more_than_three_warnings_are_counted(capsys):
    output.print_warnings([f"doubt {n}; what to do" for n in range(5)] + ["film: not converged: stalled"])
    shown = capsys.readouterr().err.splitlines()
    assert shown == [*(f"warning: doubt {n}" for n in range(3)), "warning: 2 more in the results (warnings)"]


def test_the_cost_counts_contacts_that_differ():
    """All balls of an axially loaded bearing are alike, those on both sides of a radial load in pairs."""
    axial, radial = load_case("7008_axial"), load_case("6208_full_ceramic")
    solved = {"film_source": FilmSource.SOLVED}
    assert output.run_films(replace(axial, film_maps="all", **solved)) == 2
    assert output.run_films(replace(radial, **solved)) == 10


def test_the_cost_counts_solved_films_only():
    case = load_case("6208_full_ceramic")
    assert output.run_films(case) == 2  # the heaviest of each race
    assert output.run_films(replace(case, film_source=FilmSource.ATLAS)) == 0


def test_the_case_of_a_result_is_a_case(tmp_path):
    """The document as run, defaults filled in, describes the same case."""
    from oilfilm.cases.format.document import check_document

    document = json.loads(oilfilm("run", AT_REST, "--json").stdout)["case"]
    file, problems = check_document(document)
    assert problems == []
    assert file.operation.tilt is None
    assert document["model"] == {"ball_kinematics": "half and half", "curvature": "operating"}
    assert document["materials"]["bearing steel"]["youngs_modulus_GPa"] == 206.0


def test_a_second_run_replaces_the_first_and_nothing_else(tmp_path):
    assert oilfilm("run", AT_REST, "-q", "-o", "out").exit_code == 0
    (tmp_path / "out" / "notes.txt").write_text("mine")
    assert oilfilm("run", AT_REST, "-q", "-o", "out").exit_code == 0
    assert (tmp_path / "out" / "notes.txt").read_text() == "mine"
    (tmp_path / "foreign").mkdir()
    (tmp_path / "foreign" / "summary.json").write_text("mine")
    answer = oilfilm("run", AT_REST, "-q", "-o", "foreign")
    assert answer.exit_code == 2
    assert "not written by oilfilm" in answer.stderr


def test_contact_by_finite_elements(tmp_path):
    text = find_case("moes_20_10").read_text(encoding="utf-8").replace("points = 257", "points = 129")
    (tmp_path / "small.toml").write_text(text, encoding="utf-8")
    answer = oilfilm("contact", "small.toml", "--method", "finite-element", "--json", "-o", "out")
    assert answer.exit_code == 0
    document = json.loads(answer.stdout)
    lines_x, lines_y = document["points"]
    assert 49 <= lines_x <= 81  # asked for 65; halving makes it differ by up to a quarter
    assert 49 <= lines_y <= 81  # likewise
    assert document["residual"] < 1e-6
    assert abs(document["mass_imbalance"]) < 1e-6
    assert any("pressure of the multigrid" in message for message in document["messages"])
    assert document["converged"]
    assert document["film_central_dimensionless"] == pytest.approx(0.4309, rel=0.01)
    assert any("Newton" in message for message in document["messages"])
    assert (tmp_path / "out" / "plots" / "contact.png").exists()


BAD_INPUT = [
    (["run", "6208_ful_ceramic"], "did you mean '6208_full_ceramic'?"),
    (["run", "."], "is a directory"),
    (["run", "no/such/file.toml"], "no such file"),
    (["run", "x" * 5000], "not a usable file name"),
    (["run", "moes_20_10"], "oilfilm contact moes_20_10"),
    (["contact", AT_REST], f"oilfilm run {AT_REST}"),
    (["contact", "moes_20_10", "--method", "magic"], "multigrid"),
    (["run", AT_REST, "--workers", "0"], "workers"),
    (["run", AT_REST, "-o", "file"], "is not a directory"),
    (["view", "nowhere"], "no such directory"),
    (["list", "balls"], "bearings"),
    (["nonsense"], "nonsense"),
]


@pytest.mark.parametrize(("words", "expected"), BAD_INPUT, ids=[" ".join(words)[:40] for words, _ in BAD_INPUT])
def test_bad_input(words, expected, tmp_path):
    (tmp_path / "file").write_text("")
    answer = oilfilm(*words)
    assert answer.exit_code == 2
    assert expected in answer.stderr
    assert answer.stdout == ""
    assert "Traceback" not in answer.output


@pytest.mark.parametrize(
    ("content", "expected"),
    [(b"", ":1: the file is empty"), (b"\x00\xff\xfe\x80", "not a text file"), (b"a = \n", ":1: not valid TOML")],
)
def test_unusable_files(content, expected, tmp_path):
    (tmp_path / "case.toml").write_bytes(content)
    for command in ("run", "contact", "validate"):
        answer = oilfilm(command, "case.toml")
        assert answer.exit_code == 2
        assert f"case.toml{expected}" in answer.stderr or f"case.toml: {expected}" in answer.stderr


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root reads everything")
def test_an_unreadable_file(tmp_path):
    (tmp_path / "case.toml").write_text("a = 1")
    (tmp_path / "case.toml").chmod(0)
    answer = oilfilm("run", "case.toml")
    assert answer.exit_code == 2
    assert "Permission denied" in answer.stderr


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes of POSIX")
def test_a_named_pipe_does_not_hang(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    answer = oilfilm("validate", "pipe.toml")
    assert answer.exit_code == 2
    assert "not a regular file" in answer.stderr


def test_validate_shows_every_error_with_its_line(tmp_path):
    text = shipped_cases()[AT_REST].read_text().replace("balls = 9", "ball = 9").replace("points", "point")
    (tmp_path / "case.toml").write_text(text.replace("8900.0", "nan"))
    answer = oilfilm("validate", "case.toml", AT_REST)
    assert answer.exit_code == 2
    assert answer.stdout == f"{AT_REST}: valid\n"
    assert "bearing.ball: unknown key; did you mean 'balls'?" in answer.stderr
    assert "operation.radial_load_N: found nan" in answer.stderr
    report = json.loads(oilfilm("validate", "case.toml", AT_REST, "--json").stdout)
    assert report[AT_REST] == {"valid": True, "errors": []}
    assert len(report["case.toml"]["errors"]) == 2


def test_validation_and_run_say_the_same_of_two_laws_of_friction(tmp_path):
    """`--quiet` and JSON have errors only."""
    text = find_case("7008_radial").read_text(encoding="utf-8")
    law = text.replace("[friction]\n", '[friction]\ntraction = "four constants"\ncoefficient = 0.05\n')
    text = law.replace("[dynamics]\n", '[dynamics]\nfriction = "coulomb"\n')
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    answer = oilfilm("validate", "case.toml")
    assert answer.exit_code == 0
    notes = " ".join(answer.stderr.split())
    assert 'note: two laws of friction: friction.traction = "four constants" in traction equilibrium' in notes
    assert notes == " ".join(f"note: {note}" for note in load_case("case.toml").file.notes)
    assert oilfilm("validate", "case.toml", "--quiet").stderr == ""
    assert oilfilm("validate", "case.toml", "--json").stderr == ""


def test_init_writes_a_valid_case_once(tmp_path):
    assert oilfilm("init", "mine").exit_code == 0
    assert oilfilm("validate", "mine.toml").exit_code == 0
    answer = oilfilm("init", "mine")
    assert answer.exit_code == 2
    assert "exists already" in answer.stderr
    assert oilfilm("init", "other", "--from", "moes_20_10").exit_code == 0
    assert "moes_M" in (tmp_path / "other.toml").read_text()
    assert oilfilm("init", "no/such/folder/case").exit_code == 2
    silent = oilfilm("init", "silent", "--quiet")
    assert (silent.exit_code, silent.output) == (0, "")
    assert json.loads(oilfilm("init", "third", "--json").stdout) == {"file": "third.toml", "messages": []}


@pytest.mark.parametrize(
    "kind", ["cases", "bearings", "materials", "lubricants", "media", "dry_surfaces", "greases", "typical"]
)
def test_list(kind):
    names = json.loads(oilfilm("list", kind, "--json").stdout)[kind]
    listed = oilfilm("list", kind).stdout
    assert names
    assert all(name in listed for name in names)


def test_schema_describes_every_shipped_case():
    schema = json.loads(oilfilm("schema").stdout)
    assert schema["$schema"].startswith("https://json-schema.org/")
    assert {"BearingFile", "ContactFile"} <= schema["$defs"].keys()


@pytest.mark.parametrize(
    ("error", "expected"),
    [
        (OSError(errno.ENOSPC, "No space left on device", "x.nc"), "x.nc: No space left on device"),
        (MemoryError(), "out of memory"),
        (KeyError("surprise\nwith a line"), "internal error: KeyError: 'surprise"),
    ],
)
def test_a_failure_of_the_machine_is_one_line_and_a_log(error, expected, monkeypatch, tmp_path):
    def fail(*_args, **_kwargs):
        raise error

    monkeypatch.setattr(compute, "save", fail)
    answer = oilfilm("run", AT_REST, "-o", "out")
    assert answer.exit_code == 4
    assert expected in answer.stderr
    assert len(answer.stderr.splitlines()) == 1
    log = Path(answer.stderr.split("details: ")[1].strip())
    assert "Traceback" in log.read_text()
    log.unlink()


def test_not_converged_is_written_flagged_and_told(monkeypatch, tmp_path):
    import dataclasses

    from oilfilm.bearing import solve_quasistatic as solve

    def fail(*arguments, **options):
        solved = solve(*arguments, **options)
        return dataclasses.replace(solved, converged=False, message="the load exceeds every capacity")

    monkeypatch.setattr("oilfilm.cases.runs.equilibrium.solve_quasistatic", fail)
    answer = oilfilm("run", AT_REST, "-o", "out", "--quiet")
    assert answer.exit_code == 1
    assert "the load exceeds every capacity" in answer.stderr
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["converged"] is False


def test_interrupted(monkeypatch):
    def interrupt(*_args, **_kwargs):
        raise KeyboardInterrupt

    monkeypatch.setattr("oilfilm.cases.runs.bearing.run_case", interrupt)
    answer = oilfilm("run", AT_REST)
    assert answer.exit_code == 3
    assert answer.stderr == "oilfilm: interrupted\n"


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_a_signal_ends_a_command_with_code_3(name, tmp_path):
    code = "import time; from oilfilm.cases.cli.terminal import exit_code; print('up', flush=True); "
    code += "import sys; sys.exit(exit_code(lambda: time.sleep(30)))"
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout.readline() == b"up\n"
        time.sleep(0.2)
        process.send_signal(getattr(signal, name))
        _, errors = process.communicate(timeout=20)
    assert process.returncode == 3
    assert errors == b"oilfilm: interrupted\n"


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_results_are_finished_before_an_interrupt_is_obeyed():
    steps = []

    def work():
        with interrupt.finish_first("results"):
            os.kill(os.getpid(), signal.SIGINT)
            steps.append("finished")
        steps.append("not reached")

    assert terminal.exit_code(work) == 3
    assert steps == ["finished"]

    def stubborn():
        with interrupt.finish_first("results"):
            os.kill(os.getpid(), signal.SIGINT)
            os.kill(os.getpid(), signal.SIGINT)
            steps.append("not reached")

    assert terminal.exit_code(stubborn) == 3
    assert steps == ["finished"]


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of POSIX")
def test_a_closed_pipe_is_no_error():
    answer = subprocess.run(
        ["sh", "-c", f"{' '.join(OILFILM)} schema | head -n 1"], capture_output=True, text=True, check=False
    )
    assert answer.stdout == "{\n"
    assert answer.stderr == ""


def test_errors_of_a_file_of_garbage_are_shortened(capsys):
    terminal._print_errors([f"line {i}" for i in range(100)])
    errors = capsys.readouterr().err.splitlines()
    assert len(errors) == terminal.MOST_MESSAGES + 1
    assert errors[-1] == "... and 80 more errors"


def test_only_what_did_not_converge_is_listed_as_such(capsys):
    told = ["inner race, ball 1: not converged: film changed by 1e-3", "equilibrium of ring and balls: none found"]
    others = [
        "outer race, ball 1: converged but unresolved",
        "life: null, there is no equilibrium",
        "torque_N_mm: null",
    ]
    document = {"converged": False, "messages": [*told, *others]}
    assert output.report(document, Group, None, False, True) == 1
    assert capsys.readouterr().err.splitlines()[1:] == [f"  {message}" for message in told]


@pytest.mark.parametrize(
    "options",
    [
        ("--bearing", "7014C"),
        ("--bearing", "6205-2RS C3"),
        ("--bearing", "6205-2RS", "C3", "/P5"),
        ("--bearing", "7208 BDBA/P5"),
        ("--bearing", "61808 hybrid"),
        ("--bore", "28", "--outside", "58", "--width", "16"),
        ("--bore", "28", "--outside", "58", "--width", "16", "--C", "16.6", "--C0", "9.5"),
        ("--bore", "28", "--outside", "58", "--width", "16", "--angle", "25", "--C", "18"),
    ],
)
def test_init_by_designation_or_size_writes_a_valid_case(options, tmp_path):
    assert oilfilm("init", "mine", *options).exit_code == 0
    assert oilfilm("validate", "mine.toml").exit_code == 0
    text = (tmp_path / "mine.toml").read_text(encoding="utf-8")
    assert "ball_diameter_mm = " in text
    assert text.count("# estimated, ") >= 6
    assert load_case(str(tmp_path / "mine.toml")).bearing.balls > 5


def written(folder, *options):
    """Case file that `oilfilm init` writes, parsed."""
    assert oilfilm("init", "new", *options).exit_code == 0
    path = folder / "new.toml"
    document = tomllib.loads(path.read_text(encoding="utf-8"))
    path.unlink()
    return document


def test_a_new_case_is_laid_out_for_its_speed(tmp_path):
    slow = written(tmp_path, "--bearing", "6208", "--speed", "3000")
    spindle = written(tmp_path, "--bearing", "7014C")
    fast = written(tmp_path, "--bearing", "6208", "--speed", "36000", "--radial", "500", "--axial", "200")
    assert slow["friction"]["lubrication"] == "oil bath"
    assert slow["friction"]["oil_level_mm"] == 0.5 * slow["bearing"]["ball_diameter_mm"]
    assert spindle["friction"]["lubrication"] == "oil air"
    assert not {"oil_fraction", "cooling_oil_mL_min"} & set(spindle["friction"])
    assert fast["friction"]["lubrication"] == "oil jet"
    assert [fast["operation"][key] for key in ("inner_speed_rpm", "radial_load_N", "axial_load_N")] == [36e3, 500, 200]
    grades = [int(case["lubricant"]["name"].removeprefix("iso vg ")) for case in (slow, fast)]
    assert grades[0] > grades[1]
    assert {"friction.cooling_oil_mL_min", "friction.cooling_oil_C", "friction.oil_fraction"} <= set(fast["assumed"])
    one, two = (
        written(tmp_path, "--bearing", name, "--speed", "24000")["friction"]["cooling_oil_mL_min"]
        for name in ("7014C", "7014CDB")
    )
    assert two == pytest.approx(2.0 * one, rel=0.05)


def test_loads_and_speed_that_were_not_given_say_so(tmp_path):
    """An axial load alone is one, as of a vertical shaft; angular contact keeps its axial load beside a radial one."""

    def lines(*options):
        assert oilfilm("init", "new", *options).exit_code == 0
        text = (tmp_path / "new.toml").read_text(encoding="utf-8")
        (tmp_path / "new.toml").unlink()
        return [line for line in text.splitlines() if line.startswith(("inner_speed", "radial_load", "axial_load"))]

    rated = 1e3 * written(tmp_path, "--bearing", "6208")["bearing"]["basic_dynamic_rating_kN"]
    speed, radial, axial = lines("--bearing", "6208")
    assert speed.endswith("  # chosen")
    assert radial == f"radial_load_N = {round(0.05 * rated, -2)!r}  # chosen: 5% of C"
    assert axial == "axial_load_N = 0.0"
    given = lines("--bearing", "6208", "--speed", "500", "--axial", "900")
    assert given == ["inner_speed_rpm = 500.0", "radial_load_N = 0.0", "axial_load_N = 900.0"]
    assert lines("--bearing", "7208B", "--radial", "700")[2].endswith("  # chosen: 4% of C")
    assert lines("--bearing", "7208B", "--axial", "700")[1:] == ["radial_load_N = 0.0", "axial_load_N = 700.0"]


def test_the_flow_of_a_jet_takes_the_heat_of_palmgrens_viscous_torque(tmp_path):
    """By hand: VG 15 at 70 C, f_0 6.6, d_m 90 mm, 24 000 r/min; 20 K."""
    case = written(tmp_path, "--bearing", "7014C", "--speed", "24000")
    assert case["lubricant"]["name"] == "iso vg 15"
    oil = load_lubricant("iso vg 15", 343.15)
    product = oil.viscosity / oil.density * 1e6 * 24000.0
    heat = 6.6e-7 * product ** (2 / 3) * 90.0**3 * 1e-3 * 24000.0 * np.pi / 30.0
    flow = heat / (oil.density * oil.thermal.specific_heat * 20.0)
    assert case["friction"]["cooling_oil_mL_min"] == pytest.approx(flow * 6e7, rel=0.05)


def test_ratings_and_a_measured_frequency_with_a_designation(tmp_path):
    answer = oilfilm("init", "rated", "--bearing", "7014C", "--C", "47", "--C0", "43")
    assert answer.exit_code == 0, answer.output
    assert "come into question" in answer.stderr
    case = load_case(tmp_path / "rated.toml")
    assert case.rating.dynamic_rating == 47e3
    assert "bearing.balls" in case.assumed
    assert oilfilm("init", "measured", "--bearing", "7014C", "--bpfo-per-turn", "9.2").exit_code == 0
    assert load_case(tmp_path / "measured.toml").bearing.balls == 21


def test_the_name_of_a_new_case_is_no_preload_class(tmp_path):
    assert oilfilm("init", "L", "--bearing", "7014C DB").exit_code == 0
    assert 'name = "7014C DB"' in (tmp_path / "L.toml").read_text(encoding="utf-8")


def test_the_oil_of_a_small_bearing_suits_its_temperature(tmp_path):
    """150 mm2/s would be kappa = 2 at 70 C; it runs at little above 25 C."""
    assert oilfilm("init", "small", "--bearing", "608", "--speed", "3000").exit_code == 0
    oil = load_case(tmp_path / "small.toml").document["lubricant"]["name"]
    assert oil in ("iso vg 32", "iso vg 46", "iso vg 68")


def test_no_plugins_are_an_empty_list():
    answer = oilfilm("list", "plugins")
    assert answer.exit_code == 0, answer.output


def test_a_file_in_place_of_a_folder_is_named(tmp_path):
    (tmp_path / "measured.csv").write_text("1,2\n", encoding="utf-8")
    (tmp_path / "results").mkdir()
    for words in (
        ("compare", "measured.csv", "measured.csv"),
        ("compare", "measured.csv", "results"),
        ("cut", "measured.csv"),
    ):
        answer = oilfilm(*words)
        assert answer.exit_code == 2
        assert "measured.csv: is a file; allowed: a directory of results" in answer.stderr


def test_a_new_case_has_normal_clearance_where_a_study_has_none(tmp_path):
    assert load_catalogue_entry("6206")["diametral_clearance_um"] == 0.0
    bearing = written(tmp_path, "--bearing", "6206")["bearing"]
    assert (bearing["clearance_class"], bearing["diametral_clearance_um"]) == ("CN", 12.5)
    assert written(tmp_path, "--bearing", "6206 C4")["bearing"]["clearance_class"] == "C4"
    assert written(tmp_path, "--bearing", "7000C")["bearing"]["width_mm"] == 8.0


def test_suffixes_need_no_quotes_and_the_source_names_one_clearance(tmp_path):
    case = written(tmp_path, "--bearing", "6205-2RS", "C3")
    assert case == written(tmp_path, "--bearing", "6205-2RS C3")
    assert case["bearing"]["clearance_class"] == "C3"
    assert case["source"].count("clearance: ") == 1


def test_a_tandem_set_gets_no_preload_of_its_own(tmp_path):
    assert "preload_class" not in written(tmp_path, "--bearing", "7014AC", "DT", "H")["rows"][0]
    assert written(tmp_path, "--bearing", "7014AC", "DB", "H")["rows"][0]["preload_class"] == "heavy"


def test_loads_heat_and_oil_of_a_new_case_by_hand(tmp_path):
    """4 % of C axially and 2 % radially; 320 W/m2K through pi B (d + D); Parker's share of oil of each row."""
    case = written(tmp_path, "--bearing", "7014C", "--speed", "24000")
    rating, loads = 1e3 * case["bearing"]["basic_dynamic_rating_kN"], case["operation"]
    assert loads["axial_load_N"] == pytest.approx(0.04 * rating, rel=0.05)
    assert loads["radial_load_N"] == pytest.approx(0.02 * rating, rel=0.05)
    area = np.pi * 20e-3 * (70e-3 + 110e-3)
    assert case["friction"]["heat_transfer_W_K"] == pytest.approx(320.0 * area, rel=5e-3)
    for name, rows in (("7014C", 1), ("7014CDB", 2)):
        one = written(tmp_path, "--bearing", name, "--speed", "24000")
        flow, pitch = one["friction"]["cooling_oil_mL_min"], one["bearing"]["pitch_diameter_mm"]
        share = 1e5 * (flow / rows) ** 0.37 / (24000.0 * pitch**1.7)
        assert one["friction"]["oil_fraction"] == pytest.approx(share, rel=0.05)
    oil, pitch = load_lubricant(case["lubricant"]["name"], 343.15), case["bearing"]["pitch_diameter_mm"]
    product = 1e6 * oil.viscosity / oil.density * 24000.0  # nu n [mm^2/s r/min]
    torque = 1e-3 * viscous_factor("angular contact", "oil jet") * 1e-7 * product ** (2.0 / 3.0) * pitch**3  # [N m]
    flow = torque * 24000.0 * np.pi / 30.0 / (oil.density * oil.thermal.specific_heat * 20.0)  # by 20 K
    assert case["friction"]["cooling_oil_mL_min"] == pytest.approx(60e6 * flow, rel=0.05)


def test_a_shielded_bearing_runs_on_grease(tmp_path):
    case = written(tmp_path, "--bearing", "6200-2Z")
    assert "grease" in case["lubricant"]
    assert "oil_level_mm" not in case["friction"]


def test_the_name_may_stand_behind_the_designation(tmp_path):
    assert oilfilm("init", "--bearing", "6205", "C3", "m3").exit_code == 0
    behind = tomllib.loads((tmp_path / "m3.toml").read_text(encoding="utf-8"))
    assert behind["bearing"]["clearance_class"] == "C3"
    assert oilfilm("init", "--bearing", "6205", "pump").exit_code == 0  # P, U, M, P would be suffixes without effect
    assert tomllib.loads((tmp_path / "pump.toml").read_text(encoding="utf-8"))["title"] == "6205"
    missing = oilfilm("init", "--bearing", "6205", "C3")
    assert (missing.exit_code, (tmp_path / "C3.toml").exists()) == (2, False)
    assert "C3 belongs to the designation, NAME is missing" in " ".join(missing.stderr.split())


def test_a_set_of_two_gives_off_heat_by_two_widths(tmp_path):
    oilfilm("init", "one", "--bearing", "7014C")
    oilfilm("init", "two", "--bearing", "7014CDB")
    one, two = (
        tomllib.loads((tmp_path / name).read_text(encoding="utf-8"))["friction"] for name in ("one.toml", "two.toml")
    )
    assert two["heat_transfer_W_K"] == pytest.approx(2.0 * one["heat_transfer_W_K"], rel=5e-3)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (("--bearing", "7208"), "'7208' is unknown: the letters of its contact angle"),
        (("--bearing", "7206A"), "oilfilm init NAME --bore 30 --outside 62 --width 16 [mm], with --angle 30"),
        (("--bearing", "FAG 6205XX"), "oilfilm init NAME --bore 25 --outside 52 --width 15 [mm]"),
        (("--bearing", "7014C", "banana"), "'7014C banana' is unknown: 'BANANA' in it is not known"),
        (("--bearing", "16108"), "'16108' is unknown: a bearing of the series 161"),
        (("--bearing", "NU205"), "'NU205' is unknown: a cylindrical roller bearing"),
        (("--bearing", "32008"), "'32008' is unknown: a tapered roller bearing"),
        (("--bearing", "HS7010"), "a high-speed bearing with smaller balls"),
        (("--bearing", "xyz"), "--bore 25 --outside 47 --width 8 [mm]"),
        (("--bearing", "209"), "'209': its source gives no width; a bearing by its size"),
        (("--bearing", "6205", "--speed", "-3"), "--speed: found -3; allowed: above 0"),
        (("--bearing", "6205", "--axial", "nan"), "--axial: found nan; allowed: a finite number"),
        (("C3",), "C3 after NAME without --bearing"),
        (("--bearing", "6205", "C3", "xyz"), "'6205 C3 xyz' is unknown"),
        (("--speed", "3000"), "--speed without --bearing or --bore"),
        (("--bore", "28"), "--bore without --outside, --width"),
        (("--bearing", "6205", "--from", "moes_20_10"), "--from and --bearing together"),
        (("--C", "12"), "--C without --bore"),
        (("--bearing", "6205", "--C", "-12"), "--C: found -12; allowed: above 0"),
        (("--bearing", "6205", "--bpfo-per-turn", "9"), "9 passages of balls a turn, which no balls have"),
        (("--bore", "58", "--outside", "28", "--width", "16"), "--outside: found 28 mm; allowed: above --bore, 58 mm"),
        (
            ("--bore", "28", "--outside", "58", "--width", "16", "--angle", "90"),
            "--angle: found 90 deg; allowed: from 0",
        ),
        (("--bore", "28", "--outside", "58", "--width", "0"), "--width: found 0; allowed: above 0"),
        (("--bore", "28", "--outside", "58", "--width", "16", "--C", "-1"), "--C: found -1; allowed: above 0"),
        (("--bearing", "6205", "--speed", "1e9"), "operation.inner_speed_rpm: found 1000000000.0; allowed: a number"),
        (("--bearing", "6205", "--radial", "1e12"), "operation.radial_load_N: found 1000000000000.0; allowed: "),
        (("--bore", "200", "--outside", "280", "--width", "40"), "bore must lie between"),
    ],
)
def test_init_refuses_what_makes_no_bearing(options, expected, tmp_path):
    answer = oilfilm("init", "mine", *options)
    assert answer.exit_code == 2
    assert expected in " ".join(answer.stderr.split())
    assert not (tmp_path / "mine.toml").exists()


@pytest.mark.parametrize(
    ("words", "change"),
    [
        ("report out", {"contacts": 3}),
        ("compare out out", {"contacts": [{"ball": None}]}),
        ("report out", {"messages": {"a": [1]}, "ring": "x"}),
        ("compare out out", {"case": [1, 2], "balls": [7]}),
    ],
)
def test_damaged_results_are_bad_input(words, change, tmp_path):
    assert oilfilm("run", AT_REST, "-o", "out", "-q").exit_code == 0
    path = tmp_path / "out" / "summary.json"
    document = json.loads(path.read_text())
    path.write_text(json.dumps(document | change))
    answer = oilfilm(*words.split())
    assert answer.exit_code in (0, 2)
    assert "summary.json: damaged, not as it was written" in answer.stderr or "changed since" in answer.stderr


def test_a_number_that_was_changed_is_told(tmp_path):
    assert oilfilm("run", AT_REST, "-o", "out", "-q").exit_code == 0
    path = tmp_path / "out" / "summary.json"
    assert oilfilm("report", "out").stderr == f"report in {Path('out/report.html')}\n"
    path.write_text(path.read_text().replace("6", "7"))
    answer = oilfilm("report", "out", "--json")
    assert answer.exit_code == 0
    assert json.loads(answer.stdout) == {"files": [str(Path("out/report.html"))]}
    assert f"{Path('out/summary.json')}: changed since it was written" in answer.stderr


def test_validation_refuses_what_a_run_refuses(tmp_path):
    """Also what only the conversion to a case finds."""
    from oilfilm.cases.format.shipped import shipped_cases as cases

    text = cases()["6208_full_ceramic"].read_text(encoding="utf-8")
    (tmp_path / "case.toml").write_text(text.replace("temperature_C = 40.0", "temperature_C = -300.0"))
    checked, run = oilfilm("validate", "case.toml"), oilfilm("run", "case.toml", "-o", "out")
    assert (checked.exit_code, checked.stderr) == (run.exit_code, run.stderr)


READERS = (
    "validate",
    "run",
    "batch",
    "import",
    "view",
    "report",
    "compare",
    "export --format xlsx",
    "init --bearing 6208",
)


@pytest.mark.parametrize("command", READERS)
def test_the_name_of_a_file_breaks_no_message(command, tmp_path, monkeypatch):
    """Ends of lines and control characters in a name are written out: one line on one of the streams."""
    monkeypatch.chdir(tmp_path)
    name, *options = command.split()
    answer = CliRunner().invoke(app, [name, *["a\nb\r\x1b[2J"] * (1 + (name == "compare")), *options])
    assert answer.exit_code == (0 if name == "init" else 2)
    shown = answer.stderr + answer.stdout
    assert shown.count("\n") == 1
    assert "a\\nb\\r\\x1b[2J" in shown
