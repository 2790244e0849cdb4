"""Parts of the page of a batch."""

from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

from ehl.units import unit_symbol

from ..batch.main_results import MAIN_QUANTITY
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
    """How many points there are, and the ends of the main results."""
    points = summary["points"] or []
    entries = [html.card("points", str(_count(summary)))]
    if summary["failed"]:
        entries.append(html.card("without a result", str(summary["failed"])))
    for key, name in (("film_minimum_um", "minimum film"), ("torque_N_mm", "torque")):
        values = [point[key] for point in points if point.get(key) is not None]
        if values:
            ends = f"{html.number(min(values), 4)} … {html.number(max(values), 4)}"
            entries.append(html.card(name, ends, unit_symbol(key)))
    return html.side_by_side(*entries, kind="cards")


def _count(summary: dict[str, Any]) -> int:
    """Points of a batch, also where they are too many to be listed."""
    return summary["counts"]["points"] if summary["points"] is None else len(summary["points"])


def sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of every part."""
    pictures = [
        html.picture(path, path.stem.replace("_", " ").capitalize(), wide=True)
        for path in sorted(folder.glob("plots/*.png"))
    ]
    yield "input", "Sweep", _sweep(summary)
    yield "plots", "Results over the keys", "".join(pictures)
    yield "sensitivity", "What uncertain input does", _uncertainty(summary)
    yield "points", "Points", _points(summary)
    yield "notes", "Notes", html.notes(summary["messages"])
    yield "versions", "Versions and times", html.versions(summary)


def _sweep(summary: dict[str, Any]) -> str:
    """The sweep file as run, and the keys that the case marks assumed."""
    numbers = {"case": summary["case"], "keys": summary["keys"], "points": _count(summary)}
    if summary.get("assumed"):
        numbers["assumed in the case"] = summary["assumed"]
    source = f'<pre class="small scroll">{escape(str(summary.get("sweep", "")))}</pre>'
    return html.side_by_side(html.facts("", numbers), kind="facts single") + html.unfolding(
        "The sweep file", source, "open"
    )


def _points(summary: dict[str, Any]) -> str:
    """One line for each point: varied keys, main results, state; nothing of a batch too large."""
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
        cells.append(state if point["status"] == "done" else escape(point["status"]))
        rows.append(("" if point["converged"] else "off", cells))
    more = len(points) - MAX_ROWS
    listing = html.table(head, rows, (len(head) - 1,))
    return listing + (f"<p>{more} more points are in batch.csv.</p>" if more > 0 else "")


def _uncertainty(summary: dict[str, Any]) -> str:
    """Differences, bands and indices, as far as there are any."""
    parts = (_sensitivity(summary), _bands(summary), _sobol(summary), _morris(summary))
    return "".join(parts)


def _sobol(summary: dict[str, Any]) -> str:
    """Sobol indices with their intervals, a line for each result and key."""
    block = summary.get("sobol_indices") or {}
    rows = []
    for name, keys in block.get("results", {}).items():
        if not isinstance(keys, dict):
            continue
        for key, row in keys.items():
            ends = [
                f"{_index(row[f'{own}_low'])} … {_index(row[f'{own}_high'])}" for own in INDICES
            ]
            first, total = (_index(row[own]) for own in INDICES)
            cells = [html.name_text(name), escape(key), first, ends[0], total, ends[1]]
            rows.append(("", cells))
    if not rows:
        return ""
    titles = ("", "key", "first index", "95 % interval", "total index", "95 % interval")
    head = f"<h3>Sobol indices from {block['points']} points</h3>"
    return head + html.table([(title, "") for title in titles], rows, (0, 1))


def _index(value: float | None) -> str:
    return html.NOTHING if value is None else html.number(value, 2)


def _morris(summary: dict[str, Any]) -> str:
    """Morris' effects, a line for each result and key."""
    block = summary.get("morris") or {}
    rows = []
    for name, keys in block.get("results", {}).items():
        for key, row in keys.items():
            if key != "trajectories":
                numbers = [html.number(row[own], 3) for own in EFFECTS.values()]
                title = f"{html.name_text(name)} [{unit_symbol(name) or '–'}]"
                rows.append(("", [title, escape(key), *numbers]))
    if not rows:
        return ""
    head = f"<h3>Morris' effects over the ranges, {block['trajectories']} trajectories</h3>"
    return head + html.table([(title, "") for title in ("", "key", *EFFECTS)], rows, (0, 1))


def _sensitivity(summary: dict[str, Any]) -> str:
    """Logarithmic sensitivities, key by key."""
    rows = summary.get("sensitivity") or []
    if not rows:
        return ""
    names = list(dict.fromkeys(name for row in rows for name in row["results"]))
    lines = []
    for row in rows:
        cells = [_sensitivity_cell(row["results"].get(name)) for name in names]
        lines.append(("", [escape(row["key"]), html.text(row["value"]), *cells]))
    head = [("key", ""), ("value", ""), *((html.name_text(name), "") for name in names)]
    return html.table(head, lines, (0,)) + html.note(
        "Percent by which a result changes for one percent of the key, by finite differences; "
        "~: within the error bars."
    )


def _sensitivity_cell(cell: dict[str, Any] | None) -> str:
    if cell is None:
        return html.NOTHING
    return html.number(cell["sensitivity"], 3) + (" ~" if cell["resolved"] is False else "")


def _bands(summary: dict[str, Any]) -> str:
    """Quantiles over the sampled points."""
    bands = summary.get("bands") or {}
    if not bands:
        return ""
    rows = []
    for key, band in bands.items():
        name = f"{html.name_text(key)} [{unit_symbol(key) or '–'}]"
        rows.append(("", [name, *(html.number(band[part], 4) for part in BANDS.values())]))
    count = max(band["points"] for band in bands.values())
    head = [("", ""), *((title, "") for title in BANDS)]
    return f"<h3>Bands over {count} sampled points</h3>" + html.table(head, rows, (0,))
