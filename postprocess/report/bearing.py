"""Parts of the page of a bearing or a single contact."""

from collections.abc import Iterator
from html import escape
from operator import itemgetter
from pathlib import Path
from typing import Any

from ehl.units import unit_symbol

from ..bearing.contacts import CONTACT_QUANTITY, REPORT_COLUMNS
from . import html
from .svg import stacked_bars

# blocks of a summary that have a place on the page
PLACED = frozenset(
    "oilfilm case converged messages ring equilibrium cage_speed_rpm balls contacts clearance "
    "life duty_cycle frequencies_Hz kinematic_frequencies_Hz torque_N_mm timing_s kind "
    "rows".split()
)
# input among the results of a rating
GIVEN = {"nominal_contact_angle_deg", "contamination_factor"}
TOP = ("schema_version", "title", "source", "assumed")
MODEL_NAMES = {"skf": "SKF", "houpert": "Houpert", "palmgren": "Palmgren", "yao": "Yao"}
FILM_PICTURES = {
    "film_per_azimuth": "Film thickness ball by ball, both races",
    "pressure_per_azimuth": "Pressure ball by ball, both races",
}
ERROR_BARS = (
    "Error bars enclose the distance to the film on an infinitely fine grid of the same equations."
)
BLOCKS = {
    "life": "Rating life",
    "duty_cycle": "Duty cycle",
    "clearance": "Clearance",
    "frequencies_Hz": "Frequencies [Hz]",
    "kinematic_frequencies_Hz": "Frequencies at the nominal contact angle [Hz]",
}


def input_tables(case: dict[str, Any]) -> str:
    """Every table of the case as run; what the case marks as assumed stands out."""
    assumed = frozenset(str(key) for key in case.get("assumed", ()))
    blocks = [html.facts(title, values, assumed, path) for title, values, path in _tables(case)]
    legend = '<span class="mark">*</span> assumed: no source gives this value'
    legend = f'<p class="small">{legend}</p>' if assumed else ""
    return legend + (html.side_by_side(*blocks) or '<div class="facts"></div>')


def _tables(case: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any], str]]:
    """Title, values and path of every table, those of lists last."""
    tables = {name: values for name, values in case.items() if name not in TOP}
    for name, values in tables.items():
        if isinstance(values, dict):
            # materials and oils by name
            if values and all(isinstance(inner, dict) for inner in values.values()):
                for inner, inner_values in values.items():
                    yield f"{name}: {inner}", inner_values, f"{name}.{inner}"
            else:
                yield name, values, name
    for name, rows in tables.items():
        for k, row in enumerate(rows if isinstance(rows, list) else (), 1):
            if isinstance(row, dict):
                yield f"{name} {k}", row, name


def cards(summary: dict[str, Any]) -> str:
    """The numbers that are looked at first."""
    contacts = [contact for contact in summary.get("contacts") or () if contact.get("loaded")]
    entries = _film_card(contacts or [summary])
    pressures = [contact.get("hertz_pressure_GPa") for contact in contacts or [summary]]
    largest = max((value for value in pressures if value is not None), default=None)
    if largest is not None:
        entries.append(html.card("largest Hertz pressure", html.number(largest, 4), "GPa"))
    if contacts:
        inner = sum(contact["race"] == "inner" for contact in contacts)
        entries.append(html.card("balls loaded", f"{inner} of {len(summary.get('balls') or ())}"))
    torque = (summary.get("torque_N_mm") or {}).get("total")
    hours = "basic_reference_rating_h"
    life = (summary.get("life") or {}).get(hours)
    cycle = (summary.get("duty_cycle") or {}).get(hours)
    for name, value, unit in (
        ("friction torque", torque, "N mm"),
        ("rating life L10h", life, "h"),
        ("L10h of the duty cycle", cycle, "h"),
        ("cage speed", summary.get("cage_speed_rpm"), "rpm"),
        ("load", summary.get("load_N"), "N"),
    ):
        if value is not None:
            entries.append(html.card(name, html.number(value, 4), unit))
    return html.side_by_side(*entries, kind="cards")


def _film_card(contacts: list[dict[str, Any]]) -> list[str]:
    """The thinnest film; dimensionless of a contact in Moes' groups."""
    for key, unit in (("film_minimum_um", "µm"), ("film_minimum_dimensionless", "a²/Rx")):
        films = [contact for contact in contacts if contact.get(key) is not None]
        if films:
            thinnest = min(films, key=itemgetter(key))
            where = f", ball {thinnest['ball']} {thinnest['race']}" if "ball" in thinnest else ""
            return [html.card(f"minimum film{where}", html.with_error(thinnest, key), unit)]
    return []


def sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of the parts that a bearing or a contact has."""
    plots = folder / "plots"
    if "contacts" in summary:
        yield "loads", "Load zone and equilibrium", _loads(summary, plots)
        yield "contacts", "Contacts", _contacts(summary["contacts"])
        yield "films", "Film and pressure", _films(plots)
    else:
        yield "films", "Film and pressure", _single_film(summary, plots)
    yield "torque", "Friction torque", _torque(summary.get("torque_N_mm") or {})
    blocks = []
    for key, title in BLOCKS.items():
        # the notes say why a value is null
        known = {
            name: value for name, value in (summary.get(key) or {}).items() if value is not None
        }
        if known.keys() - GIVEN:
            blocks.append(html.facts(title, known))
    yield "life", "Life, clearance, frequencies", html.side_by_side(*blocks)
    yield "convergence", "Convergence and uncertainty", _convergence(summary)


def _loads(summary: dict[str, Any], plots: Path) -> str:
    ring = summary.get("ring") or {}
    numbers = {key: value for key, value in ring.items() if key != "stiffness"}
    numbers["cage_speed_rpm"] = summary.get("cage_speed_rpm")
    blocks = html.side_by_side(html.facts("Inner ring", numbers))
    blocks += _stiffness(ring.get("stiffness") or {}) + _balls(summary.get("balls") or [])
    zone = html.picture(plots / "load_zone.png", "Contact loads around the bearing")
    return html.side_by_side(zone, f"<div>{blocks}</div>", kind="pair") if zone else blocks


def _stiffness(stiffness: dict[str, Any]) -> str:
    matrix = stiffness.get("matrix")
    order = stiffness.get("order")
    if not matrix or not order:
        return ""
    level = html.ROUND_OFF * max(abs(value) for row in matrix for value in row)
    rows = []
    for name, row in zip(order, matrix, strict=True):
        cells = [html.number(0.0 if abs(value) < level else value, 3) for value in row]
        rows.append(("", [escape(name), *cells]))
    head = [("", ""), *((escape(name), "") for name in order)]
    legend = html.note("d(load)/d(displacement): N/m, N/rad; moments N m/m, N m/rad")
    return f"<h3>Stiffness</h3>{html.table(head, rows, (0,))}{legend}"


def _balls(balls: list[dict[str, Any]]) -> str:
    keys = [
        key
        for key in (balls[0] if balls else ())
        if any(isinstance(ball.get(key), int | float) for ball in balls)
    ]
    if not keys:
        return ""
    rows = [
        (
            "",
            [
                html.figure(v) if isinstance(v, float) else html.text(v)
                for v in map(ball.get, keys)
            ],
        )
        for ball in balls
    ]
    return html.unfolding("Balls", html.table(html.key_head(keys), rows))


def _contacts(contacts: list[dict[str, Any]]) -> str:
    """One line per ball and race; columns without a value anywhere are left out."""
    keys = [
        key for key in REPORT_COLUMNS if any(contact.get(key) is not None for contact in contacts)
    ]
    head = [
        (_column_title(key), unit_symbol(key)) for key in ("ball", "azimuth_deg", "race", *keys)
    ]
    rows = []
    for contact in contacts:
        state = "" if contact.get("converged") in (None, True) else " !"
        state += "" if contact.get("resolved") in (None, True) else " ?"
        azimuth = html.number(contact["azimuth_deg"] % 360.0, 5)
        cells = [f"{contact['ball']}{state}", azimuth, escape(contact["race"])]
        cells += [html.result(contact, key) for key in keys]
        rows.append(("" if contact.get("loaded") else "off", cells))
    return html.table(head, rows, (2,)) + html.note(
        "grey: unloaded; !: not converged; ?: film not resolved. All columns are in contacts.csv."
    )


def _column_title(key: str) -> str:
    quantity = CONTACT_QUANTITY[key]
    return escape(quantity.short or quantity.title).replace("\N{SOFT HYPHEN}", "&shy;")


def known_pictures(summary: dict[str, Any]) -> set[str]:
    """Names of the pictures that the parts of the page place themselves."""
    names = {"load_zone", "contact", *FILM_PICTURES}
    for contact in summary.get("contacts") or ():
        names |= {f"{race}_ball{contact['ball']:02d}" for race in ("inner", "outer")}
    return {f"{name}.png" for name in names}


def is_single_contact(summary: dict[str, Any]) -> bool:
    """Whether a summary is that of `oilfilm contact`."""
    return "film_central_dimensionless" in summary


def _single_film(summary: dict[str, Any], plots: Path) -> str:
    """Picture and numbers of a single contact."""
    if not is_single_contact(summary):
        return ""
    content = html.picture(plots / "contact.png", "Film thickness and pressure of the contact")
    numbers = {
        key: value
        for key, value in summary.items()
        if key not in PLACED and not html.is_large(value)
    }
    return content + html.side_by_side(html.facts("Numbers", numbers))


def _films(plots: Path) -> str:
    """Pictures of the films of a bearing."""
    content = "".join(
        html.picture(plots / f"{name}.png", caption, wide=True)
        for name, caption in FILM_PICTURES.items()
    )
    maps = [
        html.picture(path, path.stem.replace("_ball", " race, ball ").replace("ball 0", "ball "))
        for path in sorted([*plots.glob("inner_ball*.png"), *plots.glob("outer_ball*.png")])
    ]
    if maps:
        title = f"Maps of every distinct contact ({len(maps)})"
        content += html.unfolding(title, html.side_by_side(*maps, kind="gallery"))
    return content


def _torque(torque: dict[str, Any]) -> str:
    """The models side by side: bars of their parts, and the numbers."""
    models = [
        (_words(name), _torque_parts(model), float(model["total"]))
        for name, model in (torque.get("models") or {}).items()
        if isinstance(model, dict) and isinstance(model.get("total"), int | float)
    ]
    if not models:
        return ""
    rows = []
    for name, parts, total in models:
        texts = (f"{escape(_words(part))} {html.number(v, 4)}" for part, v in parts.items())
        cells = [escape(name), html.number(total, 4), ", ".join(texts) or html.NOTHING]
        rows.append(("", cells))
    bars = f'<div class="scroll wide">{stacked_bars(models, "N mm")}</div>'
    caption = "Each model has its own assumptions; hover over a bar for its parts."
    picture = f"<figure>{bars}<figcaption>{caption}</figcaption></figure>"
    head = [("model", ""), ("total", "N mm"), ("parts", "N mm")]
    remarks = "; ".join(
        f"{html.name_text(key)} {html.text(value)}"
        for key, value in torque.items()
        if value is not None and not isinstance(value, dict | list)
    )
    return picture + html.table(head, rows, (0, 2)) + (f"<p>{remarks}</p>" if remarks else "")


def _torque_parts(model: dict[str, Any]) -> dict[str, float]:
    """Parts of a sum [N mm]; round-off beside the largest of them is 0."""
    parts = {
        name: float(value)
        for name, value in model.items()
        if name != "total" and isinstance(value, int | float)
    }
    return dict(zip(parts, html.without_noise(list(parts.values())), strict=True))


def _words(name: str) -> str:
    return MODEL_NAMES.get(name, name.replace("_", " "))


def _convergence(summary: dict[str, Any]) -> str:
    """Residual of the equilibrium, and box, nodes and error bars of every distinct film."""
    content = ""
    if "equilibrium" in summary:
        content = html.side_by_side(html.facts("Equilibrium", summary["equilibrium"]))
    distinct: dict[tuple[str, ...], dict[str, Any]] = {}
    for contact in summary.get("contacts") or ():
        if contact.get("film_minimum_um") is not None:
            names = ("film_minimum_um", "film_central_um", "load_N")
            values = (f"{contact[name]:.6g}" for name in names)
            distinct.setdefault((contact["race"], *values), contact)
    if not distinct:
        return content
    head = [("ball, race", ""), ("nodes", ""), ("box", "semi-axes")]
    head += [("central film", "± %"), ("minimum film", "± %"), ("converged", ""), ("resolved", "")]
    rows = [("", _convergence_cells(contact)) for contact in distinct.values()]
    return content + html.table(head, rows, (0,)) + html.note(ERROR_BARS)


def _convergence_cells(contact: dict[str, Any]) -> list[str]:
    start, end, half_width = (html.number(length, 3) for length in contact["domain"])
    return [
        f"{contact['ball']} {contact['race']}",
        " × ".join(map(str, contact["points"])),
        f"{start} … {end}; ±{half_width}",
        *(_relative_error(contact, f"film_{film}") for film in ("central", "minimum")),
        *(html.text(contact.get(state)) for state in ("converged", "resolved")),
    ]


def _relative_error(contact: dict[str, Any], film: str) -> str:
    value = contact[f"{film}_um"]
    error = contact[f"{film}_uncertainty_um"]
    return html.NOTHING if not value else html.number(100.0 * error / value, 2)
