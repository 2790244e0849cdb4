"""The page of the Python interface names what is there."""

from __future__ import annotations

import importlib
import re

from .sources import ROOT

PAGE = ROOT / "docs" / "reference" / "api.md"


def test_every_name_of_the_page_exists():
    names = re.findall(r"^:::\s+(\S+)", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert names
    missing = []
    for name in names:
        module, _, attribute = name.rpartition(".")
        if not hasattr(importlib.import_module(module), attribute):
            missing.append(name)
    assert missing == []
