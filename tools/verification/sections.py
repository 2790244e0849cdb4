"""All sections of the verification page, and the files they make."""

import json
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from oilfilm.postprocess.bearing.results import BearingResults
from oilfilm.postprocess.files import write_text
from oilfilm.postprocess.plot_style import write_figure

from .asymptotes import moes_diagram
from .costs import costs
from .elements import elements
from .films import named_films
from .formulas import formulas
from .limits import hertz_limit, same_contact
from .names import SectionName
from .orders import orders
from .page import PICTURES, ForeignFileError, Progress, Section, markdown, text
from .rigid import rigid_limit

PAGE = "verification.md"
SWEEP_PAGE = "robustness.md"
SWEEP = "robustness.jsonl"
STARVATION_PAGE = "starvation.md"
HOT_PAGE = "hot_films.md"
TITLES = {
    PAGE: "Verification of the contact solver",
    SWEEP_PAGE: "Random contacts",
    STARVATION_PAGE: "Verification of contacts behind a layer of oil",
    HOT_PAGE: "Films with heat",
}
INTRODUCTIONS = {PAGE: "page", SWEEP_PAGE: "sweep", STARVATION_PAGE: "starvation page", HOT_PAGE: "hot page"}

MAKERS: dict[SectionName, Callable[..., Section]] = {
    SectionName.ORDERS: orders,
    SectionName.HERTZ: hertz_limit,
    SectionName.RIGID: rigid_limit,
    SectionName.MOES: moes_diagram,
    SectionName.SAME: same_contact,
    SectionName.FILMS: named_films,
    SectionName.FORMULAS: formulas,
    SectionName.ELEMENTS: elements,
    SectionName.COST: costs,
}


def run_sections(
    names: Sequence[SectionName],
    progress: Progress,
    run_bearing: Callable[[], BearingResults] | None = None,
    *,
    quick: bool = False,
) -> Iterator[Section]:
    """Compute sections one after the other; each uses all cores but the one on cost.

    `run_bearing` runs the bearing of the cost section, whose table of it is left out without.
    """
    for done, name in enumerate(names):
        progress(done, len(names), name.value)
        bearing = (run_bearing,) if name is SectionName.COST else ()
        yield MAKERS[name](quick, *bearing)
    progress(len(names), len(names), "pictures")


def check_page(directory: Path, page: str) -> None:
    """Raise `ForeignFileError` if a file of the page's name is there that is not such a page."""
    path = directory / page
    title = f"# {TITLES[page]}\n"
    if path.exists() and not path.read_text(encoding="utf-8", errors="replace").startswith(title):
        raise ForeignFileError(f"{path}: not written by oilfilm, will not be replaced; choose another -o")


def write_page(sections: Sequence[Section], directory: Path, page: str) -> None:
    """Write the page, its pictures and numbers; each file appears when it is complete."""
    (directory / PICTURES).mkdir(parents=True, exist_ok=True)
    for picture in (picture for section in sections for picture in section.pictures):
        write_figure(directory / PICTURES / f"{picture.stem}.png", picture.draw)
    numbers = json.dumps(document(sections), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    markdown_text = markdown(TITLES[page], text(INTRODUCTIONS[page]), sections)
    for name, content in ((Path(page).with_suffix(".json").name, numbers), (page, markdown_text)):
        write_text(directory / name, content)


def document(sections: Sequence[Section]) -> dict[str, Any]:
    """What `--json` prints: checks and tables; `converged` tells whether all checks hold."""
    checks = [check for section in sections for check in section.checks]
    failed = [f"{c.name}: {c.value:.4g}, wanted {c.bounds}" for c in checks if not c.passed]
    return {
        "converged": not failed,
        "messages": failed,
        "checks": [
            {
                "name": check.name,
                "value": check.value if check.value == check.value else None,
                "least": check.least,
                "most": check.most,
                "passed": check.passed,
            }
            for check in checks
        ],
        "sections": [
            {"title": section.title, "tables": [{"head": t.head, "rows": t.rows} for t in section.tables]}
            for section in sections
        ],
    }
