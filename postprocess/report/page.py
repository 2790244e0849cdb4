"""One HTML page of a result folder that needs no other file: case, batch, single contact, or
whatever has a summary.
"""

import json
from collections.abc import Iterator
from html import escape
from importlib import resources
from pathlib import Path
from string import Template
from typing import Any

from ..files import SUMMARY_FILE, atomic_path
from . import batch as report_batch
from . import bearing as report_bearing
from .html import (
    facts,
    is_large,
    items,
    name_text,
    picture,
    section,
    table,
    text,
    unit_text,
    versions,
)

REPORT_FILE = "report.html"
GENERATOR = '<meta name="generator" content="oilfilm'
MOST_ROWS = 500  # of a table that unfolds
HEADER = 1000  # characters within which the generator stands


def write_report(directory: str | Path) -> Path:
    """Write `report.html` into a result folder.

    Parameters
    ----------
    directory : str or Path

    Returns
    -------
    Path
        The page.

    Raises
    ------
    ValueError
        If the folder holds no readable results, or a page of that name which is not ours.
    """
    folder = Path(directory)
    path = folder / REPORT_FILE
    page = report_page(folder)
    if (
        path.exists()
        and GENERATOR not in path.read_text(encoding="utf-8", errors="replace")[:HEADER]
    ):
        raise ValueError(f"{path} was not written by oilfilm and will not be replaced")
    with atomic_path(path) as temporary:
        temporary.write_text(page, encoding="utf-8")
    return path


def read_summary(directory: Path) -> dict[str, Any]:
    """The summary of a result folder; ValueError if there is none, or it is not ours."""
    path = directory / SUMMARY_FILE
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ValueError(
            f"{directory} holds no results: {SUMMARY_FILE}: {error.strerror or error}"
        ) from error
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is damaged: {error}") from error
    if (
        not isinstance(summary, dict)
        or not {"oilfilm", "case", "converged", "messages"} <= summary.keys()
    ):
        raise ValueError(
            f"{path} is not a summary of oilfilm, or one of a version older than this one reads"
        )
    return summary


def report_page(folder: Path) -> str:
    """The page as text."""
    summary = read_summary(folder)
    batch = summary.get("kind") == "batch"
    title = str(summary.get("title") if batch else summary["case"].get("title") or folder.name)
    sections = report_batch.sections(summary, folder) if batch else _sections(summary, folder)
    parts = [(anchor, name, body) for anchor, name, body in sections if body]
    links = " ".join(f'<a href="#{anchor}">{escape(name)}</a>' for anchor, name, _ in parts)
    head = _head(summary, title, links) + (
        report_batch.cards(summary) if batch else report_bearing.cards(summary)
    )
    body = head + _warnings(summary) + "\n".join(section(*part) for part in parts)
    return Template(_template("report.html")).substitute(
        title=escape(title),
        version=escape(str(summary["oilfilm"])),
        style=_template("report.css"),
        body=body,
    )


def _template(name: str) -> str:
    return resources.files(__package__).joinpath("templates", name).read_text(encoding="utf-8")


def _head(summary: dict[str, Any], title: str, links: str) -> str:
    case = summary["case"]
    source = (
        f"<p>Source of the input: {escape(str(case['source']))}</p>"
        if _has(case, "source")
        else ""
    )
    state = '<span class="state fine">converged</span>'
    if not summary["converged"]:
        state = '<span class="state bad">not converged</span>'
    made = f'<span class="quiet small">oilfilm {escape(str(summary["oilfilm"]))}</span>'
    return (
        f"<header><h1>{escape(title)}</h1>{source}<p>{state} {made}</p><nav>{links}</nav></header>"
    )


def _has(case: Any, key: str) -> bool:
    return isinstance(case, dict) and bool(case.get(key))


def _warnings(summary: dict[str, Any]) -> str:
    """What did not converge or is doubtful, at the top."""
    urgent = [message for message in summary["messages"] if is_urgent(str(message))]
    return f'<div class="warnings"><b>To be seen to</b>{items(urgent)}</div>' if urgent else ""


def is_urgent(message: str) -> bool:
    """Whether a message tells a doubt about a result, and not only why a value is null."""
    words = (
        "not converged",
        "not resolved",
        "error bar",
        "no film was computed",
        "arbitrary",
        "failed",
        "lost",
        "beyond",
    )
    return any(word in message for word in words) and ": null" not in message


def _sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of every part of a single case's page."""
    yield "input", "Input", report_bearing.input_tables(summary["case"])
    yield from report_bearing.sections(summary, folder)
    yield "more", "Further results", _rest(summary)
    yield "pictures", "Further pictures", _pictures(summary, folder)
    notes = [str(message) for message in summary["messages"] if not is_urgent(str(message))]
    yield "notes", "Notes", f'<div class="notes small">{items(notes)}</div>' if notes else ""
    yield "versions", "Versions and times", versions(summary)


def _rest(summary: dict[str, Any]) -> str:
    """Blocks that no part of the page knows: whatever numbers they hold."""
    blocks = {key: value for key, value in summary.items() if key not in report_bearing.KNOWN}
    alone = {key: value for key, value in blocks.items() if not is_large(value)}
    shown = [facts("", alone)] if alone and not report_bearing.is_single_contact(summary) else []
    for key, value in blocks.items():
        if isinstance(value, dict):
            plain = {name: item for name, item in value.items() if not is_large(item)}
            shown += [facts(key.replace("_", " "), plain)] if plain else []
    lists = "".join(_rows(key, value) for key, value in blocks.items() if isinstance(value, list))
    if "contacts" not in summary:
        lists += _rows("balls", summary.get("balls") or [])
    return (f'<div class="facts">{"".join(shown)}</div>' if shown else "") + lists


def _rows(name: str, rows: list[Any]) -> str:
    """A list of tables that all have single numbers, as one table that unfolds."""
    if not rows or len(rows) > MOST_ROWS or not all(isinstance(row, dict) for row in rows):
        return ""
    keys = [key for key in rows[0] if not any(is_large(row.get(key)) for row in rows)]
    if not keys:
        return ""
    lines = [("", [text(row.get(key)) for key in keys]) for row in rows]
    body = table([(name_text(key), unit_text(key)) for key in keys], lines)
    return f"<details><summary>{name_text(name)} ({len(rows)})</summary>{body}</details>"


def _pictures(summary: dict[str, Any], folder: Path) -> str:
    """Pictures that no part of the page names: slip maps, dynamics, what later versions draw."""
    known = report_bearing.known_pictures(summary)
    files = sorted([*folder.glob("*.png"), *folder.glob("plots/*.png")])
    shown = [
        picture(file, file.stem.replace("_", " ")) for file in files if file.name not in known
    ]
    return f'<div class="gallery">{"".join(shown)}</div>' if shown else ""
