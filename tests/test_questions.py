"""Twenty questions of bearing engineers, each answered by the command that `packaging/skill/SKILL.md` names for it.

Bands are those of makers' catalogues, of closed forms or of the ranges that the answers carry themselves.
"""

from __future__ import annotations

import json
import re
from functools import reduce
from pathlib import Path

import pytest
from typer.testing import CliRunner

from oilfilm.cases.cli.main import app

ROOT = Path(__file__).parents[1]
SKILL = (ROOT / "packaging" / "skill" / "SKILL.md").read_text(encoding="utf-8")
INIT = {
    "motor": "6306-2Z/C3 --speed 3000 --radial 800",
    "spindle": "7012AC --speed 8000 --axial 900 --radial 300",
    "slow": "6204 --speed 100 --radial 2000",
}
WORDS = {
    "hertz": "hertz 6205 --radial 2000",
    "frequencies": "frequencies 6205 --speed 1772",
    "motor": "run motor",
    "spindle": "run spindle",
    "slow": "run slow",
    "ceramic": "run 6208_five_terms",
    "contact": "contact moes_20_10",
    "shaft": "shaft spindle_two_bearings",
}
# question, answer's command, path in its summary, least, most
QUESTIONS = [
    ("Hertz pressure of a 6205 at 2000 N [GPa]?", "hertz", "contacts.0.hertz_pressure_GPa", 2.2, 2.7),
    ("approach of ball and inner race [um]?", "hertz", "contacts.0.approach_um", 9.0, 13.0),
    ("BPFO of a 6205 at 1772 r/min [Hz]?", "frequencies", "frequencies_Hz.ball_pass_outer", 105.0, 107.0),
    ("BPFI of it [Hz]?", "frequencies", "frequencies_Hz.ball_pass_inner", 159.0, 161.0),
    ("torque of my 6306 at 3000 r/min, 800 N [N mm]?", "motor", "torque_N_mm.total", 20.0, 90.0),
    ("how warm does it get [C]?", "motor", "self_heating.temperature_C", 35.0, 70.0),
    ("thinnest film of it [um]?", "motor", "contacts.0.film_minimum_um", 0.2, 1.0),
    ("basic rating life of it [h], (C/P)^3?", "motor", "life.basic_reference_rating_h", 80e3, 250e3),
    ("static safety of it?", "motor", "life.static_safety_factor", 15.0, 22.0),
    ("when to grease it again [h]?", "motor", "life.relubrication_interval_h", 2e3, 3e4),
    ("reference speed after ISO 15312 [r/min]?", "motor", "reference_speed_rpm", 6e3, 2e4),
    ("viscosity ratio of it?", "motor", "life.kappa", 2.0, 12.0),
    ("breakdown voltage of its film [V]?", "motor", "electrical.breakdown_voltage_V", 5.0, 100.0),
    ("cage speed of the spindle bearing [r/min]?", "spindle", "cage_speed_rpm", 3200.0, 3800.0),
    ("contact angle of its outer race [deg]?", "spindle", "contacts.-1.contact_angle_deg", 10.0, 26.0),
    ("torque of touching asperities of a slow 6204 [N mm]?", "slow", "torque_N_mm.parts.asperity", 0.05, 1.0),
    ("SKF's torque beside a full-ceramic 6208 [N mm]?", "ceramic", "torque_N_mm.models.skf.total", 100.0, 150.0),
    ("film of a point contact at M 20, L 10?", "contact", "film_central_dimensionless", 0.42, 0.44),
    ("first critical speed of the shaft [r/min]?", "shaft", "critical_speeds_rpm.0", 1.5e4, 2.5e4),
    ("load on its locating bearing [N]?", "shaft", "bearings.0.life.dynamic_equivalent_load_N", 800.0, 1600.0),
]


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """Summaries by their command."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("questions"))
        for name, words in INIT.items():
            assert CliRunner().invoke(app, ["init", name, "--bearing", *words.split()]).exit_code == 0
        found = {}
        for name, words in WORDS.items():
            result = CliRunner().invoke(app, [*words.split(), "--json"])
            assert result.exit_code == 0, result.stderr
            found[name] = json.loads(result.stdout)
    return found


def at(document, path):
    """The value at a dotted path."""
    return reduce(lambda here, key: here[int(key) if isinstance(here, list) else key], path.split("."), document)


@pytest.mark.slow
@pytest.mark.parametrize(("question", "command", "path", "least", "most"), QUESTIONS, ids=[q[2] for q in QUESTIONS])
def test_the_command_answers(answers, question, command, path, least, most):
    assert least <= at(answers[command], path) <= most, question


def test_the_skill_names_the_commands_and_keys():
    for words in WORDS.values():
        assert f"oilfilm {words.split()[0]} " in SKILL
    for path in {question[2].split(".")[-1] for question in QUESTIONS} - {"0", "total"}:
        assert path in SKILL, path


@pytest.mark.parametrize("text", [SKILL, (ROOT / "llms.txt").read_text(encoding="utf-8")], ids=["skill", "llms"])
def test_the_commands_named_exist(text):
    from typer.main import get_command

    commands = get_command(app).commands
    for line in re.findall(r"`oilfilm ([^`]+)`", text):
        name, *words = line.split()
        options = {option for parameter in commands[name].params for option in parameter.opts}
        assert {word for word in words if word.startswith("--")} <= options | {"--help"}


def test_the_links_of_the_index_exist():
    text = (ROOT / "llms.txt").read_text(encoding="utf-8")
    assert [link for link in re.findall(r"\]\(([^)]+)\)", text) if not (ROOT / link).exists()] == []
