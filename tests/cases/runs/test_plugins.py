"""Plug-ins: laws of friction, oils and torque models of a distribution that is installed beside the product."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys

import numpy as np
import pytest

from bearing.friction.sources import CoefficientTraction
from bearing.library import plugins
from bearing.library.lubricants import _of_plugin as checked_oil
from bearing.library.lubricants import library_lubricant, list_lubricants
from cases import load_case
from cases.batch.program import program_digest
from cases.format.case import case_from_text
from cases.format.problems import CaseError
from cases.runs.bearing import run_case
from postprocess import summary

MODULE = '''
from math import exp, hypot, tanh

from ehl.traction.coefficient_kernels import FourConstants
from ehl.traction.law import TractionForces


class Ramp:
    """That of docs/tutorial/extending.md, with a moment against the spin."""

    def __init__(self, largest, slope=4.0):
        self.largest, self.slope = largest, slope

    def forces(self, load, speed, slide_x, slide_y, spin):
        slide = hypot(slide_x, slide_y)
        mu = self.largest * slide / hypot(slide, self.largest / self.slope * speed)
        share = mu * load / slide if slide > 0.0 else self.slope * load / speed
        force_x, force_y = -share * slide_x, -share * slide_y
        moment = -1e-4 * self.largest * load * tanh(spin)
        loss = -force_x * slide_x - force_y * slide_y - moment * spin
        return TractionForces(force_x, force_y, moment, 0.0, loss, 0.0, 0.0, 0.0, ())


class Failing(Ramp):
    def forces(self, *state):
        raise ZeroDivisionError("no such state")


class Infinite(Ramp):
    def forces(self, *state):
        return TractionForces(*[float("inf")] * 8, ())


def curve():
    return FourConstants.of_curve(0.05, 0.03, 0.03)


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


def kilograms(solution, contacts, lubricant, friction):
    return {"load": 0.001 * 0.03 * sum(contact.load for contact in contacts)}


def nothing(solution, contacts, lubricant, friction):
    return {"load": float("nan")}
'''
POINTS = """[oilfilm.friction]
ramp = oilfilm_dummy:Ramp
curve = oilfilm_dummy:curve
failing = oilfilm_dummy:Failing
infinite = oilfilm_dummy:Infinite
absent = oilfilm_dummy:Absent
number = oilfilm_dummy:POINTS

[oilfilm.oils]
Maker 32 = oilfilm_dummy:maker_oil
half = oilfilm_dummy:half_oil

