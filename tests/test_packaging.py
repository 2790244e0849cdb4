"""What is told of the distribution: constraints, classifiers, what the sdist leaves out."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import install_matrix
import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def constraints(name):
    lines = (ROOT / "packaging" / "constraints" / f"{name}.txt").read_text(encoding="utf-8").split("\n")
    return dict(line.partition(";")[0].strip().split("==") for line in lines if line)


def canonical(name):
    return re.sub(r"[-_.]+", "-", name).lower()


def bounds():
    """Lower bounds of all dependencies."""
    project = PROJECT["project"]
    extras = [name for key in install_matrix.EXTRAS.split(",") for name in project["optional-dependencies"][key]]
    for line in (*project["dependencies"], *extras):
        name, _, bound = line.partition(";")[0].strip().partition(">=")
        yield canonical(name.partition("[")[0]), bound.partition(",")[0]


def numbers(version):
    return tuple(int(part) for part in re.findall(r"\d+", version))


def test_lowest_versions_are_the_bounds():
    assert [line for line in install_matrix.lowest() if line] == [
        line for line in (ROOT / "packaging/constraints/lowest.txt").read_text(encoding="utf-8").split("\n") if line
    ]


@pytest.mark.parametrize("which", ["tested", "newest"])
def test_every_dependency_has_a_version_that_its_bound_allows(which):
    versions = constraints(which)
    wrong = {name: bound for name, bound in bounds() if numbers(versions.get(name, "0")) < numbers(bound)}
    assert not wrong


def test_versions_of_python_are_named():
    classifiers = PROJECT["project"]["classifiers"]
    assert {"Programming Language :: Python :: 3.11", "Typing :: Typed"} <= set(classifiers)
    assert not any(one.startswith("License ::") for one in classifiers)  # the expression says it


def test_the_sdist_is_what_the_wheel_is_built_from():
    left_out = PROJECT["tool"]["hatch"]["build"]["targets"]["sdist"]["exclude"]
    package = {f"/{name}" for name in PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]["only-include"]}
    assert not package & set(left_out)
    files = [file for name in package for file in (ROOT / name[1:]).rglob("*") if file.is_file()]
    size = sum(file.stat().st_size for file in files if file.suffix in (".npz", ".zip"))
    assert size < 4_000_000  # bytes that pack no further, of 5 MB in all
