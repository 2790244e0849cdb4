"""Parts of the page of a bearing or a single contact."""

from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

from ..text import value_with_error
from .html import (
    NOTHING,
    ROUND_OFF,
    card,
    facts,
    is_large,
    name_text,
    number,
    picture,
    table,
    text,
    unit_text,
    without_noise,
)
from .svg import stacked_bars

CONTACT_COLUMNS = (
    "load_N",
    "contact_angle_deg",
    "hertz_pressure_GPa",
    "film_central_um",
    "film_minimum_um",
    "lambda_ratio",
    "traction_coefficient",
    "pressure_maximum_GPa",
    "entrainment_speed_m_s",
    "slide_roll_ratio",
    "spin_roll_ratio",
    "semi_axis_rolling_mm",
    "semi_axis_transverse_mm",
    "moes_M",
    "moes_L",
)
KNOWN = frozenset(
    "oilfilm case converged messages ring equilibrium cage_speed_rpm balls contacts clearance life frequencies_Hz "
    "kinematic_frequencies_Hz torque_N_mm timing_s kind rows".split()
)
# input among the results of a rating
GIVEN = ("nominal_contact_angle_deg", "contamination_factor")
TOP = ("schema_version", "title", "source", "assumed")
NAMES = {"skf": "SKF", "houpert": "Houpert", "palmgren": "Palmgren", "yao": "Yao"}  # torque models
SHORT = {
    "contact_angle_deg": "contact angle",
    "hertz_pressure_GPa": "Hertz pressure",
    "semi_axis_rolling_mm": "semi-axis rolling",
    "semi_axis_transverse_mm": "semi-axis transverse",
    "entrainment_speed_m_s": "entrain&shy;ment",
    "slide_roll_ratio": "slide-roll",
    "spin_roll_ratio": "spin-roll",
    "pressure_maximum_GPa": "largest pressure",
    "lambda_ratio": "Λ",
    "traction_coefficient": "traction",
    "moes_M": "M",
    "moes_L": "L",
}


def input_tables(case: dict[str, Any]) -> str:
    """Every table of the case as run; what the case marks as assumed stands out."""
    assumed = frozenset(str(key) for key in case.get("assumed", ()))
    blocks = []
    for name, values in case.items():
        if name in TOP or not isinstance(values, dict):
            continue
        # materials and oils by name
        if values and all(isinstance(inner, dict) for inner in values.values()):
            for inner, table_values in values.items():
                blocks.append(facts(f"{name}: {inner}", table_values, assumed, f"{name}.{inner}"))
        else:
            blocks.append(facts(name, values, assumed, name))
    lists = [
        (name, rows) for name, rows in case.items() if isinstance(rows, list) and name not in TOP
    ]
    blocks += [
        facts(f"{name} {k}", row, assumed, name)
        for name, rows in lists
        for k, row in enumerate(rows, 1)
        if isinstance(row, dict)
    ]
    legend = (
        '<p class="small"><span class="mark">*</span> assumed: no source gives this value</p>'
        if assumed
        else ""
    )
    return f'{legend}<div class="facts">{"".join(blocks)}</div>'


def cards(summary: dict[str, Any]) -> str:
    """The numbers that are looked at first."""
    found = []
    contacts = [contact for contact in summary.get("contacts") or () if contact.get("loaded")]
    films = [contact for contact in contacts if contact.get("film_minimum_um") is not None] or (
        [summary] if summary.get("film_minimum_um") is not None else []
    )
    if films:
        thinnest = min(films, key=lambda contact: contact["film_minimum_um"])
        where = f", ball {thinnest['ball']} {thinnest['race']}" if "ball" in thinnest else ""
        found.append(card(f"minimum film{where}", with_error(thinnest, "film_minimum_um"), "µm"))
    elif summary.get("film_minimum_dimensionless") is not None:
        found.append(
            card("minimum film", with_error(summary, "film_minimum_dimensionless"), "a²/Rx")
        )
    pressures = [
        c["hertz_pressure_GPa"]
        for c in contacts or [summary]
        if c.get("hertz_pressure_GPa") is not None
    ]
    if pressures:
        found.append(card("largest Hertz pressure", number(max(pressures), 4), "GPa"))
    if contacts:
        inner = sum(contact["race"] == "inner" for contact in contacts)
        found.append(card("balls loaded", f"{inner} of {len(summary.get('balls') or ())}"))
    torque = (summary.get("torque_N_mm") or {}).get("total")
    life = (summary.get("life") or {}).get("basic_reference_rating_Mrev")
    single = (
        ("friction torque", torque, "N mm"),
        ("rating life", life, "10⁶ rev"),
        ("cage speed", summary.get("cage_speed_rpm"), "rpm"),
        ("load", summary.get("load_N"), "N"),
    )
    found += [
        card(name, number(value, 4), unit) for name, value, unit in single if value is not None
    ]
    return f'<div class="cards">{"".join(found)}</div>' if found else ""


def with_error(row: dict[str, Any], key: str) -> str:
    """A film with its uncertainty, to the figures that it supports."""
    value = row.get(key)
    if value is None:
        return NOTHING
    head, _, unit = key.rpartition("_")
    error = row.get(f"{head}_uncertainty_{unit}")
    return number(value) if error is None else value_with_error(value, error)


