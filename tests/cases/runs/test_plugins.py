"""Plug-ins: oils of a distribution that is installed beside the product."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys

import numpy as np
import pytest

from oilfilm.bearing.library import plugins
from oilfilm.bearing.library.lubricants import _of_plugin as checked_oil
from oilfilm.bearing.library.lubricants import list_lubricants, load_lubricant
from oilfilm.cases.batch.keys import program_digest
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError

MODULE = """
from math import exp


def fixed(value, at=313.15, **more):
    return {"law": "linear", "value": value, "slope": 0.0, "reference_K": at, "source": "made up"} | more


def maker_oil():
    return {
        "range_C": [0.0, 120.0],
        "viscosity": {"law": lambda t: 0.03 * exp(-0.03 * (t - 313.15)), "source": "made up"},
        "pressure_viscosity": {"law": "table", "temperature_K": [313.15, 373.15], "value": [20e-9, 15e-9],
                               "source": "made up"},
        "density": {"law": "expansion", "value": 870.0, "expansion_1_K": 6.5e-4, "reference_K": 298.15,
                    "source": "made up"},
        "conductivity": fixed(0.14),
        "specific_heat": fixed(2000.0),
    }


def half_oil():
    return {key: value for key, value in maker_oil().items() if key != "density"}


def leaving_oil():
    raise SystemExit(0)


def failing_oil():
    raise ZeroDivisionError("no such oil")
"""
POINTS = """[oilfilm.oils]
Maker 32 = oilfilm_dummy:maker_oil
half = oilfilm_dummy:half_oil
failing = oilfilm_dummy:failing_oil
leaving = oilfilm_dummy:leaving_oil
absent = oilfilm_dummy:absent_oil
number = oilfilm_dummy:POINTS
broken = oilfilm_absent:oil
"""


def install(folder, points=POINTS, name="oilfilm-dummy", version="1.2"):
    """A distribution as pip installs it: a module and its metadata."""
    (folder / "oilfilm_dummy.py").write_text(MODULE + "POINTS = 3\n")
    info = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
    (info / "entry_points.txt").write_text(points)
    return folder


def forget():
    importlib.invalidate_caches()
    for cached in (plugins.plugins, plugins.plugin_oil, checked_oil, program_digest):
        cached.cache_clear()


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """The dummy distribution, for this process."""
    monkeypatch.syspath_prepend(install(tmp_path))
    monkeypatch.delitem(sys.modules, "oilfilm_dummy", raising=False)
    forget()
    yield tmp_path
    sys.modules.pop("oilfilm_dummy", None)
    forget()


def case_text(friction="", oil='name = "Maker 32"'):
    return f"""schema_version = 1
[bearing]
name = "6208"
[lubricant]
{oil}
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 2000.0
axial_load_N = 500.0
temperature_C = 50.0
[ehl]
film_maps = "none"
{friction}
"""


def test_nothing_is_imported_before_it_is_used(installed):
    assert plugins.plugin_names("oils") == ("Maker 32", "absent", "broken", "failing", "half", "leaving", "number")
    case_from_text(case_text(oil='name = "ISO VG 32"'), "case.toml")
    assert "oilfilm_dummy" not in sys.modules


def test_an_oil_by_name_at_the_temperature_of_the_case(installed):
    assert "Maker 32" in list_lubricants()
    case = case_from_text(case_text(oil='name = "maker-32"'), "case.toml")
    assert case.lubricant.name == "Maker 32"
    assert case.lubricant.viscosity == pytest.approx(0.03 * np.exp(-0.3))
    assert case.lubricant.thermal.viscosity_temperature == pytest.approx(0.03)
    assert load_lubricant("Maker 32", 373.15).pressure_viscosity == pytest.approx(15e-9)


@pytest.mark.parametrize(
    ("oil", "reason"),
    [
        ("half", r"plug-in 'half' .*oilfilm_dummy:half_oil\): has no density"),
        ("absent", r"plug-in 'absent' \(oilfilm.oils, oilfilm-dummy 1.2, oilfilm_dummy:absent_oil\): cannot be "
         r"loaded: AttributeError"),
        ("broken", r"plug-in 'broken' .*: cannot be loaded: ModuleNotFoundError: No module named 'oilfilm_absent'"),
        ("failing", r"plug-in 'failing' .*: failed: ZeroDivisionError: no such oil"),
        ("leaving", r"plug-in 'leaving' .*: failed: SystemExit: 0"),
        ("number", r"plug-in 'number' .*: gives int, and a dictionary is needed"),
        ("Maker 33", r"unknown name .Maker 33.; did you mean 'Maker 32'"),
    ],
)  # fmt: skip
def test_the_message_names_the_plug_in_and_its_fault(installed, oil, reason):
    with pytest.raises(CaseError, match=reason):
        case_from_text(case_text(oil=f'name = "{oil}"'), "case.toml")


@pytest.mark.parametrize(
    "key", ['traction = "ramp"', "traction_constants = { largest = 0.06 }", 'torque_plugins = ["a"]']
)
def test_laws_of_friction_and_torque_models_of_plug_ins_are_refused(key):
    with pytest.raises(CaseError, match=r"case.toml:14: friction\."):
        case_from_text(case_text(f"[friction]\n{key}", 'name = "ISO VG 32"'), "case.toml")


def test_one_name_of_two_distributions_is_refused(installed):
    install(installed, "[oilfilm.oils]\nMaker 32 = oilfilm_dummy:maker_oil\n", "other")
    forget()
    with pytest.raises(CaseError, match=r"plug-in 'Maker 32' .*of several distributions: oilfilm-dummy 1.2, other 1.2"):
        case_from_text(case_text(), "case.toml")


def test_results_of_another_plug_in_have_other_names(installed):
    before = program_digest()
    (installed / "oilfilm_dummy.py").write_text(MODULE.replace("0.03", "0.04"))
    forget()
    assert program_digest() != before


def oilfilm(folder, *words):
    paths = os.pathsep.join((str(folder), os.environ["PYTHONPATH"]))
    return subprocess.run(
        [sys.executable, "-m", "oilfilm.cases.cli", *words], cwd=folder, env=os.environ | {"PYTHONPATH": paths},
        capture_output=True, text=True, check=False,
    )  # fmt: skip


@pytest.mark.slow
def test_the_command_lists_and_runs_them(tmp_path):
    install(tmp_path)
    told = oilfilm(tmp_path, "list", "plugins", "--json")
    listed = json.loads(told.stdout)["plugins"]
    assert listed["Maker 32"] == "oils: oilfilm-dummy 1.2, oilfilm_dummy:maker_oil"
    assert "cannot be loaded: ModuleNotFoundError" in listed["broken"]
    (tmp_path / "case.toml").write_text(case_text())
    run = oilfilm(tmp_path, "run", "case.toml", "--json")
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout)["torque_N_mm"]["total"] > 0.0
    (tmp_path / "case.toml").write_text(case_text(oil='name = "failing"'))
    run = oilfilm(tmp_path, "run", "case.toml", "-q")
    assert run.returncode == 2
    assert "plug-in 'failing' (oilfilm.oils, oilfilm-dummy 1.2" in run.stderr.splitlines()[-1]
    assert "Traceback" not in run.stderr
