"""[lubricant] and [lubricants.NAME]: the oil at the temperature of operation.

The constants of Tait, Doolittle and Yasutomi give the pressure-viscosity coefficient.
"""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import log
from typing import Annotated, Any, Literal

from oilfilm.bearing.library.lubricants import list_lubricants, load_lubricant, lubricant_data
from oilfilm.bearing.library.plugins import matching_name
from oilfilm.ehl import DensityLaw, Lubricant, ViscosityLaw
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.oil.assumed_heat import (
    CLASSES,
    COLD,
    HOT,
    MM2_S,
    BaseOil,
    WaltherLine,
    assumed_density,
    assumed_pressure_viscosity,
    heat_of,
    line_of_index,
    line_through,
)
from oilfilm.ehl.oil.free_volume import (
    DoolittleFreeVolume,
    ExpansivityForm,
    TaitVolume,
    YasutomiGlass,
)
from oilfilm.ehl.oil.lubricant import (
    PRESSURE_VISCOSITY_TOLERANCE,
    ROELANDS_LOG_OFFSET,
    ROELANDS_PRESSURE,
    ThermalProperties,
    law_pressure_viscosity,
)
from oilfilm.ehl.oil.rheology import ShearLaw
from oilfilm.ehl.units import GIGAPASCAL, ZERO_CELSIUS, from_si, to_si

from .fields import (
    Name,
    OneOf,
    Table,
    above,
    between,
    checked,
    described,
    name_in_si,
    numbers,
    numbers_from_si,
    within,
)
from .rules import (
    MISSING,
    CaseProblem,
    CaseValues,
    Excludes,
    InvalidKeyError,
    KeyPath,
    OnlyWith,
    Relation,
    Where,
    shown,
)

