"""One type for a law of force over motion, `TractionLaw`; all with `forces` keep its signature."""

from __future__ import annotations

import ast

import pytest

from .sources import nodes

ARGUMENTS = ["self", "load", "speed", "slide_x", "slide_y", "spin"]


def forces(law):
    """The method `forces` of a class; None without one."""
    methods = (member for member in law.body if isinstance(member, ast.FunctionDef))
    return next((method for method in methods if method.name == "forces"), None)


LAWS = {f"{name}::{law.name}": law for name, law in nodes(ast.ClassDef) if forces(law)}


@pytest.mark.parametrize("name", LAWS)
def test_every_law_has_the_signature_of_the_protocol(name):
    assert [argument.arg for argument in forces(LAWS[name]).args.args] == ARGUMENTS


def test_one_protocol_stands_for_all_laws():
    bases = {law.name: {ast.unparse(base).rpartition(".")[2] for base in law.bases} for law in LAWS.values()}
    assert [name for name, of in bases.items() if of & {"ABC", "Protocol"}] == ["TractionLaw"]
