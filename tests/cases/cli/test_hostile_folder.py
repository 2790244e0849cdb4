"""Every command, given in a folder whose files bear the names of libraries and of parts of the program."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

NAMES = (
    *("postprocess", "bearing", "ehl", "cases", "numpy", "scipy", "numba", "h5py", "matplotlib", "vtk", "pyvista"),
    *("typer", "rich", "pydantic", "xarray", "xlsxwriter", "jinja2", "random", "signal", "socket", "pickle"),
    *("json", "tomllib", "logging", "sqlite3", "oilfilm", "zipfile", "xml", "meshio", "sklearn", "distributed"),
)
COMMANDS = ("--version", "validate 6208_full_ceramic")
SLOW = (  # in an order in which the earlier ones make what the later ones read
    "schema",
    "list cases",
    "hertz 6306 --radial 900",
    "frequencies 6306 --speed 1500",
    "shaft spindle_two_bearings -q -o shaft_results",
    "import drive.rexs --shaft 1 -o imported.toml",
    "init new.toml --bearing 6306",
    "film ball_on_disc",
    "run 6208_full_ceramic -q -o bearing_results",
    "report bearing_results",
    "view bearing_results --screenshot scene.png",
    "compare bearing_results bearing_results",
    "cut bearing_results -o cut.csv",
    "interferogram bearing_results -o rings.png",
    "export bearing_results --format xlsx -o numbers.xlsx",
    "stiffness 6208_full_ceramic --points 3 -q -o stiffness_results",
    "batch sweep.toml -q -o batch_results",
    "diagram batch_results -o diagram.png",
    "contact ball_on_disc -q -o contact_results",
    "slip hirano_7000C -q --workers 2 -o slip_results",
    "temperatures 6208_self_heating -q -o temperatures_results",
    "vibration 6208_waviness -q -o vibration_results",
    "table 6208_full_ceramic -q -o table.zip",
    "dynamics 7008_axial -q -o dynamics_results",
    "transient stop_and_reverse -q -o transient_results",
    "optimise 6208_torque -q -o optimise_results",
    "calibrate rig.toml measured.csv --keys friction.hysteresis_loss=0.005:0.02 -q -o fitted.toml",
    "verify --quick",
    "app --help",
)
DRIVE = Path(__file__).parents[2] / "data" / "rexs" / "SEW_3-stage_cylindrical_gearbox_1.0.rexs"
RIG = """\
schema_version = 1
[bearing]
name = "6306"
[lubricant]
name = "iso vg 68"
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 1500.0
temperature_C = 60.0
[ehl]
film_maps = "none"
"""
MEASURED = "speed [1/min];torque [N mm]\n1000;50\n2000;60\n"
SWEEP = 'case = "209_radial_8900N"\n[sweep]\n"operation.radial_load_N" = [100.0, 200.0]\n'


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    folder = tmp_path_factory.mktemp("hostile")
    for name in NAMES:
        (folder / f"{name}.py").write_text(f"open({str(folder / 'ran')!r}, 'a').write({name!r} + ' ')\n")
    (folder / "sweep.toml").write_text(SWEEP)
    (folder / "rig.toml").write_text(RIG)
    (folder / "measured.csv").write_text(MEASURED)
    shutil.copy(DRIVE, folder / "drive.rexs")
    return folder


def answer(words, folder, *options):
    """The command as `python -m`, whose first place for modules is the folder it is given in."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    command = [sys.executable, *options, "-m", "oilfilm.cases.cli", *words.split()]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def check(words, folder, *options):
    (folder / "ran").unlink(missing_ok=True)
    found = answer(words, folder, *options)
    assert not (folder / "ran").exists(), (folder / "ran").read_text()
    assert found.returncode in (0, 1), found.stderr
    assert "Traceback" not in found.stderr


@pytest.mark.parametrize("words", COMMANDS)
def test_no_file_of_the_folder_is_run(hostile, words):
    check(words, hostile, "-P")


@pytest.mark.slow
@pytest.mark.parametrize("words", SLOW)
def test_no_file_of_the_folder_is_run_by_long_commands(hostile, words):
    check(words, hostile, "-P")


def test_every_command_is_tried():
    from typer.main import get_command

    from oilfilm.cases.cli.main import app

    assert {words.split()[0] for words in (*COMMANDS, *SLOW)} - {"--version"} == set(get_command(app).commands)


def test_python_m_leaves_the_folder_too(tmp_path):
    """Once Python has found the package, for which it looks into the folder itself."""
    for name in NAMES[: NAMES.index("typer")]:
        (tmp_path / f"{name}.py").write_text("open('ran', 'w')")
    check("validate 6208_full_ceramic", tmp_path)


def test_a_library_that_is_hidden_is_told_in_one_line(tmp_path):
    (tmp_path / "numpy.py").write_text("raise SystemExit(77)")
    path = os.pathsep.join([str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])])
    command = [sys.executable, "-P", "-m", "oilfilm.cases.cli", "validate", "6208_full_ceramic"]
    found = subprocess.run(command, env=os.environ | {"PYTHONPATH": path}, capture_output=True, text=True, check=False)
    assert found.returncode == 2
    told = f"{tmp_path / 'numpy.py'} hides the library numpy; rename it, or change PYTHONPATH"
    assert found.stderr == f"oilfilm: {told}\n"