TAIT = ("tait_bulk_modulus_GPa", "tait_bulk_modulus_derivative")
DOOLITTLE = ("doolittle_factor", "doolittle_occupied_share")
YASUTOMI = tuple(
    (
        "yasutomi_glass_temperature_C yasutomi_glass_rise_K yasutomi_glass_pressure_1_GPa "
        "yasutomi_expansivity_1_GPa yasutomi_slope yasutomi_width_K"
    ).split()
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
LAW_CONSTANTS = {  # constants that a law takes
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

    def place(self, key: str) -> KeyPath:
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
    chosen = [law for law in LAW_CONSTANTS if keys.get(law[0]) == law[1]]
    for law in chosen:
        if not any(key in keys for key in LAW_CONSTANTS[law]):
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
        if any(key in keys for key in LAW_CONSTANTS[law]):
            needed |= dict.fromkeys(LAW_CONSTANTS[law], f"{law[0]} = {shown(law[1])}")
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
    ways += [f"with {', '.join(LAW_CONSTANTS[law])}"] if LAW_CONSTANTS[law] else []
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
            laws = [f'{name} = "{law}"' for name, law in LAW_CONSTANTS if family in law]
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
    of_constants = law_pressure_viscosity(given.get("viscosity_law"), given)
    key = "pressure_viscosity_1_GPa"
    if of_constants is None:
        return given
    if of_constants <= 0.0:
        finding = "its constants give no viscosity that rises with pressure"
        raise InvalidKeyError(("lubricant", "viscosity_law"), finding)
    if key not in keys:
        known = {"pressure_viscosity": of_constants, "pressure_viscosity_ends": (1.0, 1.0)}
        return {**given, **known}
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
        text = (
            f"lubricant {oil.name!r}: constants of Tait and Doolittle of "
            f"{measured_at - ZERO_CELSIUS:g} C are "
            f"taken at {oil.temperature - ZERO_CELSIUS:g} C; only viscosity and "
            "density at ambient pressure follow it"
        )
        warnings.warn(Caution(text), stacklevel=2)


def _viscosity_pair(value: object) -> tuple[tuple[float, ...], ...] | None:
    rows = list(value) if isinstance(value, list | tuple) else []
    pair = [numbers(row, 2, 1e6) for row in rows]
    if len(pair) != 2 or None in pair:
        return None
    (cold, thick), (hot, thin) = sorted(row for row in pair if row is not None)
    valid = -200.0 < cold < hot < 500.0 and thick > thin > 0.31
    return ((cold, thick), (hot, thin)) if valid else None


ViscosityPair = Annotated[
    tuple[tuple[float, ...], ...],
    checked(
        _viscosity_pair, "two rows [temperature in C, viscosity above 0.31], falling with heat"
    ),
]


class OilTable(Table):
    """An oil of the case: properties at ambient pressure and the temperature of operation."""

    viscosity_mPa_s: float | None = above(0, 1e6, "dynamic; or kinematic_viscosity_mm2_s")
    kinematic_viscosity_mm2_s: float | None = above(0, 1e6, "kinematic; or viscosity_mPa_s")
    viscosity_at_C: float | None = between(
        -270, 1300, "temperature of either; default: operation.temperature_C"
    )
    kinematic_viscosity_40C_mm2_s: float | None = above(
        0.31, 1e6, "of a data sheet; with that at 100 C, or viscosity_index, over temperature"
    )
    kinematic_viscosity_100C_mm2_s: float | None = above(0.31, 1e5, "likewise")
    kinematic_viscosity_table_mm2_s: ViscosityPair | None = described(
        "[[temperature in C, viscosity], ...], two rows, instead of those at 40 and 100 C"
    )
    pressure_viscosity_1_GPa: float | None = between(
        0, 100, "d(ln eta)/dp at ambient pressure; by base_oil where a data sheet lacks it"
    )
    density_kg_m3: float | None = above(0, 2e4, "density at ambient pressure")
    density_15C_kg_m3: float | None = between(
        500, 2500, "of a data sheet, at 15 C, instead; 0.87 g/cm3 is 870"
    )
    viscosity_law: Annotated[str, OneOf(ViscosityLaw)] | None = described(
        "pressure dependence of the viscosity; the last two for oils with their constants"
    )
    roelands_z: float | None = above(0, 2, "Roelands' exponent; default: from Roelands' identity")
    roelands_pressure_MPa: float | None = above(0, 1e4, "Roelands' reference pressure")
    density_law: Annotated[str, OneOf(DensityLaw)] | None = described(
        "pressure dependence of the density; tait for oils with its constants"
    )
    tait_bulk_modulus_GPa: float | None = above(0, 100, "Tait's K_0 at tait_temperature_C")
    tait_bulk_modulus_derivative: float | None = above(0, 100, "Tait's K_0' = dK/dp")
    tait_temperature_C: float | None = between(
        -200, 500, "of Tait's and Doolittle's constants; default: that of operation"
    )
    tait_bulk_modulus_temperature_1_K: float | None = between(
        0, 1, "b of K_0 exp[-b (T - T_R)]; default 0"
    )
    tait_expansion_1_K: float | None = between(
        0, 0.1, "a of V_R [1 + a (T - T_R)], volume at ambient pressure; default 0"
    )
    doolittle_factor: float | None = above(0, 100, "Doolittle's B")
    doolittle_occupied_share: float | None = described(
        "Doolittle's R, occupied over total volume at tait_temperature_C", gt=0, lt=1
    )
    doolittle_occupied_expansion_1_K: float | None = within(
        0.1, "of the occupied volume; default: the constants hold at every temperature"
    )
    yasutomi_glass_temperature_C: float | None = above(-273.15, 500, "T_g at ambient pressure")
    yasutomi_glass_rise_K: float | None = above(0, 1e4, "A_1 of T_g + A_1 ln(1 + A_2 p)")
    yasutomi_glass_pressure_1_GPa: float | None = above(0, 1e3, "A_2 of it")
    yasutomi_expansivity_1_GPa: float | None = above(
        0, 1e3, "b_1 of (1 + b_1 p)^b_2, or B_2 of 1 - B_1 ln(1 + B_2 p)"
    )
    yasutomi_expansivity_exponent: float | None = between(
        -10, 0, "b_2, of the improved law; or yasutomi_expansivity_factor"
    )
    yasutomi_expansivity_factor: float | None = above(
        0, 100, "B_1, of the first law; or yasutomi_expansivity_exponent"
    )
    yasutomi_slope: float | None = above(0, 100, "C_1")
    yasutomi_width_K: float | None = above(0, 1e4, "C_2")
    pour_point_C: float | None = between(
        -100, 100, "below which the oil does not flow; default: an estimate of mineral oils"
    )
    base_oil: Annotated[str, OneOf(BaseOil)] | None = described(
        "gives the missing properties; default mineral"
    )
    viscosity_index: float | None = within(
        400, "after ASTM D2270, with one viscosity; default: that of the base oil"
    )
    thermal_conductivity_W_m_K: float | None = above(0, 10, "default: that of the base oil")
    specific_heat_J_kg_K: float | None = above(0, 1e4, "default: that of the base oil")
    viscosity_temperature_1_K: float | None = between(
        0, 1, "-d(ln eta)/dT; default: by viscosity_index"
    )
    thermal_expansion_1_K: float | None = between(0, 0.01, "default: that of the base oil")
    rheology: Annotated[str, OneOf(ShearLaw)] | None = described(
        "shear law of the friction; default: Ree-Eyring with assumed constants"
    )
    eyring_stress_MPa: float | None = above(
        0, 1e3, "Eyring's; else 2 Lambda/alpha at each contact's mean pressure (assumed)"
    )
    limiting_stress_coefficient: float | None = above(
        0, 1, "Lambda of the limiting stress Lambda p; default: assumed but for Newton's law"
    )
    carreau_modulus_MPa: float | None = above(0, 1e3, "G of Carreau's law")
    carreau_exponent: float | None = above(0, 1, "n of Carreau's law")
    yasuda_exponent: float | None = above(0, 10, "a of Carreau and Yasuda's law; default 2")


class LubricantTable(OilTable):
    """The lubricant: a name, or its properties at the temperature of operation."""

    name: Name | None = described("oil of [lubricants] or the library; the keys here override it")
    grease: Name | None = described("of the library: its base oil is the lubricant")
    supply: Literal["flooded", "starved"] | None = described(
        "of films and total torque; else starved with inlet_film_um or supply_mL_min"
    )
    inlet_film_um: float | None = between(
        0, 1e4, "layer at every inlet, both surfaces together; or supply_mL_min"
    )
    inlet_film_dimensionless: float | None = between(
        0, 1e4, "the same with Moes' groups, at ambient density, in units of a^2/Rx"
    )
    flooded_layer_um: float | None = above(
        0, 1e4, "layer at flooded inlets, both surfaces: it ends the rolling moment; default 100"
    )
    relative_permittivity: float | None = between(
        1, 20, "at ambient pressure, for capacitances; default 2.2"
    )
    contamination_factor: float | None = between(
        0, 1, "e_C of ISO 281, 1 clean; default: no modified life is computed"
    )


VISCOSITIES = ("viscosity_mPa_s", "kinematic_viscosity_mm2_s")
VISCOSITY_AT = "viscosity_at_C"
INDEX = "viscosity_index"
POINTS = {  # key of a viscosity of a data sheet: its temperature [K]
    "kinematic_viscosity_40C_mm2_s": COLD,
    "kinematic_viscosity_100C_mm2_s": HOT,
}
PAIR = "kinematic_viscosity_table_mm2_s"
SHEET = (*POINTS, PAIR)  # viscosities of a data sheet
SHEET_RANGE_C = (-40.0, 200.0)  # of viscosities by ASTM D341
DENSITY_AT_15 = "density_15C_kg_m3"
# between which oilfilm.bearing.library.lubricants has its laws of oils, the upper end 700 K
LIBRARY_TEMPERATURE_C = (-100.0, 426.85)
PRESSURE_VISCOSITY = "pressure_viscosity_1_GPa"
ROELANDS_PRESSURE_KEY = "roelands_pressure_MPa"
NUMBERS = {  # field of `Lubricant`: its key
    "pressure_viscosity": PRESSURE_VISCOSITY,
    "roelands_pressure": ROELANDS_PRESSURE_KEY,
    "roelands_z": "roelands_z",
    "density": "density_kg_m3",
    "flooded_layer": "flooded_layer_um",
}
LAWS = {"viscosity_law": ViscosityLaw, "density_law": DensityLaw}
# beyond the temperatures of a data sheet by more than this, ASTM D341 counts as extrapolated [K]
BEYOND_SHEET = 20.0
D341_LEAST = 2e-6  # below which the constant 0.7 of ASTM D341 needs its further terms [m^2/s]
INDEX_TOLERANCE = 5.0  # of a given index beside that of two viscosities [-]
# stands in where only Moes' groups and a Roelands exponent are given [Pa s]
VISCOSITY_UNUSED = 1.0
SHEAR_KEYS = {  # constants of a shear law
    "eyring_stress_MPa": "ree-eyring",
    "carreau_modulus_MPa": "carreau-yasuda",
    "carreau_exponent": "carreau-yasuda",
    "yasuda_exponent": "carreau-yasuda",
}
CARREAU = ("carreau_modulus_MPa", "carreau_exponent")
HEAT_KEYS = {  # field of `ThermalProperties`: its key
    "conductivity": "thermal_conductivity_W_m_K",
    "specific_heat": "specific_heat_J_kg_K",
    "viscosity_temperature": "viscosity_temperature_1_K",
    "expansion": "thermal_expansion_1_K",
}
CLASS_KEYS = ("base_oil", INDEX, *SHEET, DENSITY_AT_15)  # not of an oil of the library
SUPPLIED = (Where("lubricant.inlet_film_um"), Where("friction.supply_mL_min"))
RELATIONS: tuple[Relation, ...] = (
    Excludes("lubricant.kinematic_viscosity_mm2_s", "lubricant.viscosity_mPa_s"),
    Excludes("lubricant.density_15C_kg_m3", "lubricant.density_kg_m3"),
    *(Excludes(f"lubricant.{PAIR}", f"lubricant.{point}") for point in POINTS),
    *(Excludes(f"lubricant.{key}", f"lubricant.{own}") for key in SHEET for own in VISCOSITIES),
    Excludes("lubricant.inlet_film_um", "friction.supply_mL_min"),
    Excludes("lubricant.inlet_film_um", "contact.moes_M", "with dimensions"),
    OnlyWith("lubricant.inlet_film_dimensionless", (Where("contact.moes_M"),)),
    OnlyWith("ehl.starvation", (*SUPPLIED, Where("lubricant.inlet_film_dimensionless"))),
    Excludes("lubricant.flooded_layer_um", "contact.moes_M", "with dimensions"),
    OnlyWith("lubricant.supply", SUPPLIED, default="flooded"),
)


@dataclass(frozen=True, slots=True)
class Oil:
    """Keys of an oil, in the units of the file, and whether its name is of the library."""

    keys: dict[str, Any]
    of_library: bool


def oil_of(lubricant: dict[str, Any], lubricants: object) -> Oil:
    """Keys of [lubricant], with those of [lubricants.NAME] filled in.

    Parameters
    ----------
    lubricant : dict[str, Any]
        Keys of [lubricant].
    lubricants : object
        Oils of the case by name.

    Returns
    -------
    Oil
        The keys, and whether the name is one of the library.
    """
    own = lubricants.get(str(lubricant.get("name"))) if isinstance(lubricants, dict) else None
    if not isinstance(own, dict):
        return Oil(dict(lubricant), "name" in lubricant and not named_by_sheet(lubricant))
    anew = (*VISCOSITIES, *SHEET)
    if any(key in lubricant for key in anew):
        own = {key: value for key, value in own.items() if key not in (*anew, VISCOSITY_AT)}
    return Oil({**own, **lubricant}, of_library=False)


def named_by_sheet(lubricant: dict[str, Any]) -> bool:
    """Tell whether the name of an oil is that of its data sheet, not one of the library.

    Parameters
    ----------
    lubricant : dict[str, Any]
        Keys of [lubricant].

    Returns
    -------
    bool
        True where the viscosities of a data sheet stand with a name that no library has.
    """
    name = lubricant.get("name")
    if not isinstance(name, str) or not any(key in lubricant for key in SHEET):
        return False
    return matching_name(name, list_lubricants(name)) is None


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of the oil: incomplete properties, constants without their law.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    yield from _layer_faults(values)
    for name in values.get("lubricants") or ():
        given = [key for key in (*VISCOSITIES, *SHEET) if values.given("lubricants", name, key)]
        if len(given) > 1 and not set(given) <= set(POINTS):
            finding = f"found together with {given[0]}"
            yield CaseProblem(("lubricants", name, given[-1]), finding, "allowed: one of them")
    without_oils = values.given("lubricants") and not values.get("lubricants")
    if values.get("lubricant") is None or without_oils:
        return
    oil = oil_of(values.document["lubricant"], values.document.get("lubricants"))
    if oil.of_library:
        yield from _beyond_oils(str(oil.keys["name"]), values)
    else:
        yield from _incomplete(oil.keys, moes=values.given("contact", "moes_M"))
    yield from _roelands_faults(oil.keys, values)
    yield from _shear_faults(oil.keys, values)
    yield from free_volume_faults(oil.keys, values, of_library=oil.of_library)
    yield from _moes_pressure_scale(oil.keys, values)
    yield from _heat_faults(oil)


def _beyond_oils(name: str, values: CaseValues) -> Iterator[CaseProblem]:
    """Temperatures at which no oil of the library has its laws; a medium is held at its ends."""
    key = matching_name(name, list_lubricants(name))
    if key is None or key not in list_lubricants():
        return
    low, high = LIBRARY_TEMPERATURE_C
    for path in (("operation", "temperature_C"), ("contact", "temperature_C")):
        given = values.get(*path)
        if given is not None and not low <= given < high:
            allowed = f"allowed with an oil of the library: {low:g} to below {high:g}"
            yield CaseProblem(path, f"found {shown(given)}", allowed)


def _layer_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """A film behind a layer needs a layer, and is Newtonian, without a certificate."""
    chosen = values.get("ehl", "starvation")
    newtonian = values.get("ehl", "film_model") in (None, "newtonian")
    if chosen in ("solved", "tabulated") and not newtonian:
        found = f"found {shown(chosen)} with film_model {shown(values.get('ehl', 'film_model'))}"
        yield CaseProblem(
            ("ehl", "starvation"), found, 'allowed: "none", or film_model "newtonian"'
        )
    if values.get("ehl", "films") == "atlas" and not (newtonian and chosen in (None, "none")):
        refused = "film_model" if not newtonian else "starvation"
        finding = f'found {shown(values.get("ehl", refused))} with films "atlas", which has none'
        yield CaseProblem(("ehl", refused), finding, 'allowed: films "auto" or "solved"')
    solved = chosen == "solved" or (chosen is None and values.given("contact") and newtonian)
    by_law = chosen == "tabulated" or (chosen is None and newtonian and not _kept_flooded(values))
    if not (solved or by_law):
        return
    layers = [("lubricant", key) for key in ("inlet_film_um", "inlet_film_dimensionless")]
    if values.get("ehl", "films") == "atlas" and by_law and values.given(*layers[0]):
        found = 'found "atlas" with inlet_film_um, behind which films are solved'
        allowed = 'allowed: "auto" or "solved", or starvation = "none"'
        yield CaseProblem(("ehl", "films"), found, allowed)
    for key in (*layers, ("friction", "supply_mL_min")):
        if values.get(*key) == 0.0 and key in layers:
            allowed = 'allowed: above 0, a dry inlet has no film; or starvation = "none"'
            yield CaseProblem(key, "found 0", allowed)
        if solved and values.given(*key) and values.get("ehl", "certify"):
            found = f"found true with {'.'.join(key)}"
            yield CaseProblem(("ehl", "certify"), found, 'allowed: false, or starvation = "none"')


def _kept_flooded(values: CaseValues) -> bool:
    """Tell whether the films of a bearing stay flooded by default, its torque being wanted so."""
    return values.get("lubricant", "supply") == "flooded"


def _incomplete(oil: dict[str, Any], *, moes: bool) -> Iterator[CaseProblem]:
    """Viscosity and pressure-viscosity coefficient that the oil's law needs."""
    law = oil.get("viscosity_law", "roelands")
    viscosity = any(key in oil for key in (*VISCOSITIES, *SHEET))
    if not viscosity and not (moes and (law != "roelands" or "roelands_z" in oil)):
        ways = f"{', '.join(VISCOSITIES)}, those of a data sheet ({', '.join(POINTS)})"
        allowed = f"needed: {ways}, or the name of a lubricant"
        allowed = "needed: roelands_z, or a viscosity that gives it" if moes else allowed
        yield CaseProblem(("lubricant", "viscosity_mPa_s"), MISSING, allowed)
    with_own = law in ("isoviscous", *LAWS_WITH_CONSTANTS)
    if not (with_own or PRESSURE_VISCOSITY in oil or _by_class(oil)):
        allowed = 'needed, or base_oil, which estimates it, unless viscosity_law = "isoviscous"'
        yield CaseProblem(("lubricant", PRESSURE_VISCOSITY), MISSING, allowed)
    cold, hot = (oil.get(key) for key in POINTS)
    if cold is not None and hot is not None and not cold > hot:
        found = f"found {shown(hot)}, and {shown(cold)} at 40 C"
        yield CaseProblem(("lubricant", list(POINTS)[1]), found, "allowed: less than at 40 C")


def _by_class(oil: dict[str, Any]) -> bool:
    """Tell whether the base oil stands for what is left out."""
    return "base_oil" in oil or any(key in oil for key in SHEET)


def _roelands_faults(oil: dict[str, Any], values: CaseValues) -> Iterator[CaseProblem]:
    """Roelands' constants stand with his law, whose exponent must lie in its range."""
    law = oil.get("viscosity_law", "roelands")
    if law != "roelands":
        finding = f"found together with viscosity_law = {shown(law)}"
        for key in ("roelands_z", ROELANDS_PRESSURE_KEY):
            if values.given("lubricant", key):
                yield CaseProblem(("lubricant", key), finding, 'allowed with "roelands" only')
        return
    keys = (VISCOSITIES[0], PRESSURE_VISCOSITY, ROELANDS_PRESSURE_KEY)
    eta, alpha, pressure = (to_si(key, values.get("lubricant", key)) for key in keys)
    if eta is None or alpha is None or "roelands_z" in oil:
        return
    scale = log(eta) + ROELANDS_LOG_OFFSET
    exponent = alpha * (pressure or ROELANDS_PRESSURE) / scale if scale > 0.0 else -1.0
    if not 0.0 < exponent <= 2.0:
        key = PRESSURE_VISCOSITY if scale > 0.0 else VISCOSITIES[0]
        finding = f"found {shown(values.get('lubricant', key))}"
        if scale > 0.0:
            finding += f", with which Roelands' identity gives z = {exponent:.3g}"
        ways = (
            "a viscosity and coefficient with 0 < z <= 2, a roelands_z, or another viscosity_law"
        )
        yield CaseProblem(("lubricant", key), finding, f"allowed: {ways}")


def _shear_faults(oil: dict[str, Any], values: CaseValues) -> Iterator[CaseProblem]:
    """Constants of a shear law stand with that law, in [lubricant] or in the named oil."""
    law = oil.get("rheology", "ree-eyring")
    if law not in ("newtonian", *SHEAR_KEYS.values()):
        return
    named = ("lubricants", str(oil.get("name")))
    law_of_named = values.get(*named, "rheology") or "ree-eyring"
    for key, own in SHEAR_KEYS.items():
        here = values.given("lubricant", key)
        there = values.given(*named, key) and law_of_named != own
        if law != own and (here or there):
            finding = f"found together with rheology = {shown(law)}"
            if "rheology" not in oil:
                finding = f'found without rheology = "{own}"'
            path = ("lubricant", key) if here else (*named, key)
            yield CaseProblem(path, finding, f'allowed with "{own}" only')
    for key in CARREAU:
        if law == "carreau-yasuda" and key not in oil:
            yield CaseProblem(
                ("lubricant", key), MISSING, 'needed with rheology = "carreau-yasuda"'
            )


def _moes_pressure_scale(oil: dict[str, Any], values: CaseValues) -> Iterator[CaseProblem]:
    """Moes' L > 0 gives the scale of pressure in units of the coefficient, which there must be."""
    number = values.get("contact", "moes_L")
    alpha = oil.get(PRESSURE_VISCOSITY)
    isoviscous = alpha is None and oil.get("viscosity_law") == "isoviscous"
    if number and (alpha == 0.0 or isoviscous):
        finding = f"found {shown(number)} without a {PRESSURE_VISCOSITY} above 0"
        allowed = "allowed: 0, or an oil with such a coefficient"
        yield CaseProblem(("contact", "moes_L"), finding, allowed)


def _heat_faults(oil: Oil) -> Iterator[CaseProblem]:
    """A class of oils stands for heat properties that are not known."""
    for key in CLASS_KEYS:
        if key in oil.keys and oil.of_library:
            found = f"found with the oil {shown(oil.keys['name'])}, which has its own data"
            allowed = "allowed with an oil of the case: without name, or with [lubricants.NAME]"
            yield CaseProblem(("lubricant", key), found, allowed)
    fall = HEAT_KEYS["viscosity_temperature"]
    if VISCOSITY_AT in oil.keys and not any(key in oil.keys for key in VISCOSITIES):
        allowed = f"allowed with {' or '.join(VISCOSITIES)}"
        yield CaseProblem(("lubricant", VISCOSITY_AT), "found without its viscosity", allowed)
    if INDEX in oil.keys and fall in oil.keys:
        yield CaseProblem(("lubricant", INDEX), f"found together with {fall}", "allowed: one")


def lubricant(oil: Oil, temperature: float) -> Lubricant:
    """The oil at a temperature.

    Parameters
    ----------
    oil : Oil
        Keys of the oil.
    temperature : float
        Temperature of the oil [K].

    Returns
    -------
    Lubricant
        The lubricant, SI.
    """
    keys = oil.keys
    given: dict[str, Any] = {"name": keys.get("name", "")}
    given |= {field: to_si(key, keys[key]) for field, key in NUMBERS.items() if key in keys}
    given |= {name: law(keys[name]) for name, law in LAWS.items() if name in keys}
    constants = free_volume(keys, temperature)
    measured_at = to_si("tait_temperature_C", keys.get("tait_temperature_C"))
    if oil.of_library:
        base, of_library = _of_library(given, temperature, own=bool(constants))
        _warn_of_unverified(base.name, keys)
        measured_at = measured_at if constants else of_library
        if PRESSURE_VISCOSITY in keys:
            given["pressure_viscosity_ends"] = (1.0, 1.0)
        given = {field: getattr(base, field) for field in Lubricant.__dataclass_fields__} | given
    given.setdefault("temperature", temperature)
    given |= constants
    line = _set_viscosity(given, oil, temperature)
    result = Lubricant(**with_coefficient(given, keys))
    warn_of_temperature(result, measured_at)
    _warn_of_pour_point(oil, result.name, temperature)
    if line is not None:
        _warn_of_range(keys, line, result)
    return replace(result, thermal=_heat(result, keys, line))


def pour_point(oil: Oil, name: str) -> float | None:
    """Temperature below which an oil does not flow.

    Parameters
    ----------
    oil : Oil
        Keys of the oil.
    name : str
        Its name in the library.

    Returns
    -------
    float or None
        As given, else an estimate by the grade [K]; None: not known.
    """
    known = lubricant_data(name).get("pour_point", {}) if oil.of_library else {}
    return to_si("pour_point_C", oil.keys.get("pour_point_C", known.get("value_C")))


def _warn_of_pour_point(oil: Oil, name: str, temperature: float) -> None:
    """Warn of an oil that does not flow at a temperature [K]."""
    least = pour_point(oil, name)
    if least is None or temperature >= least:
        return
    celsius, end = (from_si("pour_point_C", t) for t in (temperature, least))
    given = oil.keys.get("pour_point_C")
    origin = " (an estimate by the grade, lubricant.pour_point_C)" if given is None else ""
    text = (
        f"lubricant {name!r}: {celsius:.0f} C lies below its pour point, {end:g} C{origin}: "
        "the oil does not flow, so that there is no film"
    )
    warnings.warn(Caution(text), stacklevel=2)


def _heat(oil: Lubricant, keys: dict[str, Any], line: WaltherLine | None) -> ThermalProperties:
    """Heat properties of the case, else of the library, else of the class of the oil."""
    known = line if _has_line(keys) else None  # else one of an assumed index, with its range
    heat = heat_of(oil, _base_oil(keys), known)
    own = {field: keys[key] for field, key in HEAT_KEYS.items() if key in keys}
    return replace(heat, **own, ranges=replace(heat.ranges, **dict.fromkeys(own, 0.0)))


def _has_line(keys: dict[str, Any]) -> bool:
    """Tell whether the viscosity over temperature is given, not assumed."""
    return INDEX in keys or PAIR in keys or all(key in keys for key in POINTS)


def _base_oil(keys: dict[str, Any]) -> BaseOil:
    return BaseOil(keys.get("base_oil", BaseOil.MINERAL))


def viscosity_line(keys: dict[str, Any], temperature: float) -> WaltherLine | None:
    """Viscosity over temperature of an oil that is not of the library.

    Parameters
    ----------
    keys : dict[str, Any]
        Keys of the oil.
    temperature : float
        Temperature of operation [K].

    Returns
    -------
    WaltherLine | None
        Through the viscosities of its sheet, or one of them with the index given or of its base
        oil; None of an oil without viscosity.
    """
    points = {at: to_si(key, keys[key]) for key, at in POINTS.items() if key in keys}
    points |= {to_si("oil_C", at): nu * MM2_S for at, nu in keys.get(PAIR, ())}
    if not points:
        at = to_si(VISCOSITY_AT, keys.get(VISCOSITY_AT, from_si(VISCOSITY_AT, temperature)))
        viscosity = _own_viscosity(keys, _density(keys, at))
        if viscosity is None:
            return None
        points = {at: viscosity / _density(keys, at)}
    if len(points) > 1:
        return line_through(tuple(points), tuple(points.values()))
    ((at, viscosity),) = points.items()
    index = keys.get(INDEX, CLASSES[_base_oil(keys)].viscosity_index[0])
    return line_of_index(viscosity, at, index)


def sheet_viscosity(oil: Oil, temperature: float) -> float:
    """Dynamic viscosity of an oil by its data sheet.

    Parameters
    ----------
    oil : Oil
        Keys of the oil.
    temperature : float
        Temperature of the oil [K].

    Returns
    -------
    float
        Viscosity at ambient pressure [Pa s].
    """
    line = viscosity_line(oil.keys, temperature)
    assert line is not None  # of a data sheet
    return line.at(temperature) * _density(oil.keys, temperature)


def _density(keys: dict[str, Any], temperature: float) -> float:
    """Density at ambient pressure [kg/m^3], given or that of the base oil at a temperature [K]."""
    if "density_kg_m3" in keys:
        return float(keys["density_kg_m3"])
    expansion = keys.get(HEAT_KEYS["expansion"])
    return assumed_density(temperature, _base_oil(keys), keys.get(DENSITY_AT_15), expansion)


def _own_viscosity(keys: dict[str, Any], density: float) -> float | None:
    """Dynamic viscosity as given for one temperature [Pa s]."""
    dynamic, kinematic = VISCOSITIES
    if dynamic in keys:
        return float(to_si(dynamic, keys[dynamic]))
    if kinematic in keys:
        return float(to_si(kinematic, keys[kinematic]) * density)
    return None


def warn_of_estimates(of_case: Oil, oil: Lubricant) -> None:
    """Tell what is assumed of an oil by its base oil.

    Parameters
    ----------
    of_case : Oil
        Keys of the oil.
    oil : Lubricant
        The lubricant at the temperature of operation.
    """
    keys = of_case.keys
    if of_case.of_library or not any(key in keys for key in (*VISCOSITIES, *SHEET)):
        return
    assert oil.temperature is not None
    celsius = oil.temperature - ZERO_CELSIUS
    base = _base_oil(keys)
    kind = CLASSES[base]
    assumed = []
    nu = oil.viscosity / oil.density
    if not _has_line(keys):
        index, low, high = kind.viscosity_index
        assumed.append(f"{INDEX} = {index:g} ({low:g} to {high:g})")
    if _by_class(keys) and PRESSURE_VISCOSITY not in keys and oil.piezoviscous:
        ends = (GIGAPASCAL * one for one in assumed_pressure_viscosity(nu, base))
        assumed.append("{} = {:.1f} ({:.1f} to {:.1f})".format(PRESSURE_VISCOSITY, *ends))
    if not {"density_kg_m3", DENSITY_AT_15} & keys.keys():
        assumed.append("{} = {:g} ({:g} to {:g})".format(DENSITY_AT_15, *kind.density))
    values = {
        "conductivity": (kind.conductivity, kind.spread),
        "specific_heat": (kind.heat_capacity / oil.density, kind.spread),
    }
    for field, (value, spread) in values.items():
        if HEAT_KEYS[field] not in keys:
            assumed.append(f"{HEAT_KEYS[field]} = {value:.3g} (+-{spread:.0%})")
    if HEAT_KEYS["expansion"] not in keys:
        assumed.append("{} = {:g} ({:g} to {:g})".format(HEAT_KEYS["expansion"], *kind.expansion))
    unverified = "" if kind.verified else ", unverified"
    named = "" if "base_oil" in keys else ", base_oil not given"
    text = f"lubricant: {1e6 * nu:.4g} mm2/s at {celsius:.4g} C"
    if assumed:
        text += f"; estimated as {base.value} oil{named}{unverified}: {', '.join(assumed)}"
    warnings.warn(text, stacklevel=2)


def _warn_of_range(keys: dict[str, Any], line: WaltherLine, oil: Lubricant) -> None:
    """Caution where ASTM D341 is extrapolated, or a given index is not that of the viscosities."""
    assert oil.temperature is not None
    celsius = oil.temperature - ZERO_CELSIUS
    points = [at - ZERO_CELSIUS for key, at in POINTS.items() if key in keys]
    points += [at for at, _ in keys.get(PAIR, ())]
    nu = oil.viscosity / oil.density
    if len(points) > 1:
        if not min(points) - BEYOND_SHEET <= celsius <= max(points) + BEYOND_SHEET:
            text = (
                f"lubricant: {celsius:.4g} C lies beyond the data sheet, {min(points):g} to "
                f"{max(points):g} C: its viscosity, {1e6 * nu:.3g} mm2/s, is extrapolated by "
                "ASTM D341"
            )
            warnings.warn(Caution(text), stacklevel=2)
        found = line.viscosity_index
        index = keys.get(INDEX)
        if index is not None and found is not None and abs(index - found) > INDEX_TOLERANCE:
            text = (
                f"lubricant.{INDEX}: {index:g} is given, {found:.0f} is that of the two "
                "viscosities (ASTM D2270); these are taken"
            )
            warnings.warn(Caution(text), stacklevel=2)
    if nu < D341_LEAST:
        text = (
            f"lubricant: {1e6 * nu:.2g} mm2/s at {celsius:.4g} C is below 2 mm2/s, where ASTM "
            "D341 needs further terms"
        )
        warnings.warn(Caution(text), stacklevel=2)


def _of_library(
    given: dict[str, Any], temperature: float, *, own: bool
) -> tuple[Lubricant, float | None]:
    """The library's oil at a temperature [K], with the case's `own` constants by the library's
    laws; and the temperature at which its constants of free volume were measured [K].
    """
    laws = {} if own else {name: given[name] for name in LAWS if name in given}
    base = load_lubricant(given.pop("name"), temperature, **laws)
    return base, lubricant_data(base.name).get("doolittle", {}).get("reference_K")


def _warn_of_unverified(name: str, keys: dict[str, Any]) -> None:
    """Warn of a viscosity of the library that no source was read for, if it is taken."""
    data = lubricant_data(name)["viscosity"]
    if not data.get("verified", True) and not any(key in keys for key in VISCOSITIES):
        source = data["source"].removeprefix("unverified: ")
        warnings.warn(f"lubricant {name!r}: its viscosity is unverified: {source}", stacklevel=2)


def _set_viscosity(given: dict[str, Any], oil: Oil, temperature: float) -> WaltherLine | None:
    """Fill in dynamic viscosity [Pa s], density and coefficient of pressure at a temperature [K];
    the line of the viscosity of an oil that is not of the library.
    """
    keys = oil.keys
    if oil.of_library:
        own = _own_viscosity(keys, given["density"])
        if own is not None:
            given["viscosity"] = own * _of_other_temperature(given, keys, temperature)
        return None
    given.setdefault("density", _density(keys, temperature))
    line = viscosity_line(keys, temperature)
    given["viscosity"] = VISCOSITY_UNUSED
    if line is not None:
        given["viscosity"] = line.at(temperature) * given["density"]
        if VISCOSITY_AT not in keys:  # of this temperature, to the last digit
            own = _own_viscosity(keys, given["density"])
            given["viscosity"] = given["viscosity"] if own is None else own
    if "pressure_viscosity" not in given and line is not None and _by_class(keys):
        value, *ends = assumed_pressure_viscosity(line.at(temperature), _base_oil(keys))
        given["pressure_viscosity"] = value
        given["pressure_viscosity_ends"] = tuple(end / value for end in ends)
    given.setdefault("pressure_viscosity", 0.0)  # the isoviscous law needs none
    return line


def _of_other_temperature(
    given: dict[str, Any], keys: dict[str, Any], temperature: float
) -> float:
    """Viscosity of an oil of the library over that at `viscosity_at_C` [-]."""
    if VISCOSITY_AT not in keys:
        return 1.0
    there = load_lubricant(given["name"], to_si(VISCOSITY_AT, keys[VISCOSITY_AT]))
    here = load_lubricant(given["name"], temperature)
    return here.viscosity / there.viscosity


def lubricant_keys(oil: Lubricant, *, moes: bool) -> dict[str, Any]:
    """A lubricant as keys of [lubricant].

    Parameters
    ----------
    oil : Lubricant
        The lubricant, SI.
    moes : bool
        True: a contact of Moes' groups, which needs no viscosity.

    Returns
    -------
    dict[str, Any]
        Values by key, in their units.
    """
    numbers = {} if moes else {VISCOSITIES[0]: oil.viscosity}
    numbers |= {} if moes else {"flooded_layer_um": oil.flooded_layer}
    numbers |= {PRESSURE_VISCOSITY: oil.pressure_viscosity, "density_kg_m3": oil.density}
    laws = {name: getattr(oil, name).value for name in LAWS}
    return numbers_from_si(numbers) | laws


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
