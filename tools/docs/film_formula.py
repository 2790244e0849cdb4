"""Write docs/theory/film_formula.md: the film formula of fifty coefficients and its errors.

Run it with `python tools/docs/film_formula.py`, after `tools/atlas/formula.py`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from atlas.picture import LEAST_LUBRICANT, errors, formula_errors, held_out
from oilfilm.ehl.atlas.film_formula import FILE

PAGE = Path(__file__).parents[2] / "docs" / "theory" / "film_formula.md"
TEMPLATE = PAGE.with_suffix(".md.in")
ROWS = {  # of the classics, as `errors` names them
    "hamrock_dowson": "Hamrock and Dowson (1977)",
    "chittenden": "Chittenden et al. (1985), central film only",
    "nijenbanning": "Nijenbanning, Venner and Moes (1994), central film only",
    "fifty": "**the formula**",
    "atlas": "[film atlas](film_atlas.md)",
}
FILMS = ("central", "minimum")


def _three(error: np.ndarray | None) -> str:
    if error is None:
        return "–"
    return f"{error.max():.2g} / {np.quantile(error, 0.95):.2g} / {np.sqrt((error**2).mean()):.2g}"


def comparison() -> tuple[str, int]:
    """Rows of formulas on the same contacts, and how many these are."""
    found = {name: errors(name) for name in FILMS}
    rows = [
        f"| {title} | {' | '.join(_three(found[name][1].get(key)) for name in FILMS)} |" for key, title in ROWS.items()
    ]
    return "\n".join(rows), len(found["central"][0])


def parts() -> str:
    """Rows of the formula's errors for the oil of the fit and others."""
    rows = []
    for title, kind in (("α 22 GPa⁻¹, z 0.68", "held"), ("α 10 to 30 GPa⁻¹, z 0.4 to 0.8", "held oil")):
        own = held_out(kind)
        shown = " | ".join(_three(formula_errors(own, name)) for name in FILMS)
        rows.append(f"| {title}, L 0 to 30 | {len(own)} | {shown} |")
    return "\n".join(rows)


def page() -> str:
    """The page, computed anew."""
    rows, count = comparison()
    return TEMPLATE.read_text(encoding="utf-8").format(
        comparison=rows,
        count=count,
        least=LEAST_LUBRICANT,
        parts=parts(),
        coefficients=FILE.read_text(encoding="utf-8").strip(),
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
