"""Readings of the live program: what its pages say of a summary."""

from collections.abc import Iterator, Mapping
from math import hypot
from typing import Any

from oilfilm.postprocess.quantities import LONG_LIFE, is_number

from .pictures import LIGHT, number

Summary = Mapping[str, Any]
HOURS_A_YEAR = 8766.0
ASPERITIES = 1.0  # lambda below which a film is marked
# keys of `main_numbers` with their words and units, in the order of pages
QUANTITIES = {
    "torque_N_mm": ("Friction torque", "N mm"),
    "temperature_C": ("Temperature", "°C"),
    "film_um": ("Smallest film", "µm"),
    "lambda": ("Smallest λ", ""),
    "pressure_GPa": ("Largest pressure", "GPa"),
    "life_h": ("Life L10mh", "h"),
    "basic_life_h": ("Basic life L10h", "h"),
    "static_safety": ("Static safety", ""),
}
MAPPED = ("lambda", "film_um", "torque_N_mm", "temperature_C", "life_h")


def hours(life: float) -> str:
    """A life to three figures; beyond what a rating can tell that alone.

    Parameters
    ----------
    life : float
        Life [h].

    Returns
    -------
    str
        The text, without the unit.
    """
    return f"> {number(LONG_LIFE)}" if life > LONG_LIFE else number(life)


def main_numbers(found: Summary) -> dict[str, float | None]:
    """Numbers that maps, curves and comparisons show.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.

    Returns
    -------
    dict[str, float | None]
        Values in the unit that their name ends in; all None where the point did not converge.
    """
    if "supports" in found:
        return _shaft_numbers(found)
    heat = found["self_heating"] or {}
    torque = found["torque_N_mm"]
    numbers = {
        "film_um": _value(_least(found, "film_minimum_um"), "film_minimum_um"),
        "lambda": _value(_least(found, "lambda_ratio"), "lambda_ratio"),
        "pressure_GPa": _largest_pressure(found)[0],
        "torque_N_mm": torque["total"],
        "temperature_C": _temperature(found, heat),
        "life_h": found["life"]["modified_reference_rating_h"],
        "basic_life_h": found["life"]["basic_reference_rating_h"],
        "static_safety": found["life"]["static_safety_factor"],
    }
    numbers |= {f"part_{name}": value for name, value in (torque["parts"] or {}).items()}
    models = (torque["models"] or {}).items()
    numbers |= {f"model_{name}": (values or {}).get("total") for name, values in models}
    return numbers if found["converged"] else dict.fromkeys(numbers)


def of_member(found: Summary, member: int) -> Summary:
    """Summary of one bearing: of a shaft's, or the bearing itself.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing or a shaft.
    member : int
        Number of the bearing on its shaft, from 0.

    Returns
    -------
    Mapping[str, Any]
        Its summary.
    """
    one: Summary = found["bearings"][member] if "supports" in found else found
    return one


def _shaft_numbers(found: Summary) -> dict[str, float | None]:
    """The worst of the bearings, torque and life of the system."""
    each = [main_numbers(one) for one in found["bearings"] if one is not None]
    system = found["system"]
    worst = {"film_um": min, "lambda": min, "pressure_GPa": max, "temperature_C": max}
    numbers: dict[str, float | None] = {}
    for key, end in {**worst, "static_safety": min}.items():
        values = [value for one in each if (value := one[key]) is not None]
        numbers[key] = end(values) if each and len(values) == len(each) else None
    numbers["torque_N_mm"] = system["torque_N_mm"]
    numbers["life_h"] = system["modified_reference_rating_h"]
    numbers["basic_life_h"] = system["basic_reference_rating_h"]
    return numbers if found["converged"] else dict.fromkeys(numbers)


def why_not(found: Summary) -> str:
    """Reason for which a state did not converge; empty where it did.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.

    Returns
    -------
    str
        The reason.
    """
    if found["converged"]:
        return ""
    if "supports" in found:
        return str(found["messages"][0])
    if not found["equilibrium"]["converged"]:
        return f"no equilibrium of the balls: {found['equilibrium']['message']}"
    reasons = [text for text in found["messages"] if "not converged" in text or "no heat" in text]
    reason: str = (reasons or found["warnings"] or ["a part of the state did not converge"])[0]
    return reason.partition("not converged: ")[2] or reason


