"""Parts of the page of a bearing or a single contact, with the friction torque."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from markupsafe import Markup

from oilfilm.bearing.torque.models import ModelTorque
from oilfilm.ehl.units import to_si, unit_symbol

from ..bearing.bearing_quantities import (
    CLEARANCE,
    DUTY_CYCLE,
    FILM_LIFE,
    LIFE_RATING,
    LOAD_RATING,
    torque_model,
)
from ..bearing.contact_quantities import CONTACT_QUANTITY, MOTION_COLUMNS, REPORT_COLUMNS
from ..bearing.plots import KINDS, torque_svg
from ..bearing.torque import CHURNING_SHARE, shown_titles
from . import html
from .html import estimated_keys

KIND_OF_PART = {part: kind for kind, _, parts in KINDS for part in parts}
# blocks of a summary that have a place on the page
PLACED = frozenset(
    "oilfilm case converged messages warnings ring equilibrium cage_speed_rpm balls contacts "
    "clearance life duty_cycle frequencies_Hz kinematic_frequencies_Hz torque_N_mm timing_s kind "
    "rows vibration".split()
)
# input among the results of a rating
INPUT_KEYS = {"nominal_contact_angle_deg", "contamination_factor"}
TILTS = {"ty": "tilt y", "tz": "tilt z"}
WHOLE_PERCENT = 10.0  # from which on an error has no decimals
TOP = ("schema_version", "title", "source", "assumed")
FILM_PICTURES = {
    "film_per_azimuth": "Operating film ball by ball, both races",
    "pressure_per_azimuth": "Pressure ball by ball, both races",
}
# origin of a film that was not solved
UNSOLVED = {"atlas": "of the film atlas", "formula": "of a formula"}
BLOCKS = {
    "life": "Rating life",
    "duty_cycle": "Duty cycle",
    "clearance": "Clearance",
    "frequencies_Hz": "Frequencies [Hz]",
    "kinematic_frequencies_Hz": "Frequencies at the nominal contact angle [Hz]",
}
# names of the keys of blocks, as people call them
NAMES = {
    block: {row.key: row.name for row in rows}
    for block, rows in (
        ("life", (*LIFE_RATING, *LOAD_RATING, *FILM_LIFE)),
        ("duty_cycle", DUTY_CYCLE),
        ("clearance", CLEARANCE),
    )
}


def torque_section(torque: dict[str, Any], plots: Path) -> str:
    """The models side by side: bars of their parts, and the numbers; the picture unfolds.

    Parameters
    ----------
    torque : dict[str, Any]
        Block `torque_N_mm` of a summary.
    plots : Path
        Folder of the pictures.

    Returns
    -------
    str
        Markup.
    """
    available = {
        name: {part: float(v) for part, v in model.items() if isinstance(v, int | float)}
        for name, model in (torque.get("models") or {}).items()
        if isinstance(model, dict) and isinstance(model.get("total"), int | float)
    }
    if not available:
        return ""
    models = {name: _model(values) for name, values in available.items()}
    rows = []
    for title, values in zip(shown_titles(models), available.values(), strict=True):
        kinds = [(kind, html.number(v, 4)) for kind, v in _parts(values).items() if v]
        parts = Markup(", ").join(Markup("{} {}").format(*kind) for kind in kinds)
        rows.append(("", [title, html.number(values["total"], 4), parts or html.NOTHING]))
    head = [("model", ""), ("total", "N mm"), ("parts", "N mm")]
    return html.render(
        "bearing",
        "torque",
        torque_svg(models),
        html.Table(head, rows, (0, 2)),
        _recommended(torque),
        html.picture(plots / "torque.png", "Friction torque by model, and ball by ball"),
    )


def _model(values: dict[str, float]) -> ModelTorque:
    """A model of a summary [N mm] in SI."""
    parts = {name: to_si("torque_N_mm", v) for name, v in values.items() if name != "total"}
    return ModelTorque(components=parts, total=to_si("torque_N_mm", values["total"]))


def _recommended(torque: dict[str, Any]) -> str:
    """Which model the total is of, and the coefficient that some models take."""
    if not isinstance(torque.get("total"), int | float):
        return ""
    text = Markup("Recommended: {} N mm").format(html.number(torque["total"], 4))
    if torque.get("model"):
        text += f", model {torque_model(torque['model']).title}"
    drag = (torque.get("parts") or {}).get("drag")
    if isinstance(drag, int | float) and drag >= CHURNING_SHARE * torque["total"] > 0.0:
        text += f", {drag / torque['total']:.0%} of it churning"
    seal = (torque.get("parts") or {}).get("seal")
    if isinstance(seal, int | float) and seal > 0.0:
        text += Markup(", {} of it the contact seals").format(html.number(seal, 4))
    if torque.get("coulomb_coefficient") is not None:
        coefficient = html.number(torque["coulomb_coefficient"], 3)
        text += Markup("; Coulomb's coefficient is {}").format(coefficient)
    return text


def _parts(model: dict[str, float]) -> dict[str, float]:
    """Parts of a sum by their kinds [N mm]; round-off beside the largest of them is 0."""
    parts: dict[str, float] = {}
    for name, value in model.items():
        if name != "total":
            kind = KIND_OF_PART.get(name, name.replace("_", " "))
            parts[kind] = parts.get(kind, 0.0) + value
    return dict(zip(parts, html.without_noise(list(parts.values())), strict=True))


def input_tables(case: dict[str, Any]) -> str:
    """Every table of the case as run; assumed values are marked.

    Parameters
    ----------
    case : dict[str, Any]
        Case as run, plain JSON.

    Returns
    -------
    str
        Markup.
    """
    assumed = frozenset(str(key) for key in case.get("assumed", ())) | estimated_keys(case)
    blocks = [html.facts(title, values, assumed, path) for title, values, path in _tables(case)]
    return html.render("bearing", "input", blocks, bool(assumed))


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


def sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of the parts that a bearing or a contact has.

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
    plots = folder / "plots"
    if "contacts" in summary:
        yield "loads", "Load zone and equilibrium", _loads(summary, plots)
        yield "contacts", "Contacts", _contacts(summary["contacts"])
        yield "films", "Film and pressure", _films(plots)
    else:
        yield "films", "Film and pressure", _single_film(summary, plots)
    yield "torque", "Friction torque", torque_section(summary.get("torque_N_mm") or {}, plots)
    blocks = []
    for key, title in BLOCKS.items():
        # the notes say why a value is null
        available = {
            name: value for name, value in (summary.get(key) or {}).items() if value is not None
        }
        if available.keys() - INPUT_KEYS:
            blocks.append(html.facts(title, available, names=NAMES.get(key)))
    yield "life", "Life, clearance, frequencies", html.side_by_side(*blocks)
    yield "convergence", "Convergence and uncertainty", _convergence(summary)


def _loads(summary: dict[str, Any], plots: Path) -> str:
    ring = summary.get("ring") or {}
    numbers = {key: html.vector(value) for key, value in ring.items() if key != "stiffness"}
    numbers["cage_speed_rpm"] = summary.get("cage_speed_rpm")
    return html.render(
        "bearing",
        "loads",
        html.picture(plots / "load_zone.png", "Contact loads around the bearing"),
        html.facts("Inner ring", numbers),
        _stiffness(ring.get("stiffness") or {}),
        _balls(summary.get("balls") or []),
    )


def _stiffness(stiffness: dict[str, Any]) -> html.Table | None:
    matrix = stiffness.get("matrix")
    order = [TILTS.get(name, name) for name in stiffness.get("order") or ()]
    if not matrix or not order:
        return None
    level = html.ROUND_OFF * max(abs(value) for row in matrix for value in row)
    scales = [1e3 if name in TILTS.values() else 1e6 for name in order]  # of 1/mrad and 1/um
    rows = []
    for name, row in zip(order, matrix, strict=True):
        pairs = zip(row, scales, strict=True)
        cells = [html.number(0.0 if abs(value) < level else value / s, 3) for value, s in pairs]
        rows.append(("", [name, *cells]))
    return html.Table([("", ""), *((name, "") for name in order)], rows, (0,))


def _balls(balls: list[dict[str, Any]]) -> html.Table | None:
    keys = [
        key
        for key in (balls[0] if balls else ())
        if any(isinstance(ball.get(key), int | float) for ball in balls)
    ]
    rows = []
    for ball in balls:
        values = [ball.get(key) for key in keys]
        cells = [html.figure(v) if isinstance(v, float) else html.text(v) for v in values]
        rows.append(("", cells))
    return html.Table(html.key_head(keys), rows) if keys else None


def _contacts(contacts: list[dict[str, Any]]) -> str:
    """One line per ball and race: films, then motion and size, in tables that fit a page."""
    tables = [_contact_table(contacts, columns) for columns in (REPORT_COLUMNS, MOTION_COLUMNS)]
    return html.render("bearing", "contacts", *tables)


def _contact_table(contacts: list[dict[str, Any]], columns: Sequence[str]) -> html.Table:
    """Columns of the contacts, without those that have no value anywhere."""
    keys = [key for key in columns if any(contact.get(key) is not None for contact in contacts)]
    head = [
        (_column_title(key), unit_symbol(key)) for key in ("ball", "azimuth_deg", "race", *keys)
    ]
    rows = []
    for contact in contacts:
        state = "" if contact.get("converged") in (None, True) else " !"
        state += "" if contact.get("resolved") in (None, True) else " ?"
        azimuth = html.number(contact["azimuth_deg"] % 360.0, 5)
        cells = [f"{contact['ball']}{state}", azimuth, contact["race"]]
        cells += [html.result(contact, key) for key in keys]
        rows.append(("" if contact.get("loaded") else "off", cells))
    return html.Table(head, rows, (2,))


def _column_title(key: str) -> str:
    quantity = CONTACT_QUANTITY[key]
    return quantity.short or quantity.title


def known_pictures(summary: dict[str, Any]) -> set[str]:
    """Names of the pictures that the parts of the page place themselves.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    set[str]
        Names of PNG files.
    """
    names = {"load_zone", "contact", "torque", *FILM_PICTURES}
    for contact in summary.get("contacts") or ():
        names |= {f"{race}_ball{contact['ball']:02d}" for race in ("inner", "outer")}
    return {f"{name}.png" for name in names}


def is_single_contact(summary: dict[str, Any]) -> bool:
    """True of a summary of `oilfilm contact`.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    bool
        True if it is.
    """
    return "film_central_dimensionless" in summary


def _single_film(summary: dict[str, Any], plots: Path) -> str:
    """Picture and numbers of a single contact."""
    if not is_single_contact(summary):
        return ""
    numbers = {
        key: value
        for key, value in summary.items()
        if key not in PLACED and not html.is_large(value)
    }
    picture = html.picture(plots / "contact.png", "Film thickness and pressure of the contact")
    return html.render("bearing", "single_film", picture, html.facts("Numbers", numbers))


def _films(plots: Path) -> str:
    """Pictures of the films of a bearing."""
    pictures = [
        html.picture(plots / f"{name}.png", caption, wide=True)
        for name, caption in FILM_PICTURES.items()
    ]
    maps = [
        html.picture(path, path.stem.replace("_ball", " race, ball ").replace("ball 0", "ball "))
        for path in sorted([*plots.glob("inner_ball*.png"), *plots.glob("outer_ball*.png")])
    ]
    return html.render("bearing", "films", pictures, maps)


def _convergence(summary: dict[str, Any]) -> str:
    """Residual of the equilibrium, and box, nodes and error bars of every distinct film."""
    equilibrium = summary.get("equilibrium")
    distinct: dict[tuple[str, ...], dict[str, Any]] = {}
    for contact in summary.get("contacts") or ():
        if contact.get("film_minimum_um") is not None:
            names = ("film_minimum_um", "film_central_um", "load_N")
            values = (f"{contact[name]:.6g}" for name in names)
            distinct.setdefault((contact["race"], *values), contact)
    head = [("ball, race", ""), ("nodes", ""), ("box", "semi-axes")]
    head += [("central film", "± %"), ("minimum film", "± %"), ("converged", ""), ("resolved", "")]
    rows = [("", _convergence_cells(contact)) for contact in distinct.values()]
    return html.render(
        "bearing",
        "convergence",
        "" if equilibrium is None else html.facts("Equilibrium", equilibrium),
        html.Table(head, rows, (0,)) if rows else None,
    )


def _convergence_cells(contact: dict[str, Any]) -> list[str]:
    """Nodes, box and error bars of one film; one without a solve names its origin instead."""
    nodes = box = html.NOTHING
    if contact["domain"] is None:
        box = html.text(UNSOLVED.get(str(contact.get("film_origin"))))
    else:
        nodes = " × ".join(map(str, contact["points"]))
        box = Markup("{} … {}; ±{}").format(*(html.number(n, 3) for n in contact["domain"]))
    return [
        f"{contact['ball']} {contact['race']}",
        nodes,
        box,
        *(_relative_error(contact, f"film_{film}") for film in ("central", "minimum")),
        *(html.text(contact.get(state)) for state in ("converged", "resolved")),
    ]


def _relative_error(contact: dict[str, Any], film: str) -> str:
    value = contact[f"{film}_um"]
    error = contact[f"{film}_uncertainty_um"]
    if not value or error is None:
        return html.NOTHING
    percent = 100.0 * error / value
    return f"{percent:.0f}" if percent >= WHOLE_PERCENT else html.number(percent, 2)
