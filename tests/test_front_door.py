"""`import oilfilm`: the public names, the types that go with them, the files of a release."""

from __future__ import annotations

import ast
import doctest
import inspect
import re
import sys
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

import oilfilm

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("name", oilfilm.__all__)
def test_the_example_of_a_name_prints_what_it_says(name):
    """Those that need results of hours, a display or processes of their own are marked to be skipped, line by line."""
    thing = getattr(oilfilm, name)
    names = dict(vars(sys.modules[thing.__module__]))
    (example,) = doctest.DocTestFinder(recurse=False).find(thing, globs=names)
    assert example.examples
    runner = doctest.DocTestRunner()
    runner.run(example)
    assert runner.summarize(verbose=False).failed == 0


@pytest.mark.parametrize("name", oilfilm.__all__)
def test_a_function_lists_its_parameters(name):
    thing = getattr(oilfilm, name)
    if inspect.isclass(thing):
        return
    doc = inspect.getdoc(thing) or ""
    listed = doc.partition("Parameters\n----------\n")[2].partition("\n\n")[0]
    named = {word.strip(" *") for line in re.findall(r"^(\S.*?) :", listed, re.M) for word in line.split(",")}
    assert named == set(inspect.signature(thing).parameters)


def test_the_page_of_the_interface_lists_the_public_names():
    page = (ROOT / "docs" / "reference" / "api.md").read_text(encoding="utf-8")
    front, _, further = page.partition("## Further inputs and results")
    listed = re.findall(r"^::: (\S+)$", front, re.M)
    assert sorted(listed) == sorted(home_of(name) for name in oilfilm.__all__)
    assert further
    stability = (ROOT / "docs" / "reference" / "stability.md").read_text(encoding="utf-8")
    names = stability.partition("The public names are:\n")[2].partition("```python")[0]
    assert sorted(re.findall(r"`(\w+)`", names)) == oilfilm.__all__


def home_of(name):
    """Full name of a public thing, where it is defined."""
    return f"{getattr(oilfilm, name).__module__}.{name}"


@pytest.mark.parametrize("name", oilfilm.__all__)
def test_a_name_is_that_of_its_package(name):
    assert getattr(oilfilm, name) is getattr(import_module(oilfilm.PUBLIC[name]), name)


def test_types_name_the_same():
    tree = ast.parse((ROOT / "oilfilm" / "__init__.pyi").read_text(encoding="utf-8"))
    imported = {
        alias.asname: node.module for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names
    }
    assert imported == oilfilm.PUBLIC


def test_what_is_not_public_is_told():
    with pytest.raises(AttributeError, match="no attribute 'solve_everything'"):
        oilfilm.solve_everything  # noqa: B018
    assert oilfilm.__version__[0].isdigit()
    assert "load_case" in dir(oilfilm)


def test_the_recipe_has_the_dependencies_of_the_project():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    recipe = (ROOT / "packaging" / "meta.yaml").read_text(encoding="utf-8")
    for dependency in project["dependencies"]:
        name, bound = re.match(r"([\w.-]+)(>=[\w.]+)", dependency).groups()
        name = {"matplotlib": "matplotlib-base", "CoolProp": "coolprop"}.get(name, name)
        assert f"    - {name} {bound}\n" in recipe


def test_the_citation_names_the_license_of_the_project():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"license: {project['license']}\n" in citation
    assert citation.startswith("cff-version: 1.2.0\n")