[oilfilm.torque]
kilograms = oilfilm_dummy:kilograms
nothing = oilfilm_dummy:nothing
broken = oilfilm_absent:model
"""
LAW = 'traction = "ramp"\ntraction_constants = { largest = 0.06 }\n'
FRICTION = f"[friction]\n{LAW}"


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
    assert plugins.plugin_names("friction") == ("absent", "curve", "failing", "infinite", "number", "ramp")
    case_from_text(case_text(oil='name = "ISO VG 32"'), "case.toml")
    assert "oilfilm_dummy" not in sys.modules


def test_an_oil_by_name_at_the_temperature_of_the_case(installed):
    assert "Maker 32" in list_lubricants()
    case = case_from_text(case_text(oil='name = "maker-32"'), "case.toml")
    assert case.lubricant.name == "Maker 32"
    assert case.lubricant.viscosity == pytest.approx(0.03 * np.exp(-0.3))
    assert case.lubricant.thermal.viscosity_temperature == pytest.approx(0.03)
    assert library_lubricant("Maker 32", 373.15).pressure_viscosity == pytest.approx(15e-9)


def test_a_law_of_friction_takes_its_constants_and_gives_the_torque(installed):
    case = case_from_text(case_text(FRICTION), "case.toml")
    other = case_from_text(case_text(FRICTION.replace("0.06", "0.03")), "case.toml")
    assert case.traction.source.description.startswith("plug-in 'ramp' (oilfilm.friction, oilfilm-dummy 1.2")
    torques = [run_case(one, 1).torque for one in (case, other)]
    assert torques[0].chosen == torques[1].chosen == "integrated"
    assert torques[0].total != pytest.approx(torques[1].total, rel=1e-4)
    by_hand = load_case("6208_full_ceramic")  # without the plug-in there is another law
    assert by_hand.traction is None


def test_a_coefficient_of_a_plug_in_is_that_of_the_shipped_law(installed):
    case = case_from_text(case_text('[friction]\ntraction = "curve"'), "case.toml")
    assert isinstance(case.traction.source, CoefficientTraction)
    constants = "traction_maximum = 0.05\ntraction_maximum_slide = 0.03\ntraction_limit = 0.03"
    own = case_from_text(case_text(f'[friction]\ntraction = "four constants"\n{constants}'), "case.toml")
    assert run_case(case, 1).torque.total == run_case(own, 1).torque.total


def test_a_torque_model_stands_beside_the_others(installed):
    case = case_from_text(case_text('[friction]\ntorque_plugins = ["kilograms"]'), "case.toml")
    document = summary(run_case(case, 1))
    model = document["torque_N_mm"]["models"]["kilograms"]
    loads = sum(contact["load_N"] for contact in document["contacts"])
    assert model == pytest.approx({"load": 0.03 * loads, "total": 0.03 * loads})
    assert document["case"]["friction"]["torque_plugins"] == ["kilograms"]
    plain = summary(run_case(case_from_text(case_text(), "case.toml"), 1))
    assert "kilograms" not in plain["torque_N_mm"]["models"]


@pytest.mark.parametrize(
    ("friction", "told"),
    [
        ('traction = "absent"', r"case.toml:14: friction.traction: plug-in 'absent' \(oilfilm.friction, oilfilm-dummy "
         r"1.2, oilfilm_dummy:Absent\): cannot be loaded: AttributeError"),
        ('traction = "ramp"', r"plug-in 'ramp' .* failed: TypeError: .*'largest'"),
        ('traction = "number"', r"plug-in 'number' .* failed: TypeError: 'int' object is not callable"),
        ('torque_plugins = ["broken"]', r"case.toml:14: friction.torque_plugins: plug-in 'broken' .*: cannot be "
         r"loaded: ModuleNotFoundError: No module named 'oilfilm_absent'"),
        ('torque_plugins = ["brokn"]', r'found "brokn"; allowed: a plug-in of oilfilm.torque'),
        ('traction = "rump"', r'"coulomb", a plug-in of oilfilm.friction \(see .oilfilm list plugins.\)'),
        ('traction = "four constant"', r"did you mean 'four constants'"),
        ('traction_constants = { largest = 0.06 }', "given without a plug-in"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_plug_in_is_told(installed, friction, told):
    with pytest.raises(CaseError, match=told):
        case_from_text(case_text(f"[friction]\n{friction}"), "case.toml")


def test_an_oil_without_a_density_is_told(installed):
    with pytest.raises(CaseError, match=r"plug-in 'half' .*oilfilm_dummy:half_oil\): has no density"):
        case_from_text(case_text(oil='name = "half"'), "case.toml")


@pytest.mark.parametrize(
    ("friction", "told"),
    [
        (LAW.replace("ramp", "failing"), "'failing' .*: failed: ZeroDivisionError: no such"),
        (LAW.replace("ramp", "infinite"), "'infinite' .*: gives no finite forces at"),
        ('torque_plugins = ["nothing"]', "'nothing' .*: gives no torque .N m. for load"),
    ],
)  # fmt: skip
def test_a_plug_in_that_fails_while_it_computes_is_told(installed, friction, told):
    case = case_from_text(case_text(f"[friction]\n{friction}"), "case.toml")
    with pytest.raises(plugins.PluginError, match=told):
        run_case(case, 1)


def test_one_name_of_two_distributions_is_refused(installed):
    install(installed, "[oilfilm.friction]\nramp = oilfilm_dummy:Ramp\n", "other")
    forget()
    with pytest.raises(CaseError, match=r"plug-in 'ramp' .*of several distributions: oilfilm-dummy 1.2, other 1.2"):
        case_from_text(case_text(FRICTION), "case.toml")


def test_results_of_another_plug_in_have_other_names(installed):
    before = program_digest()
    (installed / "oilfilm_dummy.py").write_text(MODULE.replace("0.03", "0.04"))
    forget()
    assert program_digest() != before


def oilfilm(folder, *words):
    paths = os.pathsep.join((str(folder), os.environ["PYTHONPATH"]))
    return subprocess.run(
        [sys.executable, "-m", "cases.cli", *words], cwd=folder, env=os.environ | {"PYTHONPATH": paths},
        capture_output=True, text=True, check=False,
    )  # fmt: skip


@pytest.mark.slow
def test_the_command_lists_and_runs_them(tmp_path):
    install(tmp_path)
    told = oilfilm(tmp_path, "list", "plugins", "--json")
    listed = json.loads(told.stdout)["plugins"]
    assert listed["ramp"] == "friction: oilfilm-dummy 1.2, oilfilm_dummy:Ramp"
    assert "cannot be loaded: ModuleNotFoundError" in listed["broken"]
    (tmp_path / "case.toml").write_text(case_text('[friction]\ntorque_plugins = ["kilograms"]'))
    run = oilfilm(tmp_path, "run", "case.toml", "--json")
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout)["torque_N_mm"]["models"]["kilograms"]["total"] > 0.0
    (tmp_path / "case.toml").write_text(case_text('[friction]\ntorque_plugins = ["nothing"]'))
    run = oilfilm(tmp_path, "run", "case.toml", "-q")
    assert run.returncode == 2
    assert run.stderr.splitlines()[-1].startswith("oilfilm: plug-in 'nothing' (oilfilm.torque, oilfilm-dummy 1.2")
    assert "Traceback" not in run.stderr
