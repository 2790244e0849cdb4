"""What the wheel contains."""

from __future__ import annotations

import tomllib

import pytest

from .import_graph import LAYERS, ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def test_the_wheel_is_the_layers_under_one_name():
    wheel = PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]
    assert wheel["only-include"] == list(LAYERS)
    assert wheel["sources"] == {layer: f"oilfilm/{layer}" for layer in LAYERS if layer != "oilfilm"}
    assert wheel["dev-mode-dirs"] == ["build/links"]
    assert "custom" in wheel["hooks"]


@pytest.mark.parametrize("layer", LAYERS)
def test_types_are_part_of_the_package(layer):
    """PEP 561: a marker in the package, which the wheel takes with all its files."""
    assert (ROOT / layer / "py.typed").read_text(encoding="utf-8") == ""
