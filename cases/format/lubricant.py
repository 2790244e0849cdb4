"""[lubricant] and [lubricants.NAME]: the oil at the temperature of operation."""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from math import log
from typing import Annotated, Any, Literal

from bearing.library.lubricants import library_lubricant, lubricant_data
from ehl import DensityLaw, Lubricant, ViscosityLaw
from ehl.oil.lubricant import ROELANDS_LOG_OFFSET, ROELANDS_PRESSURE, ThermalProperties
from ehl.oil.rheology import ShearLaw
from ehl.units import from_si, to_si

from .fields import Name, OneOf, Table, above, between, described, rounded, within
from .free_volume import (
    LAWS_WITH_CONSTANTS,
    free_volume,
    free_volume_faults,
    warn_of_temperature,
    with_coefficient,
)
from .problems import MISSING, CaseProblem, shown
from .rules import CaseValues, Excludes, OnlyWith, Relation, Where


class OilTable(Table):
    """An oil of the case: properties at ambient pressure and the temperature of operation."""

    viscosity_mPa_s: float | None = above(0, 1e6, "dynamic; or kinematic_viscosity_mm2_s")
    kinematic_viscosity_mm2_s: float | None = above(0, 1e6, "kinematic; or viscosity_mPa_s")
    pressure_viscosity_1_GPa: float | None = between(0, 100, "d(ln eta)/dp at ambient pressure")
    density_kg_m3: float | None = above(0, 2e4, "density at ambient pressure")
    viscosity_law: Annotated[str, OneOf(ViscosityLaw)] | None = described(
        "pressure dependence of the viscosity; the last two for oils with their constants"
    )
    roelands_z: float | None = above(0, 2, "Roelands' exponent; left out, from Roelands' identity")
    roelands_pressure_MPa: float | None = above(0, 1e4, "Roelands' reference pressure")
    density_law: Annotated[str, OneOf(DensityLaw)] | None = described(
        "pressure dependence of the density; tait for oils with its constants"
    )
    tait_bulk_modulus_GPa: float | None = above(0, 100, "Tait's K_0 at tait_temperature_C")
    tait_bulk_modulus_derivative: float | None = above(0, 100, "Tait's K_0' = dK/dp")
    tait_temperature_C: float | None = between(
        -200, 500, "of Tait's and Doolittle's constants; left out, that of operation"
    )
    tait_bulk_modulus_temperature_1_K: float | None = between(
        0, 1, "b of K_0 exp[-b (T - T_R)]; 0 if left out"
    )
    tait_expansion_1_K: float | None = between(
        0, 0.1, "a of V_R [1 + a (T - T_R)], volume at ambient pressure; 0 if left out"
    )
    doolittle_factor: float | None = above(0, 100, "Doolittle's B")
    doolittle_occupied_share: float | None = described(
        "Doolittle's R, occupied over total volume at tait_temperature_C", gt=0, lt=1
    )
    doolittle_occupied_expansion_1_K: float | None = within(
        0.1, "of the occupied volume; left out, the constants hold at every temperature"
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
    thermal_conductivity_W_m_K: float | None = above(0, 10, "for film_model thermal")
    specific_heat_J_kg_K: float | None = above(0, 1e4, "for film_model thermal")
    viscosity_temperature_1_K: float | None = between(0, 1, "-d(ln eta)/dT; film_model thermal")
    thermal_expansion_1_K: float | None = between(0, 0.01, "for film_model thermal")
    rheology: Annotated[str, OneOf(ShearLaw)] | None = described(
        "shear law of the friction; left out, Ree-Eyring with assumed constants"
    )
    eyring_stress_MPa: float | None = above(
        0, 1e3, "Eyring's; else 2 Lambda/alpha at each contact's mean pressure (assumed)"
    )
    limiting_stress_coefficient: float | None = above(
        0, 1, "Lambda of the limiting stress Lambda p; left out, assumed but for Newton's law"
    )
    carreau_modulus_MPa: float | None = above(0, 1e3, "G of Carreau's law")
    carreau_exponent: float | None = above(0, 1, "n of Carreau's law")
    yasuda_exponent: float | None = above(0, 10, "a of Carreau and Yasuda's law; 2 if left out")


class LubricantTable(OilTable):
    """The lubricant: a name, or its properties at the temperature of operation."""

    name: Name | None = described("oil of [lubricants] or the library; the keys here override it")
    grease: Name | None = described("of the library: its base oil is the lubricant")
    supply: Literal["flooded", "starved"] | None = described(
        "of the total torque; else starved with inlet_film_um or supply_mL_min"
    )
    inlet_film_um: float | None = between(
        0, 1e4, "layer at every inlet, both surfaces together; or supply_mL_min"
    )
    inlet_film_dimensionless: float | None = between(
        0, 1e4, "the same with Moes' groups, at ambient density, in units of a^2/Rx"
    )
    flooded_layer_um: float | None = above(
        0,
        1e4,
        "layer at flooded inlets, both surfaces: it ends the rolling moment; 100 if left out",
    )
    relative_permittivity: float | None = between(
        1, 20, "at ambient pressure, for capacitances; 2.2 if left out"
    )
    contamination_factor: float | None = between(
        0, 1, "e_C of ISO 281, 1 clean; left out, no modified life is computed"
    )


VISCOSITIES = ("viscosity_mPa_s", "kinematic_viscosity_mm2_s")
# 700 K, below which bearing.library.lubricants has its laws; the tables keep the lower end
LIBRARY_TEMPERATURE_C = 426.85
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
# of an oil whose density is not given [kg/m^3]: the library's mineral oils have 854 to 874 at 40 C
DENSITY = 870.0
# stands in where only Moes' groups and a Roelands exponent are given [Pa s]
VISCOSITY_UNUSED = 1.0
SHEAR_KEYS = {  # constants of a shear law
    "eyring_stress_MPa": "ree-eyring",
    "carreau_modulus_MPa": "carreau-yasuda",
    "carreau_exponent": "carreau-yasuda",
    "yasuda_exponent": "carreau-yasuda",
}
CARREAU = ("carreau_modulus_MPa", "carreau_exponent")
HEAT_KEYS = ("thermal_conductivity_W_m_K", "specific_heat_J_kg_K", "viscosity_temperature_1_K")
SUPPLIED = (Where("lubricant.inlet_film_um"), Where("friction.supply_mL_min"))
RELATIONS: tuple[Relation, ...] = (
    Excludes("lubricant.kinematic_viscosity_mm2_s", "lubricant.viscosity_mPa_s"),
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
        return Oil(dict(lubricant), "name" in lubricant)
    if any(key in lubricant for key in VISCOSITIES):
        own = {key: value for key, value in own.items() if key not in VISCOSITIES}
    return Oil({**own, **lubricant}, of_library=False)


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
        first, second = (("lubricants", name, key) for key in VISCOSITIES)
        if values.given(*first) and values.given(*second):
            finding = f"found together with {VISCOSITIES[0]}"
            yield CaseProblem(second, finding, "allowed: one of them")
    without_oils = values.given("lubricants") and not values.get("lubricants")
    if values.get("lubricant") is None or without_oils:
        return
    oil = oil_of(values.document["lubricant"], values.document.get("lubricants"))
    if oil.of_library:
        allowed = f"allowed with an oil of the library: below {LIBRARY_TEMPERATURE_C:g}"
        for path in (("operation", "temperature_C"), ("contact", "temperature_C")):
            given = values.get(*path)
            if given is not None and given >= LIBRARY_TEMPERATURE_C:
                yield CaseProblem(path, f"found {shown(given)}", allowed)
    else:
        yield from _incomplete(oil.keys, moes=values.given("contact", "moes_M"))
    yield from _roelands_faults(oil.keys, values)
    yield from _shear_faults(oil.keys, values)
    yield from free_volume_faults(oil.keys, values, of_library=oil.of_library)
    yield from _moes_pressure_scale(oil.keys, values)
    yield from _heat_faults(oil.keys, values)


def _layer_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """A film behind a layer needs a layer, and is Newtonian, without a certificate."""
    chosen = values.get("ehl", "starvation")
    newtonian = values.get("ehl", "film_model") in (None, "newtonian")
    if chosen in ("solved", "tabulated") and not newtonian:
        found = f"found {shown(chosen)} with film_model {shown(values.get('ehl', 'film_model'))}"
        yield CaseProblem(
            ("ehl", "starvation"), found, 'allowed: "none", or film_model "newtonian"'
        )
    solved = chosen == "solved" or (chosen is None and values.given("contact") and newtonian)
    by_law = chosen == "tabulated" or (chosen is None and newtonian and not _kept_flooded(values))
    if not (solved or by_law):
        return
    layers = [("lubricant", key) for key in ("inlet_film_um", "inlet_film_dimensionless")]
    for key in (*layers, ("friction", "supply_mL_min")):
        if values.get(*key) == 0.0 and (chosen is not None or key in layers):
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
    viscosity = any(key in oil for key in VISCOSITIES)
    if not viscosity and not (moes and (law != "roelands" or "roelands_z" in oil)):
        allowed = f"needed: {', '.join(VISCOSITIES)}, or the name of a lubricant"
        allowed = "needed: roelands_z, or a viscosity that gives it" if moes else allowed
        yield CaseProblem(("lubricant", "viscosity_mPa_s"), MISSING, allowed)
    if law not in ("isoviscous", *LAWS_WITH_CONSTANTS) and PRESSURE_VISCOSITY not in oil:
        allowed = 'needed, unless viscosity_law = "isoviscous"'
        yield CaseProblem(("lubricant", PRESSURE_VISCOSITY), MISSING, allowed)


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


def _heat_faults(oil: dict[str, Any], values: CaseValues) -> Iterator[CaseProblem]:
    """Thermal properties of the oil, all or none; all for a film with heat."""
    reasons = [key for key in HEAT_KEYS if key in oil]
    if values.get("ehl", "film_model") == "thermal" and "name" not in oil:
        reasons.append('ehl.film_model = "thermal"')
    for key in HEAT_KEYS:
        if reasons and key not in oil:
            yield CaseProblem(("lubricant", key), MISSING, f"needed with {reasons[0]}")


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
        given = {field: getattr(base, field) for field in Lubricant.__dataclass_fields__} | given
    given.setdefault("temperature", temperature)
    if HEAT_KEYS[0] in keys:
        given["thermal"] = ThermalProperties(
            conductivity=keys["thermal_conductivity_W_m_K"],
            specific_heat=keys["specific_heat_J_kg_K"],
            viscosity_temperature=keys["viscosity_temperature_1_K"],
            expansion=keys.get("thermal_expansion_1_K", 0.0),
        )
    given |= constants
    _set_viscosity(given, keys)
    result = Lubricant(**with_coefficient(given, keys))
    warn_of_temperature(result, measured_at)
    return result


def _of_library(
    given: dict[str, Any], temperature: float, *, own: bool
) -> tuple[Lubricant, float | None]:
    """The library's oil at a temperature [K], with the case's `own` constants by the library's
    laws; and the temperature at which its constants of free volume were measured [K].
    """
    laws = {} if own else {name: given[name] for name in LAWS if name in given}
    base = library_lubricant(given.pop("name"), temperature, **laws)
    return base, lubricant_data(base.name).get("doolittle", {}).get("reference_K")


def _warn_of_unverified(name: str, keys: dict[str, Any]) -> None:
    """Warn of a viscosity of the library that no source was read for, if it is taken."""
    data = lubricant_data(name)["viscosity"]
    if not data.get("verified", True) and not any(key in keys for key in VISCOSITIES):
        source = data["source"].removeprefix("unverified: ")
        warnings.warn(f"lubricant {name!r}: its viscosity is unverified: {source}", stacklevel=2)


def _set_viscosity(given: dict[str, Any], keys: dict[str, Any]) -> None:
    """Fill in the dynamic viscosity [Pa s], if need be from the kinematic one."""
    given.setdefault("density", DENSITY)
    given.setdefault("pressure_viscosity", 0.0)  # checked before: the isoviscous law needs none
    dynamic, kinematic = VISCOSITIES
    if dynamic in keys:
        given["viscosity"] = to_si(dynamic, keys[dynamic])
    elif kinematic in keys:
        given["viscosity"] = to_si(kinematic, keys[kinematic]) * given["density"]
    given.setdefault("viscosity", VISCOSITY_UNUSED)


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
    return {key: rounded(from_si(key, value)) for key, value in numbers.items()} | laws
