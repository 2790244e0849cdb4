"""Tables of [dynamics] over time and the rules that they follow."""

from collections.abc import Iterator
from functools import partial
from typing import Any

from oilfilm.bearing.library.lubricants import list_lubricants, lubricant_data
from oilfilm.bearing.library.plugins import matching_name

from .fields import FREE_WORD
from .lubricant import SHEET, VISCOSITIES, Oil, oil_of, sheet_viscosity
from .rules import CaseProblem, CaseValues, shown

SHEET_RANGE_C = (-40.0, 200.0)  # of viscosities by ASTM D341
TEMPERATURES = ("dynamics", "temperature_table_C")


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of tables over time with [operation], and temperatures without effect.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    displacements = _held(values, "displacement_um", 3)
    tilts = _held(values, "tilt_mrad", 2)
    yield from _place_faults(values, "displacement_table_um", "xyz", displacements)
    yield from _place_faults(values, "tilt_table_mrad", "yz", tilts)
    yield from _load_faults(values, displacements, tilts)
    if values.get(*TEMPERATURES) is not None:
        yield from _temperature_faults(values)


def _held(values: CaseValues, name: str, length: int) -> tuple[bool, ...] | None:
    """Tell whether [operation] constrains the ring along or about each axis; None where it is
    wrong.
    """
    given = values.get("operation", name)
    if given is not None:
        return tuple(entry != FREE_WORD for entry in given)
    if values.given("operation", name):
        return None
    tilts = values.get("operation", "tilt") == FREE_WORD
    tilts = tilts or values.given("operation", "moment_N_mm")
    return (name == "tilt_mrad" and not tilts,) * length


def _place_faults(
    values: CaseValues, name: str, axes: str, held: tuple[bool, ...] | None
) -> Iterator[CaseProblem]:
    """A table holds what [operation] holds, in every row."""
    key = name.replace("_table", "")
    motion = name.split("_")[0]
    word = "along" if motion == "displacement" else "about"
    for axis, entry, fixed in _entries(values, name, axes, held):
        if fixed and entry == FREE_WORD:
            finding = f'found "{FREE_WORD}" {word} {axis}, where operation.{key} holds the ring'
            allowed = f'allowed: a number there, or "{FREE_WORD}" in operation.{key}'
        elif not fixed and entry != FREE_WORD:
            finding = f"found a {motion} {word} {axis}, where the ring is free"
            allowed = f'allowed: "{FREE_WORD}" there, or a number in operation.{key}'
        else:
            continue
        yield CaseProblem(("dynamics", name), finding, allowed)
        return


def _entries(
    values: CaseValues, name: str, axes: str, held: tuple[bool, ...] | None
) -> Iterator[tuple[str, Any, bool]]:
    """Axis, entry and whether the ring is held there, row by row of a table over time."""
    if held is not None:
        for row in values.get("dynamics", name) or ():
            yield from zip(axes, row[1:], held, strict=True)


def _load_faults(
    values: CaseValues, displacements: tuple[bool, ...] | None, tilts: tuple[bool, ...] | None
) -> Iterator[CaseProblem]:
    """No load where the ring is held against it."""
    for axis, load, fixed in _entries(values, "load_table_N", "xyz", displacements):
        if load and fixed:
            finding = f"found a load of {shown(load)} N along {axis}, where the ring is held"
            allowed = f'allowed: 0, or "{FREE_WORD}" in operation.displacement_um'
            yield CaseProblem(("dynamics", "load_table_N"), finding, allowed)
            break
    moments = _entries(values, "moment_table_N_mm", "yz", tilts)
    if any(moment and fixed for _, moment, fixed in moments):
        finding = "found a moment where the tilt is held"
        allowed = 'free it by operation.moment_N_mm or operation.tilt = "free"'
        yield CaseProblem(("dynamics", "moment_table_N_mm"), finding, allowed)
    if values.get("dynamics", "rotating_load_N") and any((displacements or ())[1:]):
        finding = "found where the ring is held across the axis"
        allowed = f'free it by "{FREE_WORD}" for y and z in operation.displacement_um'
        yield CaseProblem(("dynamics", "rotating_load_N"), finding, allowed)


def _temperature_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Something in the simulation that depends on it, and an oil whose data reach that far."""
    reasons = {
        'friction = "table", whose films are of one temperature': (
            values.get("dynamics", "friction") == "table"
        ),
        "cage = false: films of the cage alone follow the temperature": (
            values.get("dynamics", "cage") is False
        ),
        "cage_film = false: films of the cage alone follow the temperature": (
            values.get("dynamics", "cage_film") is False
        ),
        'operation.temperature = "self-heated"': (
            values.get("operation", "temperature") == "self-heated"
        ),
    }
    for reason, holds in reasons.items():
        if holds:
            allowed = "allowed: without it, at operation.temperature_C"
            yield CaseProblem(TEMPERATURES, f"found with {reason}", allowed)
            return
    document = values.document
    oil = oil_of(document.get("lubricant") or {}, document.get("lubricants"))
    data = oil_data(oil)
    if data is None:
        if not oil.of_library or any(key in oil.keys for key in VISCOSITIES):
            finding = "found with a viscosity that is given at one temperature"
            allowed = "allowed with an oil of the library by its name, or by its data sheet"
            yield CaseProblem(TEMPERATURES, finding, allowed)
        return
    low, high = data["range_C"]
    for row in values.get(*TEMPERATURES):
        if not low <= row[1] <= high:
            finding = f"found {shown(row[1])} C, outside the data of {shown(oil.keys['name'])}"
            yield CaseProblem(TEMPERATURES, finding, f"allowed: {low:g} to {high:g}")
            return


def oil_data(oil: Oil) -> dict[str, Any] | None:
    """Viscosity over temperature of an oil of the library, or by its data sheet.

    Parameters
    ----------
    oil : Oil
        Keys of the oil.

    Returns
    -------
    dict[str, Any] | None
        The data; None for another oil.
    """
    if any(key in oil.keys for key in SHEET):
        return {"viscosity": {"law": partial(sheet_viscosity, oil)}, "range_C": SHEET_RANGE_C}
    name = str(oil.keys.get("name"))
    key = matching_name(name, list_lubricants(name)) if oil.of_library else None
    if key is None or any(viscosity in oil.keys for viscosity in VISCOSITIES):
        return None
    return lubricant_data(key)