def tiles(found: Summary) -> list[dict[str, str]]:
    """The headline: main numbers with their unit, range or place.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.

    Returns
    -------
    list[dict[str, str]]
        Label, value, unit, a line below, and a level: "" or "warn".
    """
    values = main_numbers(found)
    below = _lines_below(found, values)
    shown = []
    for key, (label, unit) in QUANTITIES.items():
        if key == "basic_life_h":
            continue
        value = values[key]
        text = "\N{EN DASH}" if value is None else number(value)
        if key.endswith("life_h") and value is not None:
            text = hours(value)
        if key == "temperature_C" and value is not None:
            text = f"{value:.1f}"
        level = "warn" if key == "lambda" and value is not None and value < ASPERITIES else ""
        line = below[key] if value is not None or key == "life_h" else ""
        shown.append({"label": label, "value": text, "unit": unit, "line": line, "level": level})
    return shown


def _life_line(values: Mapping[str, float | None]) -> str:
    life, basic = values["life_h"], values["basic_life_h"]
    lines = []
    if life is not None:
        years = number(min(life, LONG_LIFE) / HOURS_A_YEAR)
        lines.append(f"{'over ' if life > LONG_LIFE else ''}{years} years")
    return ", ".join([*lines, *([] if basic is None else [f"L10h {hours(basic)} h"])])


def _shaft_lines(found: Summary, values: Mapping[str, float | None]) -> dict[str, str]:
    """The bearing that has the worst value, of all of them."""
    each = [main_numbers(one) for one in found["bearings"]]
    lines = dict.fromkeys(QUANTITIES, "of all bearings")
    for key in ("film_um", "lambda", "pressure_GPa", "temperature_C", "static_safety"):
        at = [one[key] for one in each].index(values[key]) if values[key] is not None else 0
        lines[key] = f"bearing {at + 1}, {found['supports'][at]['bearing']}"
    lines["life_h"] = _life_line(values)
    return lines


def _lines_below(found: Summary, values: Mapping[str, float | None]) -> dict[str, str]:
    if "supports" in found:
        return _shaft_lines(found, values)
    torque = found["torque_N_mm"]["total_range"] or {}
    power = (found["power_balance"] or {}).get("shaft_W")
    thin, ratio = _least(found, "film_minimum_um"), _least(found, "lambda_ratio")
    lines = dict.fromkeys(QUANTITIES, "")
    if torque.get("low") is not None:
        lines["torque_N_mm"] = f"{number(torque['low'])} to {number(torque['high'])}"
        lines["torque_N_mm"] += f", {number(power)} W" if power else ""
    lines["temperature_C"] = _margin_text(found)
    if thin is not None:
        error = thin["film_minimum_uncertainty_um"]
        lines["film_um"] = f"± {number(error)}, " * bool(error) + _place(thin)
    if ratio is not None:
        lines["lambda"] = _place(ratio)
    lines["pressure_GPa"] = _largest_pressure(found)[1]
    lines["life_h"] = _life_line(values)
    lines["static_safety"] = "C₀ over P₀"
    return lines


def temperature_rows(found: Summary) -> list[dict[str, str]]:
    """Heat: temperature of the films, its margin, how it is found.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.

    Returns
    -------
    list[dict[str, str]]
        Label, value and unit.
    """
    heat = found["self_heating"] or {}
    rows = [
        ("Films", _temperature(found, heat), "°C"),
        ("Friction power", heat.get("power_W"), "W"),
    ]
    rows += [
        ("Oil viscosity there", heat.get("viscosity_mPa_s"), "mPa s"),
        ("Margin to runaway", found.get("runaway_margin"), "× friction"),
        ("Time constant", _minutes(found.get("thermal_time_constant_s")), "min"),
        ("Thermal reference speed", found.get("reference_speed_rpm"), "r/min"),
    ]
    return [_row(label, value, unit) for label, value, unit in rows if value is not None]


def support_rows(found: Summary) -> list[dict[str, Any]]:
    """Bearings of a shaft with load, tilt, film, torque, temperature and life.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a shaft.

    Returns
    -------
    list[dict[str, Any]]
        Name and texts of each.
    """
    rows = []
    pairs = zip(found["supports"], found["bearings"], strict=True)
    for index, (support, bearing) in enumerate(pairs):
        values = {} if bearing is None else main_numbers(bearing)
        forces = [round(value, 3) for value in support["force_N"]]
        keys = ("film_um", "torque_N_mm", "temperature_C")
        texts = [*forces, hypot(*support["tilt_mrad"]), *(values.get(key) for key in keys)]
        life = values.get("life_h") or values.get("basic_life_h")
        cells = [*map(_shown, texts), _told("life_h", life)]
        rows.append({"name": f"{index + 1}: {support['bearing']}", "cells": cells})
    return rows


