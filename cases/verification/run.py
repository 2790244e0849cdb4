"""All sections of the verification page, and the files they make."""

import json
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from postprocess.files import atomic_path
from postprocess.verification.plots import draw_pictures

from ..format.problems import CaseError
from ..runs.films import Progress
from ..runs.output_directory import check_output
from .names import SectionName
from .page import PICTURES, Section, markdown

PAGE = "verification.md"
SWEEP_PAGE = "robustness.md"
SWEEP = "robustness.jsonl"
TITLES = {PAGE: "Verification of the contact solver", SWEEP_PAGE: "Random contacts"}
INTRODUCTIONS = {
    PAGE: """\
This page is written by `oilfilm verify -o docs/validation`: every number on it is computed when the
command runs. `--section NAME` computes a part of it, `--quick` all of it on coarse grids, and
`--robustness DRAWS` the sweep over random contacts, see [robustness.md](robustness.md). Equations,
method and limits are those of [contact.md](../theory/contact.md). Each film value has the error bar
that the solver gives. A statement that does not hold is marked, and the command ends with
exit code 1.""",
    SWEEP_PAGE: """\
This page is written by `oilfilm verify --robustness 300 -o docs/validation`, from the finished contacts in
`robustness.jsonl`: the command goes on where it was interrupted, and a larger number adds to them.""",
}

MAKERS = {
    SectionName.ORDERS: ("orders", "orders"),
    SectionName.HERTZ: ("limits", "hertz_limit"),
    SectionName.RIGID: ("rigid", "rigid_limit"),
    SectionName.MOES: ("asymptotes", "moes_diagram"),
    SectionName.SAME: ("limits", "same_contact"),
    SectionName.FILMS: ("films", "named_films"),
    SectionName.FORMULAS: ("formulas", "formulas"),
    SectionName.ELEMENTS: ("elements", "elements"),
    SectionName.COST: ("costs", "costs"),
}


def run_sections(
    names: Sequence[SectionName], progress: Progress, *, quick: bool = False
) -> list[Section]:
    """Compute sections one after the other; each uses all cores but the one on cost."""
    found = []
    for done, name in enumerate(names):
        progress(done, len(names), name.value)
        module, function = MAKERS[name]
        make: Callable[[bool], Section] = getattr(
            import_module(f".{module}", __package__), function
        )
        found.append(make(quick))
    progress(len(names), len(names), "pictures")
    return found


def check_page(directory: Path, page: str) -> None:
    """Whether the page can be written to `directory`, before anything is computed.

    Raises
    ------
    CaseError
        If the folder cannot be written, or a file of the page's name is there that is not such a
        page.
    """
    check_output(directory)
    path = directory / page
    if path.exists() and not path.read_text(encoding="utf-8", errors="replace").startswith(
        f"# {TITLES[page]}\n"
    ):
        raise CaseError(
            [f"{path}: not written by oilfilm, will not be replaced; choose another -o"]
        )


def write_page(sections: Sequence[Section], directory: Path, page: str) -> None:
    """Write the page, its pictures and its numbers into a folder; each file appears when it is
    complete.
    """
    (directory / PICTURES).mkdir(parents=True, exist_ok=True)
    pictures = [
        (picture.stem, picture.draw) for section in sections for picture in section.pictures
    ]
    draw_pictures(pictures, directory / PICTURES)
    numbers = json.dumps(document(sections), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    text = markdown(TITLES[page], INTRODUCTIONS[page], sections)
    for name, content in ((Path(page).with_suffix(".json").name, numbers), (page, text)):
        with atomic_path(directory / name) as temporary:
            temporary.write_text(content, encoding="utf-8")


def document(sections: Sequence[Section]) -> dict[str, Any]:
    """What `--json` prints: checks and tables; `converged` tells whether all checks hold."""
    checks = [check for section in sections for check in section.checks]
    failed = [
        f"{check.name}: {check.value:.4g}, wanted {check.bounds}"
        for check in checks
        if not check.passed
    ]
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
            {
                "title": section.title,
                "tables": [{"head": t.head, "rows": t.rows} for t in section.tables],
            }
            for section in sections
        ],
    }
