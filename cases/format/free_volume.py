"""Constants of Tait, Doolittle and Yasutomi of an oil, and the coefficient that follows."""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from bearing.library.lubricants import list_lubricants, lubricant_data
from ehl import DensityLaw, Lubricant, ViscosityLaw
from ehl.oil.free_volume import (
    DoolittleFreeVolume,
    ExpansivityForm,
    TaitVolume,
    YasutomiGlass,
    pressure_viscosity_doolittle,
    pressure_viscosity_yasutomi,
)
from ehl.oil.lubricant import (
    PRESSURE_VISCOSITY_TOLERANCE,
    pressure_viscosity_modulus,
    pressure_viscosity_scaled,
)
from ehl.units import GIGAPASCAL, ZERO_CELSIUS, to_si

from .fields import name_in_si
from .problems import MISSING, CaseProblem, InvalidKeyError, Path, shown
from .rules import CaseValues

TAIT = ("tait_bulk_modulus_GPa", "tait_bulk_modulus_derivative")
DOOLITTLE = ("doolittle_factor", "doolittle_occupied_share")
YASUTOMI = (
    "yasutomi_glass_temperature_C",
    "yasutomi_glass_rise_K",
    "yasutomi_glass_pressure_1_GPa",
    "yasutomi_expansivity_1_GPa",
    "yasutomi_slope",
    "yasutomi_width_K",
)
EXPANSIVITY = ("yasutomi_expansivity_exponent", "yasutomi_expansivity_factor")  # one of them
OVER_TEMPERATURE = (
    "tait_bulk_modulus_temperature_1_K",
    "tait_expansion_1_K",
    "doolittle_occupied_expansion_1_K",
)
TEMPERATURE = "tait_temperature_C"
KEYS = (*TAIT, TEMPERATURE, *DOOLITTLE, *OVER_TEMPERATURE, *YASUTOMI, *EXPANSIVITY)
FAMILIES = {  # first word of a key: constants needed with it
    "tait": TAIT,
    "doolittle": (*DOOLITTLE, *TAIT),
    "yasutomi": YASUTOMI,
}
LAWS = {  # constants that a law takes
    ("viscosity_law", "tait-doolittle"): (*TAIT, *DOOLITTLE),
    ("viscosity_law", "yasutomi"): YASUTOMI,
    ("density_law", "tait"): TAIT,
    ("viscosity_law", "modulus"): (),  # of oils of the library
    ("viscosity_law", "scaled-volume"): (),
}
LIBRARY_CONSTANTS = {  # constants that an oil of the library has for a law, one of them
    "tait-doolittle": ("doolittle",),
    "tait": ("doolittle", "tait"),
    "yasutomi": (),
    "modulus": ("modulus",),
    "scaled-volume": ("scaled",),
}
# laws whose constants give the pressure-viscosity coefficient
LAWS_WITH_CONSTANTS = ("tait-doolittle", "yasutomi", "modulus", "scaled-volume")
# difference up to which constants count as those of a temperature [K]; it changes the coefficient
# of squalane by 0.25 %, at an expansion of -1e-3/K of the occupied volume
SAME_TEMPERATURE = 0.5


@dataclass(frozen=True, slots=True)
class _OilFile:
    """Keys of the oil, and the document they stand in."""

    keys: dict[str, Any]
    values: CaseValues

    def place(self, key: str) -> Path:
        """Path of a key: in [lubricant], or in the case's named oil if that has it."""
        name = str(self.keys.get("name"))
        if self.values.given("lubricant", key) or not self.values.given("lubricants", name):
            return ("lubricant", key)
        return ("lubricants", name, key)