def shaft_rows(found: Summary) -> list[dict[str, str]]:
    """Numbers of a shaft beside those of its bearings.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a shaft.

    Returns
    -------
    list[dict[str, str]]
        Label, value and unit.
    """
    deflection = max(hypot(y, z) for _, y, z in found["shaft"]["deflection_um"])
    slope = max(hypot(y, z) for _, y, z in found["shaft"]["slope_mrad"])
    rows = [("Largest deflection", deflection, "µm"), ("Largest slope", slope, "mrad")]
    critical = found["critical_speeds_rpm"] or ()
    rows += [(f"Critical speed {n}", one, "r/min") for n, one in enumerate(critical[:3], 1)]
    if found["unbalance"] is not None:
        most = max(map(max, (found["unbalance"]["y_um"], found["unbalance"]["z_um"])))
        rows.append(("Amplitude by unbalance", most, "µm"))
    for spring in found["springs"]:
        rows.append((f"Load on {spring['name']}", hypot(*spring["force_N"]), "N"))
    for path in (found["heat"] or {}).get("paths", ()):
        first, second = path["bearings"]
        rows.append((f"Heat by the {path['path']}, {first} to {second}", path["heat_W"], "W"))
    return [_row(*row) for row in rows]


def life_rows(found: Summary) -> list[dict[str, Any]]:
    """Groups of numbers of the page on life and safety.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.

    Returns
    -------
    list[dict[str, Any]]
        Title and rows of each group.
    """
    life = found["life"]
    frequencies = found["frequencies_Hz"] or {}
    electrical = found["electrical"] or {}
    groups = [
        ("Rating life (ISO/TS 16281)", [
            ("Modified life L10mh", life["modified_reference_rating_h"], "h"),
            ("Basic life L10h", life["basic_reference_rating_h"], "h"),
            ("Life factor a_ISO", life["a_iso"], ""),
            ("Viscosity ratio κ", life["kappa"], ""),
            ("Contamination e_C", life["contamination_factor"], ""),
            ("Equivalent load P", life["dynamic_equivalent_load_N"], "N"),
            ("Dynamic rating C", life["basic_dynamic_rating_kN"], "kN"),
            ("Fatigue limit C_u", life["fatigue_load_limit_N"], "N"),
        ]),
        ("Static safety (ISO 76)", [
            ("Safety s₀", life["static_safety_factor"], ""),
            ("Equivalent load P₀", life["static_equivalent_load_N"], "N"),
            ("Static rating C₀", life["basic_static_rating_kN"], "kN"),
            ("Largest Hertz pressure", _largest_pressure(found)[0], "GPa"),
        ]),
        ("Frequencies", [
            ("Cage (FTF)", frequencies.get("cage"), "Hz"),
            ("Ball pass, outer (BPFO)", frequencies.get("ball_pass_outer"), "Hz"),
            ("Ball pass, inner (BPFI)", frequencies.get("ball_pass_inner"), "Hz"),
            ("Ball spin (BSF)", frequencies.get("ball_spin"), "Hz"),
            ("Cage speed", found["cage_speed_rpm"], "r/min"),
        ]),
        ("Electrical", [
            ("Breakdown voltage", electrical.get("breakdown_voltage_V"), "V"),
            ("Capacitance", electrical.get("capacitance_pF"), "pF"),
        ]),
    ]  # fmt: skip
    shown = []
    for title, rows in groups:
        given = [_row(label, value, unit) for label, value, unit in rows if value is not None]
        why = found.get("electrical_lack", "the films are being drawn")
        shown.append({"title": title, "rows": given, "why": "" if given else why})
    return shown


def contact_rows(found: Summary, ball: int, race: str) -> list[dict[str, str]]:
    """Numbers of one contact.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing, or contacts of it.
    ball : int
        Number of the ball, from 1.
    race : str
        "inner" or "outer".

    Returns
    -------
    list[dict[str, str]]
        Label, value, unit and error.
    """
    for one in found["contacts"]:
        if (one["ball"], one["race"]) == (ball, race):
            break
    else:
        return []
    rows = [
        ("Load", "load_N", "N", ""),
        ("Contact angle", "contact_angle_deg", "°", ""),
        ("Hertz pressure", "hertz_pressure_GPa", "GPa", ""),
        ("Central film", "film_central_um", "µm", "film_central_uncertainty_um"),
        ("Minimum film", "film_minimum_um", "µm", "film_minimum_uncertainty_um"),
        ("λ", "lambda_ratio", "", ""),
        ("Entrainment", "entrainment_speed_m_s", "m/s", ""),
        ("Sliding, largest", "sliding_speed_maximum_m_s", "m/s", ""),
        ("Ellipse a × b", "", "mm", ""),
    ]
    found_rows = []
    for label, key, unit, error in rows:
        if not key:
            axes = (one["semi_axis_rolling_mm"], one["semi_axis_transverse_mm"])
            if all(is_number(axis) for axis in axes):
                text = " × ".join(number(axis) for axis in axes)
                found_rows.append({"label": label, "value": text, "unit": unit})
        elif is_number(one.get(key)):
            row = _row(label, one[key], unit)
            if error and one.get(error):
                row["value"] += f" ± {number(one[error])}"
            found_rows.append(row)
    return found_rows


