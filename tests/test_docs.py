"""Pages that are made from the program are up to date."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"


def load(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / "docs" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_tables_of_keys_are_those_of_the_schema():
    reference = load("case_reference")
    assert reference.PAGE.read_text(encoding="utf-8") == reference.page()


def test_the_comparison_of_slip_is_up_to_date():
    """Printed to three or four figures: what another processor rounds differently does not show."""
    validation = load("validation_003")
    assert validation.PAGE.read_text(encoding="utf-8") == validation.page()


def test_the_gallery_shows_the_slip_cases():
    """Every case of the slip paper with its command and a picture; a case is not given the pictures of another."""
    gallery = load("site_pages").gallery()
    parts = {part.splitlines()[0]: part for part in gallery.split("### ")[1:]}
    cases = sorted(path.stem for path in (ROOT / "cases" / "hirano_slip").glob("*.toml"))
    assert len(cases) == 7
    for case in cases:
        assert f"oilfilm slip {case}\n" in parts[case]
        assert f"(images/{case}.png)" in parts[case]
    assert parts["hirano_7000C"].count("(images/") == 3


def test_the_comparison_of_sliding_friction_is_up_to_date():
    """Printed to three or four figures, likewise."""
    validation = load("validation_004")
    assert validation.PAGE.read_text(encoding="utf-8") == validation.page()


@pytest.mark.slow
def test_the_comparison_of_friction_over_the_supply_is_up_to_date():
    """Printed to three or four figures, likewise."""
    validation = load("validation_002_torque")
    assert validation.PAGE.read_text(encoding="utf-8") == validation.page()


def test_the_page_of_commands_names_every_command_and_option():
    from typer.main import get_command

    from cases.cli import app

    page = (DOCS / "reference" / "commands.md").read_text(encoding="utf-8")
    for name, command in get_command(app).commands.items():
        assert f"oilfilm {name}" in page
        for parameter in command.params:
            assert parameter.param_type_name == "argument" or any(option in page for option in parameter.opts)
