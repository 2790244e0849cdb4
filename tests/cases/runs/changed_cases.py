"""Cases as tables in Python, their summaries as numbers by key, and their units: for tests that compare runs."""

from __future__ import annotations

import re
from copy import deepcopy
from functools import cache
from math import isclose

import numpy as np

from oilfilm.cases import run_case
from oilfilm.cases.format.case import case_from_text

LEFT_OUT = ("case", "timing_s", "oilfilm")
VECTORS = {
    "displacement_um",
    "elastic_displacement_um",
    "tilt_mrad",
    "elastic_tilt_mrad",
    "force_N",
    "moment_N_mm",
    "matrix",
}
# exponents of length, time and force in a unit, the last words of a key
UNITS = {
    "m": (1, 0, 0), "mm": (1, 0, 0), "um": (1, 0, 0), "mm2": (2, 0, 0), "N": (0, 0, 1), "kN": (0, 0, 1),
    "N_mm": (1, 0, 1), "GPa": (-2, 0, 1), "MPa": (-2, 0, 1), "rad_s": (0, -1, 0), "rpm": (0, -1, 0),
    "Hz": (0, -1, 0), "m_s": (1, -1, 0), "W": (1, -1, 1), "kJ": (1, 0, 1), "s": (0, 1, 0), "h": (0, 1, 0),
    "mL_min": (3, -1, 0), "MPa_s": (-2, 1, 1), "N_um": (-1, 0, 1), "N_s_m": (-1, 1, 1), "mPa_s": (-2, 1, 1),
    "W_K": (1, -1, 1), "GPa_m_s": (-1, -1, 1), "um_kN": (1, 0, -1), "J": (1, 0, 1),
}  # fmt: skip


def table(value):
    """A value as TOML writes it."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {table(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(table, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else repr(value)


def text(case):
    """The case file of nested tables."""
    lines = ["schema_version = 1"]
    for name, value in case.items():
        if name == "materials":
            for material, keys in value.items():
                lines += [f'[materials."{material}"]', *(f"{key} = {table(item)}" for key, item in keys.items())]
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for part in value:
                lines += [f"[[{name}]]", *(f"{key} = {table(item)}" for key, item in part.items())]
        elif isinstance(value, dict):
            lines += [f"[{name}]", *(f"{key} = {table(item)}" for key, item in value.items())]
        else:
            if name != "schema_version":
                lines.insert(1, f"{name} = {table(value)}")
    return "\n".join(lines) + "\n"


def changed(case, changes):
    """The case with other values of `table.key`; None takes a key or a table out."""
    new = deepcopy(case)
    for name, value in changes.items():
        place = new
        *tables, key = name.split(".")
        for part in tables:
            place = place.setdefault(part, {})
        if value is None:
            place.pop(key, None)
        else:
            place[key] = value
    return new


@cache
def _run(text):
    from oilfilm.postprocess import summary

    return summary(run_case(case_from_text(text, "case")))


def run(case, changes=()):
    """The summary of a case."""
    return deepcopy(_run(text(changed(case, dict(changes)))))


def named(azimuth, row, race):
    """Name of a ball or contact, by its azimuth [deg]."""
    return f"{azimuth % 360.0:.2f} {row} {race}".strip()


def numbers(found):
    """Numbers of a summary by their path; balls and contacts by azimuth and race; vectors whole."""
    flat = {}

    def visit(node, name):
        if isinstance(node, dict):
            for key, part in node.items():
                if name or key not in LEFT_OUT:
                    visit(part, f"{name}/{key}" if name else key)
        elif name.rpartition("/")[2] in VECTORS and isinstance(node, list):
            flat[name] = np.array(node, dtype=float)
        elif isinstance(node, list):
            for number, part in enumerate(node):
                known = isinstance(part, dict) and "azimuth_deg" in part
                own = named(part["azimuth_deg"], part.get("row", 1), part.get("race", "")) if known else number
                visit(part, f"{name}/{own}")
        elif isinstance(node, bool):
            flat[name] = node
        elif isinstance(node, int | float):
            flat[name] = float(node)

    visit(found, "")
    return flat


def unit(name):
    """Exponents of length, time and force of the unit that ends a path."""
    parts = re.sub(r"/\d[^/]*", "", name).split("/")
    if re.search(
        r"(factor|share|coefficient|error|imbalance|ratio|residual|count)(_low|_high|_least|_minimum)?$", parts[-1]
    ):
        return (0, 0, 0)
    for part in reversed(parts):  # `torque_N_mm/parts/rolling`: the unit is that of the table
        words = part.split("_")
        for count in (4, 3, 2, 1):
            if "_".join(words[-count:]) in UNITS and len(words) > count:
                return UNITS["_".join(words[-count:])]
    return (0, 0, 0)


def differences(found, expected, tolerance=1e-6, without=()):
    """Values that differ, by path: (found, expected); `without` are patterns of paths that are not compared."""
    off = {}
    largest = {}
    for name, value in expected.items():
        key = re.sub(r"/\d[^/]*", "", name)
        largest[key] = max(largest.get(key, 0.0), float(np.max(np.abs(value))))
    for name in expected.keys() | found.keys():
        if any(re.search(pattern, name) for pattern in without):
            continue
        one, two = found.get(name), expected.get(name)
        if one is None or two is None:
            off[name] = (one, two)
            continue
        scale = tolerance * largest[re.sub(r"/\d[^/]*", "", name)]
        same = (
            np.allclose(one, two, rtol=tolerance, atol=scale)
            if np.ndim(two)
            else isclose(one, two, rel_tol=tolerance, abs_tol=max(scale * 1e-3, 1e-12))
        )
        if not same:
            off[name] = (one, two)
    return off
