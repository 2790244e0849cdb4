"""The page on laws and entries of one's own, as a reader works through it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from oilfilm.cases.format.case import Case, case_from_text

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "tutorial" / "extending.md"
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_the_case_is_one():
    (text,) = [text for kind, text in BLOCKS if kind == "toml"]
    case = case_from_text(text, "page.toml")
    assert isinstance(case, Case)
    assert case.bearing.ball_material.youngs_modulus == 305e9
    assert case.lubricant.viscosity == 14e-3
    assert case.rheology.eyring_stress == 6e6


def test_the_law_gives_a_torque(tmp_path):
    (text,) = [text for kind, text in BLOCKS if kind == "python"]
    run = subprocess.run([sys.executable, "-c", text], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert re.fullmatch(r"\d+\.\d{3} N mm by sliding\n", run.stdout)


def test_files_and_names_that_the_page_speaks_of_exist():
    text = PAGE.read_text(encoding="utf-8")
    for name in re.findall(r"`((?:bearing|ehl|cases|docs|tools)/[\w/.]+)`", text):
        assert (ROOT / name).exists(), name
    source = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "ehl" / "oil").glob("*.py"))
    for name in ("LAW_CODES", "class ShearLaw", "def shear_rate"):
        assert name in source
    assert "class ModelTorque" in (ROOT / "bearing" / "torque" / "models.py").read_text(encoding="utf-8")


PLUGINS = ROOT / "docs" / "tutorial" / "plugins.md"


def plugin_blocks():
    text = PLUGINS.read_text(encoding="utf-8")
    return [body for _, body in re.findall(r"^```(toml|python)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)]


def test_the_plug_ins_of_the_page_are_listed_and_run(tmp_path):
    """The distribution as pip would install it: module and metadata, entry points as its pyproject.toml has them."""
    project, module, case = plugin_blocks()
    document = tomllib.loads(project)["project"]
    (tmp_path / "maker_oilfilm.py").write_text(module)
    info = tmp_path / f"maker_oilfilm-{document['version']}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {document['name']}\nVersion: {document['version']}\n")
    groups = document["entry-points"].items()
    points = (f"[{group}]\n" + "".join(f"{k} = {v}\n" for k, v in own.items()) for group, own in groups)
    (info / "entry_points.txt").write_text("".join(points))
    (tmp_path / "case.toml").write_text(case)

    def oilfilm(*words):
        paths = os.pathsep.join((str(tmp_path), os.environ["PYTHONPATH"]))
        command = [sys.executable, "-m", "oilfilm.cases.cli", *words]
        run = subprocess.run(
            command, cwd=tmp_path, env=os.environ | {"PYTHONPATH": paths}, capture_output=True, text=True, check=False
        )
        assert run.returncode == 0, run.stderr
        return run.stdout

    listed = oilfilm("list", "plugins")
    assert "Maker Oil 32" in listed
    assert "cannot" not in listed
    document = json.loads(oilfilm("run", "case.toml", "--json"))
    assert document["case"]["lubricant"]["name"] == "Maker Oil 32"
    assert document["torque_N_mm"]["model"] == "integrated"