def sections(summary: dict[str, Any], folder: Path) -> Iterator[tuple[str, str, str]]:
    """Anchor, title and content of the parts that a bearing or a contact has."""
    if "contacts" in summary:
        yield "loads", "Load zone and equilibrium", _loads(summary, folder)
        yield "contacts", "Contacts", _contacts(summary["contacts"])
    yield "films", "Film and pressure", _films(summary, folder)
    yield "torque", "Friction torque", _torque(summary.get("torque_N_mm") or {})
    blocks = {
        "life": "Rating life",
        "clearance": "Clearance",
        "frequencies_Hz": "Frequencies [Hz]",
        "kinematic_frequencies_Hz": "Frequencies at the nominal contact angle [Hz]",
    }
    shown = [
        facts(title, _known(summary[key]))
        for key, title in blocks.items()
        if _says_something(summary.get(key))
    ]
    yield (
        "life",
        "Life, clearance, frequencies",
        f'<div class="facts">{"".join(shown)}</div>' if shown else "",
    )
    yield "convergence", "Convergence and uncertainty", _convergence(summary)


def _says_something(block: Any) -> bool:
    return isinstance(block, dict) and any(
        v is not None for key, v in block.items() if key not in GIVEN
    )


def _known(block: dict[str, Any]) -> dict[str, Any]:
    """A block without what is null; the notes say why it is."""
    return {key: value for key, value in block.items() if value is not None}


def _loads(summary: dict[str, Any], folder: Path) -> str:
    ring = summary.get("ring") or {}
    numbers = {key: value for key, value in ring.items() if key != "stiffness"}
    numbers |= {"cage_speed_rpm": summary.get("cage_speed_rpm")}
    blocks = (
        f'<div class="facts">{facts("Inner ring", numbers)}</div>'
        + _stiffness(ring.get("stiffness") or {})
        + _balls(summary.get("balls") or [])
    )
    zone = picture(folder / "plots" / "load_zone.png", "Contact loads around the bearing")
    return f'<div class="pair">{zone}<div>{blocks}</div></div>' if zone else blocks


def _stiffness(stiffness: dict[str, Any]) -> str:
    matrix, order = stiffness.get("matrix"), stiffness.get("order")
    if not matrix or not order:
        return ""
    level = ROUND_OFF * max(abs(value) for row in matrix for value in row)
    plain = [[0.0 if abs(value) < level else value for value in row] for row in matrix]
    rows = [
        ("", [escape(name), *(number(value, 3) for value in row)])
        for name, row in zip(order, plain, strict=True)
    ]
    note = '<p class="quiet small">d(load)/d(displacement): N/m, N/rad; moments N m/m, N m/rad</p>'
    return (
        "<h3>Stiffness</h3>"
        + table([("", ""), *((escape(name), "") for name in order)], rows, (0,))
        + note
    )


def _balls(balls: list[dict[str, Any]]) -> str:
    if not balls:
        return ""
    names = [
        key for key in balls[0] if any(isinstance(ball.get(key), int | float) for ball in balls)
    ]
    rows = [
        (
            "",
            [
                number(ball[key], 4) if isinstance(ball[key], float) else text(ball[key])
                for key in names
            ],
        )
        for ball in balls
    ]
    return (
        "<details><summary>Balls</summary>"
        + table([(name_text(n), unit_text(n)) for n in names], rows)
        + "</details>"
    )


def _contacts(contacts: list[dict[str, Any]]) -> str:
    """One line per ball and race; columns without a value anywhere are left out."""
    names = [
        name
        for name in CONTACT_COLUMNS
        if any(contact.get(name) is not None for contact in contacts)
    ]
    head = [("ball", ""), ("azimuth", "°"), ("race", "")]
    head += [(SHORT.get(name, name_text(name)), unit_text(name)) for name in names]
    rows = []
    for contact in contacts:
        state = "" if contact.get("converged") in (None, True) else " !"
        state += "" if contact.get("resolved") in (None, True) else " ?"
        cells = [
            str(contact["ball"]) + state,
            number(contact["azimuth_deg"] % 360.0, 5),
            escape(contact["race"]),
        ]
        for name in names:
            film = name.startswith("film_")
            cells.append(with_error(contact, name) if film else _figure(contact.get(name)))
        rows.append(("" if contact.get("loaded") else "off", cells))
    legend = (
        "grey: unloaded; !: not converged; ?: film not resolved. All columns are in contacts.csv."
    )
    return table(head, rows, (2,)) + f'<p class="quiet small">{legend}</p>'


def _figure(value: Any) -> str:
    return NOTHING if value is None else number(float(value), 4)


def known_pictures(summary: dict[str, Any]) -> set[str]:
    """Names of the pictures that the parts of the page place themselves."""
    names = {
        f"{race}_ball{c['ball']:02d}"
        for c in summary.get("contacts") or ()
        for race in ("inner", "outer")
    }
    return {
        f"{name}.png"
        for name in ({"load_zone", "film_per_azimuth", "pressure_per_azimuth", "contact"} | names)
    }