def differences(
    first: tuple[Mapping[str, Any], Summary], second: tuple[Mapping[str, Any], Summary]
) -> dict[str, list[dict[str, str]]]:
    """Two designs beside each other: keys that differ, and main numbers.

    Parameters
    ----------
    first, second : tuple
        Values of the document by dotted names, and summary.

    Returns
    -------
    dict[str, list[dict[str, str]]]
        Rows of the inputs and of the results.
    """
    keys = [k for k in {**first[0], **second[0]} if first[0].get(k) != second[0].get(k)]
    inputs = [
        {"label": key, "a": _shown(first[0].get(key)), "b": _shown(second[0].get(key))}
        for key in keys
        if key not in ("assumed", "source", "title")
    ]
    one, two = main_numbers(first[1]), main_numbers(second[1])
    rows = []
    for key, (label, unit) in QUANTITIES.items():
        a, b = one[key], two[key]
        change = ""
        if a is not None and b is not None and a:
            change = f"{100.0 * (b / a - 1.0):+.1f} %".replace("-", "\N{MINUS SIGN}")
            if key == "temperature_C":
                change = f"{b - a:+.1f} K".replace("-", "\N{MINUS SIGN}")
        rows.append(
            {
                "label": label,
                "unit": unit,
                "a": _told(key, a),
                "b": _told(key, b),
                "change": change,
            }
        )
    return {"inputs": inputs, "results": rows}


def _told(key: str, value: float | None) -> str:
    return hours(value) if key.endswith("life_h") and value is not None else _shown(value)


def _shown(value: Any) -> str:
    if value is None:
        return "\N{EN DASH}"
    return number(value) if is_number(value) else str(value)


def _row(label: str, value: Any, unit: str) -> dict[str, str]:
    return {"label": label, "value": hours(value) if unit == "h" else number(value), "unit": unit}


def _minutes(seconds: float | None) -> float | None:
    return None if seconds is None else seconds / 60.0


def _temperature(found: Summary, heat: Mapping[str, Any]) -> float | None:
    operation = found["case"]["operation"]
    if operation.get("temperature") == "self-heated":
        value: float | None = heat.get("temperature_C")
        return value
    return float(operation["temperature_C"])


def _margin_text(found: Summary) -> str:
    operation = found["case"]["operation"]
    if operation.get("temperature") != "self-heated":
        balanced = (found["self_heating"] or {}).get("temperature_C")
        return "given" + (f"; in balance {balanced:.1f}" if balanced is not None else "")
    limit = found["case"]["friction"].get("highest_temperature_C")
    at = (found["self_heating"] or {}).get("temperature_C")
    if at is None or limit is None:
        return "self-heated"
    return f"{limit - at:.0f} K below its limit"


def _loaded(found: Summary) -> Iterator[Mapping[str, Any]]:
    most = max((one["load_N"] for one in found["contacts"]), default=0.0)
    return (one for one in found["contacts"] if one["load_N"] > LIGHT * most)


def _least(found: Summary, key: str) -> Mapping[str, Any] | None:
    """The loaded contact with the smallest value."""
    known = [one for one in _loaded(found) if is_number(one.get(key))]
    return min(known, key=lambda one: float(one[key]), default=None)


def _value(contact: Mapping[str, Any] | None, key: str) -> float | None:
    return None if contact is None else float(contact[key])


def _largest_pressure(found: Summary) -> tuple[float | None, str]:
    known = [one for one in found["contacts"] if is_number(one["hertz_pressure_GPa"])]
    if not known:
        return None, ""
    heaviest = max(known, key=lambda one: float(one["hertz_pressure_GPa"]))
    return heaviest["hertz_pressure_GPa"], _place(heaviest)


def _place(contact: Mapping[str, Any]) -> str:
    return f"ball {contact['ball']}, {contact['race']}"
