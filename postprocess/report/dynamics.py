"""Part of the page on a time simulation."""

from html import escape
from pathlib import Path
from typing import Any

from ehl.units import unit_symbol

from ..dynamics.quantities import BALLS, RACES, RUN, SPEEDS, STARTS, STATES
from ..quantities import FREQUENCIES, by_key
from . import html

PICTURES = {
    "speeds": "Cage and balls about the axis, and their slip against rolling at the contact "
    "angles of each moment",
    "spin": "Balls about their own axes, and what they lack of rolling",
    "sliding": "Sliding and traction of ball 1 around the bearing, over its last turns",
    "forces": "Loads and friction of ball 1, over its last turns",
    "states": "Separation, contact and impact of each ball, over the last turns",
    "orbits": "Paths of the centres of inner ring and cage",
    "spectrum": "Spectrum of the inner ring",
    "energy": "Work put in, energy stored and lost, and what is left over",
}
OF_SPEED = 2  # of the pictures, beside the speeds
COUNTS = "steps rejected_steps evaluations equations".split()
PLACED = frozenset(
    (
        *(row.key for row in (*RUN, *SPEEDS)),
        *COUNTS,
        *"equation_counts energy starts states_found".split(),
    )
)
OF_RACES = "sliding and friction at the centres of the contacts, while they are loaded"
OF_SPEEDS = (
    "Speeds are means over the last third of the time, intervals half widths of 95 %; kinematic: "
    "without sliding, at the mean contact angle that came out."
)


def is_simulation(summary: dict[str, Any]) -> bool:
    """Whether a summary is that of `oilfilm dynamics`."""
    return "equation_counts" in summary


def pictures(summary: dict[str, Any]) -> set[str]:
    """Names of the pictures that this part places."""
    return {f"{name}.png" for name in PICTURES} if is_simulation(summary) else set()


def dynamics_section(summary: dict[str, Any], folder: Path) -> str:
    """Speeds and slip, energies, balls, the ends of several starts, pictures."""
    if not is_simulation(summary):
        return ""
    speeds = {key: summary.get(key) for key in by_key(SPEEDS)}
    names = {key: row.title for key, row in by_key((*RUN, *SPEEDS)).items()}
    counts = summary.get("equation_counts") or {}
    run = {key: summary.get(key) for key in (*by_key(RUN), *COUNTS)}
    blocks = [html.facts("Speeds and slip", speeds, names=names)]
    energy = summary.get("energy") or {}
    for key, title in (("input_J", "Put in [J]"), ("dissipated_J", "Lost [J]")):
        blocks.append(html.facts(title, energy.get(key) or {}) if energy.get(key) else "")
    rest = {key: value for key, value in energy.items() if not isinstance(value, dict)}
    blocks += [html.facts("Kept", rest)] if rest else []
    blocks += [html.facts("Run", run, names=names), html.facts("Equations", counts)]
    shown = [
        html.picture(folder / f"{name}.png", caption, wide=True)
        for name, caption in PICTURES.items()
    ]
    return (
        html.side_by_side(*blocks)
        + html.note(OF_SPEEDS)
        + "".join(shown[:OF_SPEED])
        + _frequencies(summary.get("frequencies_Hz") or {})
        + _balls(summary.get("balls") or [])
        + _starts(summary.get("starts") or [])
        + "".join(shown[OF_SPEED:])
    )


def _frequencies(found: dict[str, Any]) -> str:
    """Frequencies by their names [Hz], without and with slip."""
    known = {name: values for name, values in found.items() if isinstance(values, dict)}
    if not known:
        return ""
    head = [("frequencies", "Hz"), *((html.name_text(name), "Hz") for name in known)]
    rows = []
    for row in FREQUENCIES:
        values = [of.get(row.key) for of in known.values()]
        if any(value is not None for value in values):
            name = f"{row.title} {row.symbol}" if row.symbol.isupper() else row.title
            rows.append(("", [escape(name), *(html.figure(value) for value in values)]))
    return html.table(head, rows, (0,))


def _balls(balls: list[dict[str, Any]]) -> str:
    """Loads, sliding, friction and contact of every ball at both races, the pocket's load."""
    if not balls:
        return ""
    races = ("inner", "outer")
    head = [("ball", "")]
    for race in races:
        head += [(escape(f"{race}: {row.title}"), unit_symbol(row.key)) for row in RACES]
        head.append((f"{race}: free, contact, impact", "%"))
    head += [(escape(row.title), unit_symbol(row.key)) for row in BALLS]
    rows = []
    for ball in balls:
        cells = [html.text(ball.get("ball"))]
        for race in races:
            found = ball.get(race) or {}
            cells += [html.figure(found.get(row.key)) for row in RACES]
            cells.append(", ".join(_percent(found.get(state)) for state in STATES))
        rows.append(("", cells + [html.figure(ball.get(row.key)) for row in BALLS]))
    title = f"Loads, sliding and friction of the balls ({len(balls)})"
    return html.unfolding(title, html.table(head, rows) + html.note(OF_RACES), "open")


def _percent(share: Any) -> str:
    return html.number(100.0 * share, 3) if isinstance(share, int | float) else html.NOTHING


def _starts(starts: list[dict[str, Any]]) -> str:
    """Ends of several starts, where there are."""
    if len(starts) < 2:
        return ""
    head = [("start", ""), *((escape(row.title), unit_symbol(row.key)) for row in STARTS)]
    rows = [
        ("", [str(k), *(html.figure(start.get(row.key)) for row in STARTS)])
        for k, start in enumerate(starts, 1)
    ]
    return f"<h3>Ends of several starts</h3>{html.table(head, rows)}"