def free_volume_faults(
    keys: dict[str, Any], values: CaseValues, *, of_library: bool
) -> Iterator[CaseProblem]:
    """Conflicts of laws and their constants.

    Parameters
    ----------
    keys : dict[str, Any]
        Keys of the oil.
    values : CaseValues
        The valid values of the file.
    of_library : bool
        True: the name of the oil is one of the library.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    oil = _OilFile(keys, values)
    given = [key for key in KEYS if key in keys]
    chosen = [law for law in LAWS if keys.get(law[0]) == law[1]]
    for law in chosen:
        if not any(key in keys for key in LAWS[law]):
            yield from _no_constants(oil, law, of_library=of_library)
    for key, reason in _needed(keys, given, chosen).items():
        if key not in keys:
            yield CaseProblem(oil.place(key), MISSING, f"needed with {reason}")
    yield from _expansivity_faults(oil, given)
    yield from _without_law(oil, given, chosen)


def _needed(
    keys: dict[str, Any], given: list[str], chosen: list[tuple[str, str]]
) -> dict[str, str]:
    """Keys that others, or a law for which some are given, need; and which these are."""
    needed: dict[str, str] = {}
    for law in chosen:
        if any(key in keys for key in LAWS[law]):
            needed |= dict.fromkeys(LAWS[law], f"{law[0]} = {shown(law[1])}")
    for family, constants in FAMILIES.items():
        first = next((key for key in given if key.startswith(f"{family}_")), None)
        if first is not None:
            needed = dict.fromkeys(constants, first) | needed
    follows = next((key for key in given if key in OVER_TEMPERATURE), None)
    return needed if follows is None else needed | {TEMPERATURE: follows}


def _no_constants(
    oil: _OilFile, law: tuple[str, str], *, of_library: bool
) -> Iterator[CaseProblem]:
    name = oil.keys.get("name")
    names = list_lubricants()
    sets = LIBRARY_CONSTANTS[law[1]]
    suitable = [one for one in names if any(key in lubricant_data(one) for key in sets)]
    # an unknown name is a fault of its own
    if of_library and (name in suitable or name not in names):
        return
    subject = "an oil without a name in the library" if name is None else f"the oil {shown(name)}"
    ways = [f"with the oils {', '.join(suitable)}"] if suitable else []
    ways += [f"with {', '.join(LAWS[law])}"] if LAWS[law] else []
    ways += ["another law"]
    finding = f"found {shown(law[1])}, for which {subject} has no constants"
    allowed = f"allowed: {'; or '.join(ways)}"
    yield CaseProblem(oil.place(law[0]), finding, allowed)


def _expansivity_faults(oil: _OilFile, given: list[str]) -> Iterator[CaseProblem]:
    """One form of Yasutomi's law."""
    forms = [key for key in EXPANSIVITY if key in given]
    if len(forms) == len(EXPANSIVITY):
        finding = f"found together with {forms[0]}"
        yield CaseProblem(oil.place(forms[1]), finding, "allowed: one of them")
    elif not forms and any(key in YASUTOMI for key in given):
        allowed = f"needed: {' or '.join(EXPANSIVITY)}"
        yield CaseProblem(oil.place(EXPANSIVITY[0]), MISSING, allowed)


def _without_law(
    oil: _OilFile, given: list[str], chosen: list[tuple[str, str]]
) -> Iterator[CaseProblem]:
    """In [lubricant] only constants that a law takes; an oil of [lubricants] may have more."""
    for key in given:
        family = key.partition("_")[0]
        if oil.place(key)[0] == "lubricant" and not any(family in law for _, law in chosen):
            laws = [f'{name} = "{law}"' for name, law in LAWS if family in law]
            allowed = f"allowed: {' or '.join(laws)}"
            yield CaseProblem(("lubricant", key), "found without its law", allowed)


def free_volume(keys: dict[str, Any], temperature: float) -> dict[str, Any]:
    """Constants of an oil as fields of `Lubricant`.

    Parameters
    ----------
    keys : dict[str, Any]
        Keys of the oil.
    temperature : float
        Temperature of the oil [K].

    Returns
    -------
    dict[str, Any]
        Fields by name, SI.
    """
    constants: dict[str, Any] = {}
    tait, doolittle, yasutomi = (_of_family(family, keys) for family in FAMILIES)
    if tait:
        at = tait.pop("temperature", temperature)
        constants["tait"] = TaitVolume(reference_temperature=at, **tait)
    if doolittle:
        constants["doolittle"] = DoolittleFreeVolume(**doolittle)
    if yasutomi:
        pressure, coefficient = (yasutomi.pop(name) for name in ("glass_pressure", "expansivity"))
        power = "expansivity_exponent" in yasutomi  # the improved law; the first has a factor
        other = yasutomi.pop("expansivity_exponent" if power else "expansivity_factor")
        constants["yasutomi"] = YasutomiGlass(
            glass_pressure_coefficient=pressure,
            expansivity_1=coefficient if power else other,
            expansivity_2=other if power else coefficient,
            form=ExpansivityForm.POWER if power else ExpansivityForm.LOGARITHMIC,
            **yasutomi,
        )
    return constants


