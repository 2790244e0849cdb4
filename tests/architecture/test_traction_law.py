"""One type for a law of force over motion: `ehl.traction.law.TractionLaw`; whatever has `forces` keeps its signature."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ARGUMENTS = ["self", "load", "speed", "slide_x", "slide_y", "spin"]


def laws():
    """Module and class of all product classes with a method `forces`."""
    for layer in ("ehl", "bearing", "postprocess", "cases"):
        for path in sorted((ROOT / layer).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text())):
                if isinstance(node, ast.ClassDef):
                    for member in node.body:
                        if isinstance(member, ast.FunctionDef) and member.name == "forces":
                            yield path.relative_to(ROOT).as_posix(), node, member


LAWS = {f"{path}::{node.name}": (node, member) for path, node, member in laws()}


@pytest.mark.parametrize("name", LAWS)
def test_every_law_has_the_signature_of_the_protocol(name):
    _, member = LAWS[name]
    assert [argument.arg for argument in member.args.args] == ARGUMENTS


def test_one_protocol_stands_for_all_laws():
    abstract = [
        name
        for name, (node, _) in LAWS.items()
        if {ast.unparse(base).rpartition(".")[2] for base in node.bases} & {"ABC", "Protocol"}
    ]
    assert [name.rpartition("::")[2] for name in abstract] == ["TractionLaw"]
