"""Parts of the page on a time simulation, on vibration, and on a shaft."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from markupsafe import Markup

from oilfilm.ehl.units import unit_symbol

from ..batch.results import main_results
from ..dynamics.results import BALLS, RACES, RUN, SPEEDS, STARTS, STATES
from ..quantities import FREQUENCIES, Quantity, by_key
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
SPEED_PICTURES = 2  # of the pictures, beside the speeds
COUNTS = "steps rejected_steps evaluations equations".split()
PLACED = frozenset(
    (
        *(row.key for row in (*RUN, *SPEEDS)),
        *COUNTS,
        *"equation_counts energy starts states_found".split(),
    )
)
VIBRATION_PICTURES = {
    "spectrum": "Velocity over frequency, with the lines that one expects of the surfaces",
    "orders": "Velocity over the order of the shaft",
    "envelope": "Envelope of the acceleration, and the passing frequencies",
    "waterfall": "Acceleration over time or speed, and frequency",
    "time": "Acceleration, velocity and displacement over the last turns",
    "ball_loads": "Loads of the balls",
}
SHAFT_PICTURES = {
    "shaft": "Shaft with its bearings and loads, and its deflection",
    "campbell": "Natural frequencies over the speed",
}
SHAFT_PLACED = frozenset(
    "shaft supports bearings springs system critical_speeds_rpm campbell heat".split()
)
LINES = (
    "source name order_number direction frequency_Hz displacement_um velocity_um_s "
    "acceleration_m_s2"
).split()


def is_simulation(summary: dict[str, Any]) -> bool:
    """True of a summary of `oilfilm dynamics`.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    bool
        True if it is.
    """
    return "equation_counts" in summary


def pictures(summary: dict[str, Any]) -> set[str]:
    """Pictures that this part of the page shows.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    set[str]
        Names of PNG files.
    """
    if "supports" in summary:
        return {f"{name}.png" for name in SHAFT_PICTURES}
    return {f"{name}.png" for name in PICTURES} if is_simulation(summary) else set()


def dynamics_section(summary: dict[str, Any], folder: Path) -> str:
    """Speeds and slip, energies, balls, the ends of several starts, pictures.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.
    folder : Path
        Folder of the results.

    Returns
    -------
    str
        Markup.
    """
    if not is_simulation(summary):
        return ""
    speeds = {key: summary.get(key) for key in by_key(SPEEDS)}
    names = {key: row.title for key, row in by_key((*RUN, *SPEEDS)).items()}
    run = {key: summary.get(key) for key in (*by_key(RUN), *COUNTS)}
    facts = [html.facts("Speeds and slip", speeds, names=names)]
    energy = summary.get("energy") or {}
    for key, title in (("input_J", "Put in [J]"), ("dissipated_J", "Lost [J]")):
        facts += [html.facts(title, energy[key])] if energy.get(key) else []
    rest = {key: value for key, value in energy.items() if not isinstance(value, dict)}
    facts += [html.facts("Kept", rest)] if rest else []
    facts.append(html.facts("Run", run, names=names))
    facts.append(html.facts("Equations", summary.get("equation_counts") or {}))
    shown = [
        html.picture(folder / f"{name}.png", caption, wide=True)
        for name, caption in PICTURES.items()
    ]
    return html.render(
        "over_time",
        "dynamics",
        facts,
        shown[:SPEED_PICTURES],
        _frequencies(summary.get("frequencies_Hz") or {}),
        _balls(summary.get("balls") or []),
        _starts(summary.get("starts") or []),
        shown[SPEED_PICTURES:],
    )


def _head(rows: Iterable[Quantity], before: str = "") -> list[tuple[str, str]]:
    """Titles and units of columns of quantities."""
    return [(f"{before}{row.title}", unit_symbol(row.key)) for row in rows]


def _frequencies(result: dict[str, Any]) -> html.Table | None:
    """Frequencies by their names [Hz], without and with slip; None without them."""
    available = {name: values for name, values in result.items() if isinstance(values, dict)}
    if not available:
        return None
    head = [("frequencies", "Hz"), *((html.name_text(name), "Hz") for name in available)]
    rows = []
    for row in FREQUENCIES:
        values = [of.get(row.key) for of in available.values()]
        if any(value is not None for value in values):
            name = f"{row.title} {row.symbol}" if row.symbol.isupper() else row.title
            rows.append(("", [name, *map(html.figure, values)]))
    return html.Table(head, rows, (0,))


def _balls(balls: list[dict[str, Any]]) -> html.Table | None:
    """Loads, sliding, friction and contact of every ball at both races, the pocket's load."""
    head = [("ball", "")]
    for race in ("inner", "outer"):
        head += [*_head(RACES, f"{race}: "), (f"{race}: free, contact, impact", "%")]
    rows = []
    for ball in balls:
        cells = [html.text(ball.get("ball"))]
        for race in ("inner", "outer"):
            result = ball.get(race) or {}
            cells += [html.figure(result.get(row.key)) for row in RACES]
            cells.append(Markup(", ").join(_percent(result.get(state)) for state in STATES))
        rows.append(("", cells + [html.figure(ball.get(row.key)) for row in BALLS]))
    return html.Table([*head, *_head(BALLS)], rows) if rows else None