def _of_family(family: str, keys: dict[str, Any]) -> dict[str, Any]:
    """Constants of a family by their names without it, SI."""
    given = [key for key in keys if key.startswith(f"{family}_")]
    return {name_in_si(key).removeprefix(f"{family}_"): to_si(key, keys[key]) for key in given}


def _coefficient(given: dict[str, Any]) -> float | None:
    """d(ln eta)/dp at ambient pressure by the constants of the law [1/Pa]; None without them."""
    law = given.get("viscosity_law")
    temperature = given["temperature"]
    if law is ViscosityLaw.TAIT_DOOLITTLE:
        return pressure_viscosity_doolittle(given["tait"], given["doolittle"], temperature)
    if law is ViscosityLaw.YASUTOMI:
        return pressure_viscosity_yasutomi(given["yasutomi"], temperature)
    if law is ViscosityLaw.MODULUS:
        return pressure_viscosity_modulus(given["modulus"], temperature)
    if law is ViscosityLaw.SCALED:
        return pressure_viscosity_scaled(given["tait"], given["scaled"], temperature)
    return None


def with_coefficient(given: dict[str, Any], keys: dict[str, Any]) -> dict[str, Any]:
    """Fields of `Lubricant` with the pressure-viscosity coefficient of the constants of its law.

    Parameters
    ----------
    given : dict[str, Any]
        Fields by name, SI.
    keys : dict[str, Any]
        Keys of the oil.

    Returns
    -------
    dict[str, Any]
        The fields with the coefficient [1/Pa].

    Raises
    ------
    InvalidKeyError
        If the case gives another coefficient, or the law does not hold at the temperature.
    """
    of_constants = _coefficient(given)
    key = "pressure_viscosity_1_GPa"
    if of_constants is None:
        return given
    if of_constants <= 0.0:
        finding = "its constants give no viscosity that rises with pressure"
        raise InvalidKeyError(("lubricant", "viscosity_law"), finding)
    if key not in keys:
        return {**given, "pressure_viscosity": of_constants}
    difference = abs(keys[key] / GIGAPASCAL - of_constants)
    if difference > PRESSURE_VISCOSITY_TOLERANCE * of_constants:
        finding = (
            f"found {keys[key]:g}, and the constants of the law give "
            f"{of_constants * GIGAPASCAL:.4g}"
        )
        raise InvalidKeyError(
            ("lubricant", key), finding, "allowed: left out, or that of the constants"
        )
    return given


def warn_of_temperature(oil: Lubricant, measured_at: float | None) -> None:
    """Warn of constants used at a temperature that they do not hold at.

    Parameters
    ----------
    oil : Lubricant
        The lubricant.
    measured_at : float | None
        Temperature of the constants [K].
    """
    doolittle = oil.doolittle if oil.viscosity_law is ViscosityLaw.TAIT_DOOLITTLE else None
    used = oil.viscosity_law is ViscosityLaw.TAIT_DOOLITTLE or oil.density_law is DensityLaw.TAIT
    if measured_at is None or not used or oil.temperature is None or oil.tait is None:
        return
    expansion = None if doolittle is None else doolittle.occupied_expansion
    follows = oil.tait.bulk_modulus_temperature > 0.0 or expansion is not None
    if abs(oil.temperature - measured_at) > SAME_TEMPERATURE and not follows:
        warnings.warn(
            f"lubricant {oil.name!r}: constants of Tait and Doolittle of "
            f"{measured_at - ZERO_CELSIUS:g} C are "
            f"taken at {oil.temperature - ZERO_CELSIUS:g} C; only viscosity and "
            "density at ambient pressure follow it",
            stacklevel=2,
        )
