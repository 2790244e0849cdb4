"""Constants of Tait, Doolittle and Yasutomi: complete, with a law that takes them."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from bearing.library.lubricants import list_lubricants, lubricant_data

from ..format.problems import MISSING, Problem, shown
from ..format.toml_lines import Path
from .values import Values

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
LAWS = {  # constants that a law takes
    ("viscosity_law", "tait-doolittle"): (*TAIT, *DOOLITTLE),
    ("viscosity_law", "yasutomi"): YASUTOMI,
    ("density_law", "tait"): TAIT,
}
WITH_CONSTANTS = (
    "tait-doolittle",
    "yasutomi",
)  # laws whose constants give the pressure-viscosity coefficient


@dataclass(frozen=True, slots=True)
class _Oil:
    """Keys of the oil, and where they stand."""

    keys: dict[str, Any]
    values: Values

    def place(self, key: str) -> Path:
        """Table and key: [lubricant] where it is given there, else the named oil of the case's
        own, if it is one.
        """
        name = str(self.keys.get("name"))
        if self.values.given("lubricant", key) or not self.values.given("lubricants", name):
            return ("lubricant", key)
        return ("lubricants", name, key)


def free_volume(oil: dict[str, Any], values: Values, *, library: bool) -> Iterator[Problem]:
    """A law has its constants, from the case or the library; constants in [lubricant] have their
    law.
    """
    here = _Oil(oil, values)
    given = [key for key in KEYS if key in oil]
    asked = [law for law in LAWS if oil.get(law[0]) == law[1]]
    for law in asked:
        if not any(key in oil for key in LAWS[law]):
            yield from _no_constants(here, law, library=library)
    needed = _needed(oil, given, asked)
    for key, reason in needed.items():
        if key not in oil:
            yield Problem(path=here.place(key), found=MISSING, allowed=f"needed with {reason}")
    yield from _expansivity(here, given)
    yield from _unasked(here, given, asked)


def _needed(oil: dict[str, Any], given: list[str], asked: list[tuple[str, str]]) -> dict[str, str]:
    """Keys that others, or a law for which some are given, ask for; and which."""
    needed: dict[str, str] = {}
    for law in asked:
        if any(key in oil for key in LAWS[law]):
            needed |= dict.fromkeys(LAWS[law], f"{law[0]} = {shown(law[1])}")
    for start, keys in (
        ("tait_", TAIT),
        ("doolittle_", (*DOOLITTLE, *TAIT)),
        ("yasutomi_", YASUTOMI),
    ):
        first = next((key for key in given if key.startswith(start)), None)
        if first is not None:
            needed = dict.fromkeys(keys, first) | needed
    warm = next((key for key in given if key in OVER_TEMPERATURE), None)
    return needed if warm is None else needed | {TEMPERATURE: warm}


def _no_constants(oil: _Oil, law: tuple[str, str], *, library: bool) -> Iterator[Problem]:
    name = oil.keys.get("name")
    names = list_lubricants()
    known = (
        []
        if law[1] == "yasutomi"
        else [one for one in names if "doolittle" in lubricant_data(one)]
    )
    if library and (name in known or name not in names):  # unknown names are told by themselves
        return
    words = "an oil without a name in the library" if name is None else f"the oil {shown(name)}"
    ways = [f"with the oils {', '.join(known)}"] if known else []
    ways += [f"with {', '.join(LAWS[law])}", "another law"]
    found = f"found {shown(law[1])}, for which {words} has no constants"
    yield Problem(path=oil.place(law[0]), found=found, allowed=f"allowed: {'; or '.join(ways)}")


def _expansivity(oil: _Oil, given: list[str]) -> Iterator[Problem]:
    """One form of Yasutomi's law."""
    forms = [key for key in EXPANSIVITY if key in given]
    if len(forms) == len(EXPANSIVITY):
        found = f"found together with {forms[0]}"
        yield Problem(path=oil.place(forms[1]), found=found, allowed="allowed: one of them")
    elif not forms and any(key in YASUTOMI for key in given):
        yield Problem(
            path=oil.place(EXPANSIVITY[0]),
            found=MISSING,
            allowed=f"needed: {' or '.join(EXPANSIVITY)}",
        )


def _unasked(oil: _Oil, given: list[str], asked: list[tuple[str, str]]) -> Iterator[Problem]:
    """In [lubricant] only constants that a law takes; an oil of the case's own may have more."""
    for key in given:
        start = key.partition("_")[0]
        if oil.place(key)[0] == "lubricant" and not any(start in law for _, law in asked):
            laws = [f'{name} = "{law}"' for name, law in LAWS if start in law]
            yield Problem(
                path=("lubricant", key),
                found="found without its law",
                allowed=f"allowed: {' or '.join(laws)}",
            )
