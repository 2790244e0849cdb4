"""The page of the libraries shows what the data say."""

from __future__ import annotations

import importlib.util
from pathlib import Path

TOOLS = Path(__file__).parents[1] / "tools" / "docs"


def test_the_tables_of_the_libraries_are_those_of_the_data():
    spec = importlib.util.spec_from_file_location("libraries", TOOLS / "libraries.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.PAGE.read_text(encoding="utf-8") == module.page()
