"""Numbers as papers print them: cases/library/reference/*.csv, each with its source in the first line."""

from __future__ import annotations

import csv
from pathlib import Path

from oilfilm import cases

REFERENCE = Path(cases.__file__).parent / "library" / "reference"


def printed(name: str) -> list[dict[str, str]]:
    """Rows of a table; the keys end in their units."""
    text = (REFERENCE / f"{name}.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