def is_single_contact(summary: dict[str, Any]) -> bool:
    """Whether a summary is that of `oilfilm contact`."""
    return "film_central_dimensionless" in summary


def _films(summary: dict[str, Any], folder: Path) -> str:
    plots = folder / "plots"
    if "contacts" not in summary:
        if not is_single_contact(summary):
            return ""
        numbers = {
            key: value
            for key, value in summary.items()
            if key not in KNOWN and not is_large(value)
        }
        shown = picture(plots / "contact.png", "Film thickness and pressure of the contact")
        return (
            shown + f'<div class="facts">{facts("Numbers", numbers)}</div>'
            if shown or numbers
            else ""
        )
    shown = picture(
        plots / "film_per_azimuth.png", "Film thickness ball by ball, both races", wide=True
    )
    shown += picture(
        plots / "pressure_per_azimuth.png", "Pressure ball by ball, both races", wide=True
    )
    single = [
        picture(path, path.stem.replace("_ball", " race, ball ").replace("ball 0", "ball "))
        for path in sorted([*plots.glob("inner_ball*.png"), *plots.glob("outer_ball*.png")])
    ]
    if single:
        gallery = f'<div class="gallery">{"".join(single)}</div>'
        shown += f"<details><summary>Maps of every distinct contact ({len(single)})</summary>{gallery}</details>"
    return shown


def _torque(torque: dict[str, Any]) -> str:
    """The models side by side: bars of their parts, and the numbers."""
    models = {
        name: parts
        for name, parts in (torque.get("models") or {}).items()
        if isinstance(parts, dict)
    }
    known = {
        name: parts
        for name, parts in models.items()
        if isinstance(parts.get("total"), int | float)
    }
    if not known:
        return ""
    numbers = {
        name: _without_noise(
            {
                part: float(v)
                for part, v in parts.items()
                if part != "total" and isinstance(v, int | float)
            }
        )
        for name, parts in known.items()
    }
    bars = stacked_bars([(_words(n), numbers[n], float(known[n]["total"])) for n in known], "N mm")
    rows = []
    for name, parts in known.items():
        inner = ", ".join(
            f"{escape(_words(part))} {number(value, 4)}" for part, value in numbers[name].items()
        )
        rows.append(
            ("", [escape(_words(name)), number(float(parts["total"]), 4), inner or NOTHING])
        )
    caption = "Each model has its own assumptions; hover over a bar for its parts."
    figure = (
        f'<figure><div class="scroll wide">{bars}</div><figcaption>{caption}</figcaption></figure>'
    )
    rest = {
        key: v for key, v in torque.items() if not isinstance(v, dict | list) and v is not None
    }
    return (
        figure
        + table([("model", ""), ("total", "N mm"), ("parts", "N mm")], rows, (0, 2))
        + _alone(rest)
    )


def _without_noise(parts: dict[str, float]) -> dict[str, float]:
    """Parts of a sum [N mm]; round-off beside the largest of them is 0."""
    return dict(zip(parts, without_noise(list(parts.values())), strict=True))


def _alone(values: dict[str, Any]) -> str:
    return (
        f"<p>{'; '.join(f'{name_text(key)} {text(value)}' for key, value in values.items())}</p>"
        if values
        else ""
    )


def _words(name: str) -> str:
    return NAMES.get(name, name.replace("_", " "))


def _convergence(summary: dict[str, Any]) -> str:
    """Residual of the equilibrium, and box, nodes and error bars of every distinct film."""
    shown = (
        f'<div class="facts">{facts("Equilibrium", summary["equilibrium"])}</div>'
        if "equilibrium" in summary
        else ""
    )
    rows = []
    seen = set()
    for contact in summary.get("contacts") or ():
        if contact.get("film_minimum_um") is None:
            continue
        key = (
            contact["race"],
            *(f"{contact[name]:.6g}" for name in ("film_minimum_um", "film_central_um", "load_N")),
        )
        if key in seen:
            continue
        seen.add(key)
        box = (
            " … ".join(number(x, 3) for x in contact["domain"][:2])
            + f"; ±{number(contact['domain'][2], 3)}"
        )
        nodes = " × ".join(map(str, contact["points"]))
        errors = [_share(contact, f"film_{film}") for film in ("central", "minimum")]
        states = [text(contact.get("converged")), text(contact.get("resolved"))]
        rows.append(("", [f"{contact['ball']} {contact['race']}", nodes, box, *errors, *states]))
    head = [
        ("ball, race", ""),
        ("nodes", ""),
        ("box", "semi-axes"),
        ("central film", "± %"),
        ("minimum film", "± %"),
    ]
    head += [("converged", ""), ("resolved", "")]
    note = "Error bars enclose the distance to the film on an infinitely fine grid of the same equations."
    return shown + (table(head, rows, (0,)) + f'<p class="quiet small">{note}</p>' if rows else "")


def _share(contact: dict[str, Any], film: str) -> str:
    value, error = contact[f"{film}_um"], contact[f"{film}_uncertainty_um"]
    return NOTHING if not value else number(100.0 * error / value, 2)
