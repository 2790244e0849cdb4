"""One HTML page of a result folder that needs no other file; for whatever has a summary."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from oilfilm.ehl.foreign_files import open_file
from oilfilm.ehl.units import unit_symbol

from ..files import read_summary, write_text
from . import batch, bearing, html, simulations
from .simulations import VIBRATION_PICTURES, vibration_section

REPORT_FILE = "report.html"
GENERATOR = '<meta name="generator" content="oilfilm'
MAX_ROWS = 500  # of a table that unfolds
HEADER = 1000  # characters within which the generator stands


def write_report(directory: str | Path) -> Path:
    """Write `report.html` into a result folder.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        If the folder holds no readable results, or a page of that name that is not of oilfilm.
    """
    folder = Path(directory)
    path = folder / REPORT_FILE
    page = report_page(folder)
    if path.exists():
        with open_file(path) as file:
            head = file.read(HEADER)
        if GENERATOR.encode() not in head:
            raise ValueError(f"{path} was not written by oilfilm and will not be replaced")
    write_text(path, page)
    return path


def report_page(folder: Path) -> str:
    """The page of a result folder as text.

    Parameters
    ----------
    folder : Path
        Folder of the results.

    Returns
    -------
    str
        The page.
    """
    summary = read_summary(folder)
    case = summary["case"]
    if summary.get("kind") == "batch":
        title = summary.get("title")
        cards = batch.cards(summary)
        sections = batch.sections(summary, folder)
    else:
        title = case.get("title") or folder.name
        cards = html.cards(summary)
        sections = _sections(summary, folder)
    return (
        html.environment()
        .get_template("report.html")
        .render(
            summary=summary,
            title=str(title),
            source=case.get("source") if isinstance(case, dict) else None,
            cards=cards,
            warnings=summary.get("warnings", ()),
            sections=[section for section in sections if section[2].strip()],
        )
    )


def remarks(summary: dict[str, Any]) -> list[str]:
    """Messages of a summary that are no warnings.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results.

    Returns
    -------
    list[str]
        In their order.
    """
    warnings = summary.get("warnings", ())
    return [str(message) for message in summary["messages"] if message not in warnings]


def _sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of every part of a single case's page."""
    if simulations.is_simulation(summary):
        yield "dynamics", "Time simulation", simulations.dynamics_section(summary, folder)
    elif "supports" in summary:
        yield "shaft", "Shaft", simulations.shaft_section(summary, folder)
    else:
        yield from bearing.sections(summary, folder)
    yield "vibration", "Vibration", vibration_section(summary, folder)
    yield "more", "Further results", further_results(summary)
    yield "pictures", "Further pictures", _further_pictures(summary, folder)
    yield "input", "Input", bearing.input_tables(summary["case"])
    yield "notes", "Notes", html.notes(remarks(summary))
    yield "versions", "Versions and times", html.versions(summary)


def further_results(summary: dict[str, Any]) -> str:
    """Blocks that no other part of the page shows: their numbers and lists.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    str
        Markup.
    """
    is_simulation = simulations.is_simulation(summary)
    placed = bearing.PLACED | (simulations.PLACED if is_simulation else frozenset())
    if "supports" in summary:
        placed |= simulations.SHAFT_PLACED
    blocks = {
        key: value
        for key, value in summary.items()
        if key not in placed and value not in (None, [], {})
    }
    single = {key: value for key, value in blocks.items() if not html.is_large(value)}
    facts = [html.facts("", single)] if single and not bearing.is_single_contact(summary) else []
    for key, value in blocks.items():
        available = value.items() if isinstance(value, dict) else ()
        plain = {name: v for name, v in available if v is not None and not html.is_large(v)}
        unit = f" [{unit_symbol(key)}]" if unit_symbol(key) else ""
        facts += [html.facts(html.name_text(key) + unit, plain)] if plain else []
    lists = {key: value for key, value in blocks.items() if isinstance(value, list)}
    if "contacts" not in summary and not is_simulation:
        lists["balls"] = summary.get("balls") or []
    tables = [
        (f"{html.name_text(key)} ({len(rows)})", table)
        for key, rows in lists.items()
        if (table := _rows(rows)) is not None
    ]
    return html.render("bearing", "further", facts, tables)


def _rows(rows: list[Any]) -> html.Table | None:
    """A list of tables that all have single numbers, as one table; None of others."""
    if not rows or len(rows) > MAX_ROWS or not all(isinstance(row, dict) for row in rows):
        return None
    keys = [key for key in rows[0] if not any(html.is_large(row.get(key)) for row in rows)]
    if not keys:
        return None
    return html.Table(
        html.key_head(keys), [("", [html.text(row.get(key)) for key in keys]) for row in rows]
    )


def _further_pictures(summary: dict[str, Any], folder: Path) -> str:
    """Pictures that no part of the page places: slip maps, what later versions draw."""
    placed = bearing.known_pictures(summary) | simulations.pictures(summary)
    if "vibration" in summary:
        placed |= {f"{name}.png" for name in VIBRATION_PICTURES}
    files = sorted([*folder.glob("*.png"), *folder.glob("plots/*.png")])
    pictures = [html.picture(f, f.stem.replace("_", " ")) for f in files if f.name not in placed]
    return html.side_by_side(*pictures, kind="gallery")
