"""Parts of the page of a batch."""

from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

from .bearing import with_error
from .html import (
    NOTHING,
    card,
    facts,
    items,
    name_text,
    number,
    picture,
    table,
    text,
    unit_text,
    versions,
)

MOST_ROWS = 500  # points listed; the CSV has all
STATE = ("point", "block", "keys", "status", "converged", "resumed", "message", "file")


def cards(summary: dict[str, Any]) -> str:
    """How many points there are, and the ends of the main results."""
    points = summary["points"]
    found = [card("points", str(len(points)))]
    found += [card("without a result", str(summary["failed"]))] if summary["failed"] else []
    for key, name in (("film_minimum_um", "minimum film"), ("torque_N_mm", "torque")):
        values = [point[key] for point in points if point.get(key) is not None]
        if values:
            found.append(
                card(name, f"{number(min(values), 4)} … {number(max(values), 4)}", unit_text(key))
            )
    return f'<div class="cards">{"".join(found)}</div>'


def sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of every part."""
    pictures = [
        picture(path, path.stem.replace("_", " ").capitalize(), wide=True)
        for path in sorted(folder.glob("plots/*.png"))
    ]
    yield "input", "Sweep", _sweep(summary)
    yield "plots", "Results over the keys", "".join(pictures)
    yield "sensitivity", "What uncertain input does", _sensitivity(summary) + _bands(summary)
    yield "points", "Points", _points(summary)
    notes = [str(message) for message in summary["messages"]]
    yield "notes", "Notes", f'<div class="notes small">{items(notes)}</div>' if notes else ""
    yield "versions", "Versions and times", versions(summary)


def _sweep(summary: dict[str, Any]) -> str:
    """The sweep file as run, and the keys that the case marks assumed."""
    numbers = {"case": summary["case"], "keys": summary["keys"], "points": len(summary["points"])}
    assumed = summary.get("assumed") or []
    numbers |= {"assumed in the case": assumed} if assumed else {}
    source = f'<pre class="small scroll">{escape(str(summary.get("sweep", "")))}</pre>'
    return (
        f'<div class="facts single">{facts("", numbers)}</div>'
        + f"<details open><summary>The sweep file</summary>{source}</details>"
    )


def _points(summary: dict[str, Any]) -> str:
    """One line for each point: varied keys, main results, state."""
    points = summary["points"]
    keys = [
        key
        for key in summary["keys"]
        if len({str(point["keys"].get(key)) for point in points}) > 1
    ]
    names = list(dict.fromkeys(name for point in points for name in point if name not in STATE))
    names = [
        name
        for name in names
        if "_uncertainty_" not in name and any(point.get(name) is not None for point in points)
    ]
    head = [("#", "")]
    head += [(name_text(key.rpartition(".")[2]), unit_text(key)) for key in keys]
    head += [(name_text(name), unit_text(name)) for name in names] + [("state", "")]
    rows = []
    for point in points[:MOST_ROWS]:
        state = (
            point["status"]
            if point["status"] != "done"
            else ""
            if point["converged"]
            else "not converged"
        )
        cells = [str(point["point"]), *(text(point["keys"].get(key)) for key in keys)]
        films = (
            with_error(point, name) if name.startswith("film_") else _figure(point.get(name))
            for name in names
        )
        cells += [*films, escape(state)]
        rows.append(("" if point["converged"] else "off", cells))
    more = (
        f"<p>{len(points) - MOST_ROWS} more points are in batch.csv.</p>"
        if len(points) > MOST_ROWS
        else ""
    )
    return table(head, rows, (len(head) - 1,)) + more


def _sensitivity(summary: dict[str, Any]) -> str:
    """Logarithmic sensitivities, key by key."""
    rows = summary.get("sensitivity") or []
    names = list(dict.fromkeys(name for row in rows for name in row["results"]))
    if not rows:
        return ""
    lines = []
    for row in rows:
        cells = (row["results"].get(name) for name in names)
        shown = [
            NOTHING
            if c is None
            else number(c["sensitivity"], 3) + (" ~" if c["resolved"] is False else "")
            for c in cells
        ]
        lines.append(("", [escape(row["key"]), text(row["value"]), *shown]))
    head = [("key", ""), ("value", ""), *((name_text(name), "") for name in names)]
    note = "Percent by which a result changes for one percent of the key, by finite differences; ~: within the error bars."
    return table(head, lines, (0,)) + f'<p class="quiet small">{note}</p>'


def _bands(summary: dict[str, Any]) -> str:
    """Quantiles over the sampled points."""
    spread = summary.get("bands") or {}
    if not spread:
        return ""
    head = [
        ("", ""),
        ("5 %", ""),
        ("median", ""),
        ("95 %", ""),
        ("mean", ""),
        ("standard deviation", ""),
    ]
    names = ("q05", "q50", "q95", "mean", "standard_deviation")
    rows = [
        ("", [f"{name_text(key)} [{unit_text(key) or '–'}]", *(number(band[n], 4) for n in names)])
        for key, band in spread.items()
    ]
    count = max(band["points"] for band in spread.values())
    return f"<h3>Bands over {count} sampled points</h3>" + table(head, rows, (0,))


def _figure(value: Any) -> str:
    return (
        number(float(value), 4)
        if isinstance(value, int | float)
        else NOTHING
        if value is None
        else text(value)
    )