def _percent(share: Any) -> str:
    return html.number(100.0 * share, 3) if isinstance(share, int | float) else html.NOTHING


def _starts(starts: list[dict[str, Any]]) -> html.Table | None:
    """Ends of several starts; None of one."""
    rows = [
        ("", [str(k), *(html.figure(start.get(row.key)) for row in STARTS)])
        for k, start in enumerate(starts, 1)
    ]
    return html.Table([("start", ""), *_head(STARTS)], rows) if len(starts) > 1 else None


def vibration_section(summary: dict[str, Any], folder: Path) -> str:
    """Levels with their reference, bands, lines, pictures.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.
    folder : Path
        Folder of the results.

    Returns
    -------
    str
        Markup.
    """
    result = summary.get("vibration")
    if not isinstance(result, dict):
        return ""
    single = {key: value for key, value in result.items() if not isinstance(value, list | dict)}
    frequencies = (summary.get("frequencies_Hz") or {}).items()
    lines = result.get("lines") or ()
    return html.render(
        "over_time",
        "vibration",
        html.facts("Levels", single),
        _bands(result),
        [
            html.facts(f"Frequencies, {name.replace('_', ' ')} [Hz]", values)
            for name, values in frequencies
            if isinstance(values, dict)
        ],
        html.Table(
            html.key_head(LINES),
            [("", [html.text(line.get(key)) for key in LINES]) for line in lines],
        ),
        [
            html.picture(folder / "plots" / f"{name}.png", caption, wide=True)
            for name, caption in VIBRATION_PICTURES.items()
        ],
    )


def _bands(result: dict[str, Any]) -> html.Table | None:
    """Velocity in the bands of ISO 15242; None without them."""
    levels, scaled, ends = (result.get(key) or {} for key in ("bands_um_s", "anderon", "bands_Hz"))
    rows = [
        ("", [name, *map(html.text, (*(ends.get(name) or (None, None)), level, scaled.get(name)))])
        for name, level in levels.items()
    ]
    head = [("band", ""), ("from", "Hz"), ("to", "Hz"), ("velocity", "µm/s"), ("anderon", "")]
    return html.Table(head, rows) if rows else None


def shaft_section(summary: dict[str, Any], folder: Path) -> str:
    """Bearings of a shaft, the system, heat between bearings, pictures.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.
    folder : Path
        Folder of the results.

    Returns
    -------
    str
        Markup; empty of other results.
    """
    if "supports" not in summary:
        return ""
    head = [("bearing", ""), ("x", "mm"), ("F_x", "N"), ("F_y", "N"), ("F_z", "N")]
    head += [("growth", "µm"), ("least film", "µm"), ("torque", "N mm"), ("film at", "°C")]
    films = (summary.get("heat") or {}).get("film_C") or []
    rows = []
    for k, (support, bearing) in enumerate(
        zip(summary["supports"], summary["bearings"], strict=True)
    ):
        main = main_results(bearing)
        numbers = [support["x_mm"], *support["force_N"], support.get("growth_um")]
        numbers += [main.get("film_minimum_um"), main.get("torque_N_mm")]
        numbers.append(films[k] if k < len(films) else None)
        cells = [html.NOTHING if n is None else html.number(n, 4) for n in numbers]
        rows.append(("", [support["bearing"], *cells]))
    critical = (summary.get("critical_speeds_rpm") or [None])[0]
    facts = [html.facts("System", summary["system"] | {"critical_speed_rpm": critical})]
    for path in (summary.get("heat") or {}).get("paths", ()):
        pair = " to ".join(str(k) for k in path["bearings"])
        shown = {key: path[key] for key in ("heat_W", "conductance_W_K")}
        facts.append(html.facts(f"Heat along the {path['path']}, bearing {pair}", shown))
    pictures = [html.picture(folder / f"{n}.png", text) for n, text in SHAFT_PICTURES.items()]
    table = html.render("pieces", "table", html.Table(head, rows, (0,)))
    parts = (table, html.side_by_side(*facts), html.side_by_side(*pictures, kind="gallery"))
    return Markup("").join(parts)
