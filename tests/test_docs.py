"""Pages that are generated from the program are up to date, and complete."""

from __future__ import annotations

import ast
import csv
import importlib
import json
import os
import re
import subprocess
import sys
from inspect import isclass
from pathlib import Path
from typing import get_args

import pytest

from oilfilm.ehl.units import unit_of

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"


@pytest.mark.parametrize(
    "script",
    [
        "case_reference",
        "libraries",
        "film_formula",
        "validation_003",
        "validation_004",
        pytest.param("validation_002_torque", marks=pytest.mark.slow),
        pytest.param("validation_002_films", marks=pytest.mark.slow),
        pytest.param("validation_002_supply", marks=pytest.mark.slow),
        pytest.param("heat_of_bearings", marks=pytest.mark.slow),
        pytest.param("torque_of_bearings", marks=pytest.mark.slow),
    ],
)
def test_a_generated_page_is_up_to_date(script):
    """Numbers are printed to three or four figures: differences between processors do not show."""
    tool = importlib.import_module(script)
    assert tool.PAGE.read_text(encoding="utf-8") == tool.page()


@pytest.mark.parametrize("template", sorted(DOCS.rglob("*.md.in")), ids=lambda path: path.stem)
def test_a_page_has_the_text_of_its_template(template):
    """Also where the numbers take minutes: the text between placeholders is there."""
    page = template.with_suffix("").read_text(encoding="utf-8")
    text = re.split(r"\{[^{}]*\}", template.read_text(encoding="utf-8"))
    assert re.fullmatch(".*?".join(re.escape(part) for part in text), page, re.DOTALL)


def test_every_page_is_in_the_navigation():
    navigation = re.findall(r"- (?:\w+: )?([\w/]+\.md)", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"))
    pages = [path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md")]
    assert sorted(navigation) == sorted([*pages, "examples.md", "gallery.md", "reference/changelog.md"])


PAGES = [*sorted(DOCS.rglob("*.md")), *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"))]
SOURCES = [*sorted((ROOT / "tools").rglob("*.py")), *sorted((ROOT / "benchmarks").glob("*.py"))]
PARTS = "bearing|cases|ehl|postprocess"


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.stem)
def test_paths_on_a_page_exist(page):
    folders = f"{PARTS}|benchmarks|docs|oilfilm|packaging|tests|tools"
    paths = re.findall(rf"(?<![\w/.])((?:{folders})/[\w/.-]*\w)", page.read_text(encoding="utf-8"))
    assert [path for path in paths if not (ROOT / path).exists()] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.stem)
def test_names_of_the_program_on_a_page_exist(page):
    assert [name for name in names_in(page) if not is_found(name)] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.stem)
def test_names_on_a_page_have_the_one_import_name(page):
    """Words as `bearing.bore_mm` are keys of a case file, else they lack `oilfilm.`."""
    words = re.findall(rf"`\"?(?<![\w.])((?:{PARTS})\.[a-z]\w*(?:\.\w+)*)", page.read_text(encoding="utf-8"))
    assert [word for word in words if not is_key(word)] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.stem)
def test_imports_in_the_python_of_a_page_are_of_one_name(page):
    for code in re.findall(r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE):
        for node in ast.walk(ast.parse(code)):
            modules = [node.module] if isinstance(node, ast.ImportFrom) else []
            modules += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            assert not {module.partition(".")[0] for module in modules} & set(PARTS.split("|"))
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("oilfilm"):
                names = [f"{node.module}.{alias.name}" for alias in node.names]
                assert [name for name in names if not is_found(name)] == []


@pytest.mark.parametrize("file", SOURCES, ids=lambda path: path.stem)
def test_names_of_the_program_in_a_tool_exist(file):
    assert [name for name in names_in(file) if not is_found(name)] == []


def names_in(file):
    """Dotted names below `oilfilm` in a text."""
    text = file.read_text(encoding="utf-8")
    return sorted(set(re.findall(r"(?<![\w./-])(oilfilm(?:\.[A-Za-z_]\w*)+)(?!\w|\.\w|/)", text)) - {"oilfilm.oils"})


def is_found(name):
    """True for a module, an attribute of one, or of a class; for `oilfilm.oils`, a group of entry points, not asked."""
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        try:
            thing = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for attribute in parts[count:]:
            fields = getattr(thing, "__annotations__", {})
            if not hasattr(thing, attribute) and attribute not in fields:
                return False
            thing = getattr(thing, attribute, None)
        return True
    return False


def is_key(word):
    """True for a key of case files, by its table."""
    from oilfilm.cases.format.document import BearingFile, ContactFile

    table, key = word.split(".")[:2]
    fields = {**ContactFile.model_fields, **BearingFile.model_fields}
    if table not in fields:
        return False
    kinds = [kind for kind in (fields[table].annotation, *get_args(fields[table].annotation)) if isclass(kind)]
    return any(key in getattr(kind, "model_fields", {}) for kind in kinds)


