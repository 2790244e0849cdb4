"""Parts of the page of a batch."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from markupsafe import Markup

from oilfilm.ehl.units import unit_symbol

from ..batch.results import MAIN_QUANTITY
from . import html

MAX_ROWS = 500  # points listed; the CSV has all
# keys of a point that are no results
STATE = ("point", "block", "keys", "status", "converged", "resumed", "message", "key", "file")
INDICES = ("first", "total")
EFFECTS = {
    "mean magnitude": "mean_magnitude",
    "from": "mean_magnitude_low",
    "to": "mean_magnitude_high",
    "mean": "mean",
    "standard deviation": "standard_deviation",
}
BANDS = {
    "5 %": "q05",
    "median": "q50",
    "95 %": "q95",
    "mean": "mean",
    "standard deviation": "standard_deviation",
}


def cards(summary: dict[str, Any]) -> str:
    """How many points there are, and the ends of the main results.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    str
        Markup.
    """
    points = summary["points"] or []
    entries = [("points", str(_count(summary)), "")]
    if summary["failed"]:
        entries.append(("without a result", str(summary["failed"]), ""))
    for key, name in (("film_minimum_um", "minimum film"), ("torque_N_mm", "torque")):
        values = [point[key] for point in points if point.get(key) is not None]
        if values:
            low, high = (html.number(end, 4) for end in (min(values), max(values)))
            entries.append((name, Markup("{} … {}").format(low, high), unit_symbol(key)))
    return html.render("pieces", "cards", entries)


def _count(summary: dict[str, Any]) -> int:
    """Points of a batch, also where they are too many to be listed."""
    return summary["counts"]["points"] if summary["points"] is None else len(summary["points"])


def sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of every part.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.
    folder : Path
        Folder of the results.

    Yields
    ------
    Iterator[tuple[str, str, str]]
        Anchor, title and content of a part.
    """
    pictures = [
        html.picture(path, path.stem.replace("_", " ").capitalize(), wide=True)
        for path in sorted(folder.glob("plots/*.png"))
    ]
    numbers = {"case": summary["case"], "keys": summary["keys"], "points": _count(summary)}
    if summary.get("assumed"):
        numbers["assumed in the case"] = summary["assumed"]
    sweep = html.render("batch", "sweep", html.facts("", numbers), str(summary.get("sweep", "")))
    yield "input", "Sweep", sweep
    yield "plots", "Results over the keys", Markup().join(pictures)
    yield "sensitivity", "What uncertain input does", uncertainty(summary)
    yield "points", "Points", listed_points(summary)
    yield "notes", "Notes", html.notes(summary["messages"])
    yield "versions", "Versions and times", html.versions(summary)


def listed_points(summary: dict[str, Any]) -> str:
    """One line for each point: varied keys, main results, state; nothing of a batch too large.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    str
        Markup.
    """
    points = summary["points"] or []
    if not points:
        return ""
    keys = [
        key
        for key in summary["keys"]
        if len({str(point["keys"].get(key)) for point in points}) > 1
    ]
    names = [
        name
        for name in dict.fromkeys(name for point in points for name in point)
        if name not in STATE
        and "_uncertainty_" not in name
        and any(point.get(name) is not None for point in points)
    ]
    key_columns = [(html.name_text(key.rpartition(".")[2]), unit_symbol(key)) for key in keys]
    titles = [(html.title_text(name, MAIN_QUANTITY), unit_symbol(name)) for name in names]
    head = [("#", ""), *key_columns, *titles, ("state", "")]
    rows = []
    for point in points[:MAX_ROWS]:
        cells = [str(point["point"]), *(html.text(point["keys"].get(key)) for key in keys)]
        cells += [html.result(point, name) for name in names]
        state = "" if point["converged"] else "not converged"
        cells.append(state if point["status"] == "done" else point["status"])
        rows.append(("" if point["converged"] else "off", cells))
    table = html.Table(head, rows, (len(head) - 1,))
    return html.render("batch", "points", table, len(points) - MAX_ROWS)


def uncertainty(summary: dict[str, Any]) -> str:
    """Differences, bands and indices, as far as there are any.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    str
        Markup.
    """
    others = (_bands(summary), _sobol(summary), _morris(summary))
    return html.render("batch", "uncertainty", _sensitivity(summary), others)


def _named(name: str) -> str:
    """A result in words, its unit in brackets."""
    return f"{html.name_text(name)} [{unit_symbol(name) or '–'}]"


def _titles(*titles: str) -> list[tuple[str, str]]:
    """Heads of columns without units."""
    return [(title, "") for title in titles]


def _sobol(summary: dict[str, Any]) -> tuple[str, html.Table | None]:
    """Sobol indices with their intervals, a line for each result and key."""
    block = summary.get("sobol_indices") or {}
    rows = [
        ("", [html.name_text(name), key, *(cell for own in INDICES for cell in _index(row, own))])
        for name, keys in block.get("results", {}).items()
        if isinstance(keys, dict)
        for key, row in keys.items()
    ]
    titles = ("", "key", "first index", "95 % interval", "total index", "95 % interval")
    title = f"Sobol indices from {block.get('points')} points"
    return title, html.Table(_titles(*titles), rows, (0, 1)) if rows else None


def _index(row: dict[str, Any], name: str) -> tuple[str, str]:
    """An index and the ends of its interval."""
    value, low, high = (
        html.NOTHING if row[key] is None else html.number(row[key], 2)
        for key in (name, f"{name}_low", f"{name}_high")
    )
    return value, Markup("{} … {}").format(low, high)


def _morris(summary: dict[str, Any]) -> tuple[str, html.Table | None]:
    """Morris' effects, a line for each result and key."""
    block = summary.get("morris") or {}
    rows = [
        ("", [_named(name), key, *(html.number(row[own], 3) for own in EFFECTS.values())])
        for name, keys in block.get("results", {}).items()
        for key, row in keys.items()
        if key != "trajectories"
    ]
    title = f"Morris' effects over the ranges, {block.get('trajectories')} trajectories"
    return title, html.Table(_titles("", "key", *EFFECTS), rows, (0, 1)) if rows else None


def _sensitivity(summary: dict[str, Any]) -> html.Table | None:
    """Logarithmic sensitivities, key by key."""
    rows = summary.get("sensitivity") or []
    names = list(dict.fromkeys(name for row in rows for name in row["results"]))
    lines = []
    for row in rows:
        cells = [_sensitivity_cell(row["results"].get(name)) for name in names]
        lines.append(("", [row["key"], html.text(row["value"]), *cells]))
    head = _titles("key", "value", *map(html.name_text, names))
    return html.Table(head, lines, (0,)) if rows else None


def _sensitivity_cell(cell: dict[str, Any] | None) -> str:
    if cell is None:
        return html.NOTHING
    return html.number(cell["sensitivity"], 3) + (" ~" if cell["resolved"] is False else "")


def _bands(summary: dict[str, Any]) -> tuple[str, html.Table | None]:
    """Quantiles over the sampled points."""
    bands = summary.get("bands") or {}
    rows = [
        ("", [_named(key), *(html.number(band[own], 4) for own in BANDS.values())])
        for key, band in bands.items()
    ]
    count = max((band["points"] for band in bands.values()), default=0)
    title = f"Bands over {count} sampled points"
    return title, html.Table(_titles("", *BANDS), rows, (0,)) if rows else None