def test_printed_numbers_name_their_source():
    """Source in the first line, a unit at the end of each column, full rows."""
    from printed import REFERENCE, printed

    tables = sorted(REFERENCE.glob("*.csv"))
    assert len(tables) >= 9
    for path in tables:
        first, head, *_ = path.read_text(encoding="utf-8").splitlines()
        assert first.startswith("# ")
        columns = next(csv.reader([head]))
        assert all(name == "bearing" or unit_of(name) for name in columns)
        for row in printed(path.stem):
            assert None not in row
            assert all(float(value) >= 0.0 for value in row.values())


def test_the_gallery_shows_the_slip_cases():
    """Every case of the slip paper with its command and its own pictures."""
    gallery = importlib.import_module("site_pages").gallery()
    parts = {part.splitlines()[0]: part for part in gallery.split("### ")[1:]}
    cases = sorted(path.stem for path in (ROOT / "cases" / "library" / "hirano_slip").glob("*.toml"))
    assert len(cases) == 7
    for case in cases:
        assert f"oilfilm slip {case}\n" in parts[case]
        assert f"(images/{case}.png)" in parts[case]
    assert parts["hirano_7000C"].count("(images/") == 3


def test_links_of_the_change_log_exist_on_its_page():
    changelog = importlib.import_module("site_pages").changelog()
    links = [link for link in re.findall(r"\]\(([^)#]+)", changelog) if "://" not in link]
    assert links
    assert [link for link in links if not (DOCS / "reference" / link).exists()] == []


def test_the_page_of_commands_names_every_command_and_option():
    from typer.main import get_command

    from oilfilm.cases.cli.main import app

    page = (DOCS / "reference" / "commands.md").read_text(encoding="utf-8")
    for name, command in get_command(app).commands.items():
        assert f"oilfilm {name}" in page
        for parameter in command.params:
            assert parameter.param_type_name == "argument" or any(option in page for option in parameter.opts)


def test_equations_are_typeset_for_the_site():
    pytest.importorskip("latex2mathml")
    site = importlib.import_module("site_pages")
    text = site.equations("Film:\n\n```math\nh = \\frac{x^2}{2R}\n```\n\nwith $`R`$ and `$x$`.\n")
    assert text.count("<math") == 2 and "<mfrac>" in text and "`$x$`" in text


INDEX = (DOCS / "index.md").read_text(encoding="utf-8")


def test_the_first_page_says_of_quality_what_the_readme_says():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    head = "| question | answer | command |\n|---|---|---|\n"
    rows = readme.partition(head)[2].partition("\n\n")[0].splitlines()
    assert len(rows) >= 3
    own = INDEX.partition(head)[2].partition("\n\n")[0].splitlines()
    numbers = [re.findall(r"\d[\d.]*", row) for row in own]
    for row in rows:
        assert re.findall(r"\d[\d.]*", row) in numbers, row


def test_the_result_of_the_first_page_is_that_of_the_shipped_case():
    """Films and loads as the regression tests hold them, which keep no films between which a light ball rides."""
    text = (ROOT / "tests" / "regression" / "expected.json").read_text(encoding="utf-8")
    expected = json.loads(text)["6208_full_ceramic"]
    (block,) = re.findall(r"^```text\n(.*?)^```$", INDEX, re.DOTALL | re.MULTILINE)
    ball, seen, light, unloaded = "", 0, 0, 0
    for line in block.splitlines():
        number = re.match(r" +(\d)\D.* inner ", line)
        ball = number[1] if number else ball
        race = re.search(r" (inner|outer) +([\d.]+) +([\d.]+|–)", line)
        if race is None:
            continue
        place = f"ball {ball} {race[1]}"
        films = re.findall(r"([\d.]+) ± ([\d.]+)", line)
        printed = [race[2], race[3], *(film for film, _ in films)]
        keys = ("load_N", "hertz_pressure_GPa", "film_central_um", "film_minimum_um")
        known = [expected[f"{place} {key}"] for key in keys]
        if race[3] == "–":  # out of load
            assert (race[2], films, known) == ("0", [], [0.0, None, None, None]), place
            unloaded += 1
            continue
        light += known[2:] == [None, None]
        for number, key, value in zip(printed, keys, known, strict=True):
            decimals = len(number.partition(".")[2])
            assert value is None or f"{value:.{decimals}f}" == number, (place, key)
        seen += 1
    assert (seen, light, unloaded) == (
        7,
        1,
        1,
    )  # four kinds of balls, one of them between films, one off the inner race
    assert f"cage speed         {expected['cage_speed_rpm']:.1f} r/min" in block


@pytest.mark.slow
def test_the_lines_of_the_first_page_are_those_that_the_command_prints(tmp_path):
    (block,) = re.findall(r"^```text\n(.*?)^```$", INDEX, re.DOTALL | re.MULTILINE)
    command = [sys.executable, "-m", "oilfilm.cases.cli", "run", "6208_full_ceramic", "-o", "out"]
    environment = os.environ | {"COLUMNS": "100"}
    run = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    printed = {line.strip() for line in run.stdout.splitlines()}
    assert [line for line in block.splitlines() if line.strip() not in printed] == []


def test_pages_are_searched_from_a_folder_with_nothing_from_elsewhere():
    """The theme's plug-in would load a script from a server, unless it finds its own."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    assert "  - offline" in text
    (script,) = re.findall(r"polyfills: \[(\S*iframe-worker\S*)\]", text)
    assert (DOCS / script).is_file()
