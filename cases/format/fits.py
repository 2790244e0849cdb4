"""[fit], [rings] and [temperatures]: seats of the rings, elastic rings on them, clearance in
operation, and the heat balance.
"""

import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from math import radians
from typing import Literal

from oilfilm.bearing.fits.clearance import (
    ClearanceBudget,
    Fit,
    TemperatureRise,
    cage_clearance,
    clearance_budget,
)
from oilfilm.bearing.geometry import Bearing, Race, shoulder_diameter
from oilfilm.bearing.heating.limits import HIGHEST_TEMPERATURE
from oilfilm.bearing.heating.paths import Surroundings
from oilfilm.bearing.library.bearings import (
    TOLERANCE_CLASSES,
    inner_interference,
    outer_interference,
)
from oilfilm.bearing.material import Material, load_material
from oilfilm.bearing.operation import Operation
from oilfilm.bearing.rings.elastic_ring import ElasticRing, ElasticRings, elastic_ring
from oilfilm.bearing.torque.skf import Lubrication
from oilfilm.ehl import Lubricant
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.bodies.ring_profile import Seat
from oilfilm.ehl.units import to_si

from .bearing import BearingTable
from .fields import (
    LENGTH_MAXIMUM,
    Azimuths,
    Name,
    Table,
    between,
    described,
    length,
    rounded,
    within,
)
from .friction import FrictionTable, rheology
from .lubricant import Oil, lubricant
from .rules import CaseProblem, CaseValues, Excludes, InvalidKeyError, Needs, Where, bounded, shown


class FitTable(Table):
    """Seats of the rings; the clearance of [bearing] is then the one before mounting."""

    inner_ring_interference_um: float = within(
        1e3, "on the diameter, at rest and at reference_C; negative is loose", 0.0
    )
    outer_ring_interference_um: float = within(1e3, "likewise, in the housing", 0.0)
    shaft_tolerance: Name | None = described("ISO 286, as k5: the mean interference instead")
    housing_tolerance: Name | None = described("likewise, as H7")
    shaft_bore_mm: float = between(0, LENGTH_MAXIMUM, "inner diameter of a hollow shaft", 0.0)
    housing_outside_diameter_mm: float | None = length("default: the outer ring is free")
    shaft_material: Name = described("material of the shaft", "bearing steel")
    housing_material: Name = described("material of the housing", "bearing steel")


class RingsTable(Table):
    """Rings as elastic bodies, by finite elements; a ring whose seat is left out yields at its
    contacts alone.
    """

    inner_seat: Literal["rigid", "elastic", "free", "split"] | None = described(
        "of the inner ring: a rigid shaft, the shaft of [fit], loose under a cosine pressure, or "
        "pressed at places only"
    )
    outer_seat: Literal["rigid", "elastic", "free", "split"] | None = described(
        "likewise, in a rigid housing or that of [fit], which is held on its outside"
    )
    inner_supports_deg: Azimuths | None = described(
        "azimuths from the load line of the places that press a split seat, three or more"
    )
    outer_supports_deg: Azimuths | None = described("likewise, of the housing")


class TemperaturesTable(Table):
    """Temperatures in operation, for the clearance; that of the oil in the contacts is
    operation.temperature_C.
    """

    inner_ring_C: float = between(-200, 1000, "inner ring", ...)
    outer_ring_C: float = between(-200, 1000, "outer ring", ...)
    ball_C: float = between(-200, 1000, "balls", ...)
    shaft_C: float | None = between(-200, 1000, "shaft; default: as the inner ring")
    housing_C: float | None = between(-200, 1000, "housing; default: as the outer ring")
    cage_C: float | None = between(-200, 1000, "cage, for the change of its clearances")
    oil_inlet_C: float | None = between(-200, 1000, "recorded only")
    reference_C: float = between(-200, 1000, "at which clearance and fits were measured", 20.0)


INNER = Where("fit.inner_ring_interference_um", nonzero=True)
OUTER = Where("fit.outer_ring_interference_um", nonzero=True)
RELATIONS = (
    Needs("bearing.bore_mm", INNER),
    Needs("bearing.outside_diameter_mm", OUTER),
    Needs("fit.housing_outside_diameter_mm", OUTER),
    Needs("bearing.bore_mm", Where("fit.shaft_tolerance")),
    Needs("bearing.outside_diameter_mm", Where("fit.housing_tolerance")),
    Needs("fit.housing_outside_diameter_mm", Where("fit.housing_tolerance")),
    Needs("bearing.bore_mm", Where("rings.inner_seat")),
    Needs("bearing.width_mm", Where("rings.inner_seat")),
    Needs("bearing.outside_diameter_mm", Where("rings.outer_seat")),
    Needs("bearing.width_mm", Where("rings.outer_seat")),
    Needs(
        "fit.shaft_bore_mm",
        Where("rings.inner_seat", "elastic"),
        'needed with rings.inner_seat = "elastic": the bore of the shaft, 0 of a solid one',
    ),
    Needs("fit.housing_outside_diameter_mm", Where("rings.outer_seat", "elastic")),
    Needs("rings.inner_supports_deg", Where("rings.inner_seat", "split")),
    Needs("rings.outer_supports_deg", Where("rings.outer_seat", "split")),
    Excludes("rings", "dynamics", "one of them: in simulations rings are rigid"),
)


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [fit] with the bearing: shaft, housing and their tolerances.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    yield from _seat_faults(values)
    bore = values.get("bearing", "bore_mm")
    if bore is not None:
        allowed = f"less than the bore of the bearing, {bore:g} mm"
        yield from bounded(values, "fit.shaft_bore_mm", lambda x: x < bore, allowed)
    outside = values.get("bearing", "outside_diameter_mm")
    if outside is not None:
        allowed = f"more than the outside diameter of the bearing, {outside:g} mm"
        yield from bounded(
            values, "fit.housing_outside_diameter_mm", lambda x: x > outside, allowed
        )


@dataclass(frozen=True, kw_only=True)
class NamedSeat:
    """A seat by its tolerance."""

    key: str  # of [fit]
    size_key: str  # of [bearing]
    interference_key: str
    # smallest and largest interference [um] by tolerance, tolerance class and size [mm]
    interference: Callable[[str, str, float], tuple[float, float]]
    text: str


NAMED_SEATS = (
    NamedSeat(
        key="shaft_tolerance",
        size_key="bore_mm",
        interference_key="inner_ring_interference_um",
        interference=inner_interference,
        text="bore",
    ),
    NamedSeat(
        key="housing_tolerance",
        size_key="outside_diameter_mm",
        interference_key="outer_ring_interference_um",
        interference=outer_interference,
        text="outside diameter",
    ),
)


def _seat_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Tolerances that there are, each in place of its interference."""
    for seat in NAMED_SEATS:
        name = values.get("fit", seat.key)
        size = values.get("bearing", seat.size_key)
        if name is None or size is None:
            continue
        path = ("fit", seat.key)
        if values.get("fit", seat.interference_key):
            finding = f"found together with {seat.interference_key}"
            yield CaseProblem(path, finding, "allowed: one of them")
        try:
            seat.interference(name, TOLERANCE_CLASSES[0], size)
        except ValueError as error:
            yield CaseProblem(path, f"found {shown(name)}: {error}")


def _interference(table: FitTable, bearing: BearingTable, seat: NamedSeat) -> float:
    """Interference [m] as given, or the middle of that of the tolerance, with a warning."""
    name = getattr(table, seat.key)
    size = getattr(bearing, seat.size_key)
    if name is None or size is None:
        return float(to_si(seat.interference_key, getattr(table, seat.interference_key)))
    grade = bearing.tolerance_class or TOLERANCE_CLASSES[0]
    low, high = seat.interference(name, grade, size)
    middle = 0.5 * (low + high)
    text = (
        f"fit.{seat.key}: {name} with the {seat.text} of {size:g} mm in the class {grade}: "
        f"interference of {low:g} to {high:g} um, {middle:g} taken"
    )
    warnings.warn(text, stacklevel=2)
    return float(to_si(seat.interference_key, middle))


def fit(
    table: FitTable | None, materials: Mapping[str, Material], bearing: BearingTable
) -> Fit | None:
    """Fits of the rings.

    Parameters
    ----------
    table : FitTable | None
        The checked table, where there is one.
    materials : Mapping[str, Material]
        Materials by name.
    bearing : BearingTable
        The checked table [bearing].

    Returns
    -------
    Fit | None
        Interferences and diameters [m]; None without [fit].
    """
    if table is None:
        return None
    inner, outer = (_interference(table, bearing, seat) for seat in NAMED_SEATS)
    return Fit(
        shaft_material=materials[table.shaft_material],
        housing_material=materials[table.housing_material],
        inner_interference=inner,
        outer_interference=outer,
        **table.si("shaft_bore_mm", "housing_outside_diameter_mm"),
    )


def elastic_rings(
    table: RingsTable | None,
    seats: FitTable | None,
    given: Bearing,
    materials: Mapping[str, Material],
) -> ElasticRings | None:
    """The rings that [rings] makes elastic.

    Parameters
    ----------
    table : RingsTable | None
        The checked table [rings], where there is one.
    seats : FitTable | None
        The checked table [fit], where there is one.
    given : Bearing
        The bearing as delivered.
    materials : Mapping[str, Material]
        Materials by name.

    Returns
    -------
    ElasticRings | None
        The rings [m]; None without [rings].

    Raises
    ------
    InvalidKeyError
        If a section is not known or impossible.
    """
    if table is None or table.inner_seat is table.outer_seat is None:
        return None
    fit_si = (seats or FitTable()).si()
    bodies = {
        Race.INNER: (table.inner_seat, fit_si["shaft_bore"], fit_si["shaft_material"]),
        Race.OUTER: (
            table.outer_seat,
            fit_si["housing_outside_diameter"],
            fit_si["housing_material"],
        ),
    }
    rings: dict[str, ElasticRing] = {}
    for race, (seat, diameter, material) in bodies.items():
        if seat is None:
            continue
        shoulder = shoulder_diameter(given, race)
        if shoulder is None:
            key = f"{race.value}_shoulder_diameter_mm"
            raise InvalidKeyError(
                ("bearing", key), f"needed with rings.{race.value}_seat; no estimate"
            )
        body = (diameter, materials[material]) if seat == "elastic" else None
        places = getattr(table, f"{race.value}_supports_deg") or ()
        supports = tuple(radians(azimuth) for azimuth in places)
        try:
            rings[race.value] = elastic_ring(given, race, Seat(seat), shoulder, body, supports)
        except ValueError as error:
            raise InvalidKeyError(
                ("rings", f"{race.value}_seat"), f"no such ring: {error}"
            ) from error
    return ElasticRings(**rings)


def part_temperatures(
    table: TemperaturesTable | None, parts: Mapping[str, float]
) -> TemperaturesTable:
    """Temperatures of the parts from a network of heat.

    The outer ring has the mean of its halves; the reference stays.

    Parameters
    ----------
    table : TemperaturesTable | None
        The checked table [temperatures], where there is one.
    parts : Mapping[str, float]
        Temperature by node [degrees Celsius].

    Returns
    -------
    TemperaturesTable
        The table with these temperatures.
    """
    outer = 0.5 * (parts["outer_ring_loaded"] + parts["outer_ring_unloaded"])
    values = {
        "inner_ring_C": parts["inner_ring"],
        "outer_ring_C": outer,
        "ball_C": parts["balls"],
        "shaft_C": parts["shaft"],
        "housing_C": parts["housing"],
    }
    if table is not None and table.cage_C is not None:
        values["cage_C"] = parts["cage"]
    values = {key: rounded(value) for key, value in values.items()}
    return TemperaturesTable(**values) if table is None else table.model_copy(update=values)


def _rises(table: TemperaturesTable) -> TemperatureRise:
    """Rise of the parts above the temperature of measurement [K]."""
    parts = {
        "inner_ring": table.inner_ring_C,
        "outer_ring": table.outer_ring_C,
        "ball": table.ball_C,
        "shaft": table.inner_ring_C if table.shaft_C is None else table.shaft_C,
        "housing": table.outer_ring_C if table.housing_C is None else table.housing_C,
    }
    return TemperatureRise(**{part: value - table.reference_C for part, value in parts.items()})


def in_operation(
    given: Bearing,
    operation: Operation,
    seats: Fit | None,
    table: TemperaturesTable | None,
    cage: tuple[Material | None, tuple[Race, float] | None],
) -> tuple[Bearing, ClearanceBudget | None]:
    """The bearing with its clearance in operation.

    Parameters
    ----------
    given : Bearing
        The bearing as delivered.
    operation : Operation
        Speeds and loads.
    seats : Fit | None
        Fits of the rings, where there are any.
    table : TemperaturesTable | None
        The checked table [temperatures], where there is one.
    cage : tuple[Material | None, tuple[Race, float] | None]
        Material of the cage, and race and diameter of its land [m].

    Returns
    -------
    bearing
        The bearing.
    budget
        Parts of the clearance [m]; None where it does not change.
    """
    if seats is None and table is None:
        return given, None
    rises = None if table is None else _rises(table)
    budget = clearance_budget(given, operation, seats, rises)
    material, land = cage
    if table is not None and rises and material and table.cage_C is not None:
        rise = table.cage_C - table.reference_C
        budget = replace(budget, cage=cage_clearance(given, material, rises, rise, land))
    return replace(given, diametral_clearance=budget.operating), budget


@dataclass(frozen=True, kw_only=True)
class Seats:
    """Seats and temperatures of the rings, for their strength, SI."""

    fit: Fit | None
    rise: TemperatureRise | None
    reference: float  # temperature of measurement [K]


def seats_of(fit: Fit | None, table: TemperaturesTable | None) -> Seats:
    """Seats and temperatures of a case.

    Parameters
    ----------
    fit : Fit | None
        Fits of the rings, where there are any.
    table : TemperaturesTable | None
        The checked table [temperatures], where there is one.

    Returns
    -------
    Seats
        Seats [m] and temperatures [K].
    """
    if table is None:
        return Seats(fit=fit, rise=None, reference=REFERENCE)
    return Seats(fit=fit, rise=_rises(table), reference=table.si()["reference"])


# temperature of measurement where no [temperatures] gives it [K]
REFERENCE = to_si("reference_C", TemperaturesTable.model_fields["reference_C"].default)


@dataclass(frozen=True, kw_only=True)
class HeatingInput:
    """Inputs of the heat balance besides the bearing and its operation, SI."""

    delivered: Bearing  # with its clearance before mounting, where there are fits or temperatures
    oil: Callable[[float], Lubricant]  # at a temperature [K]
    rheology: Callable[[Lubricant], Rheology]  # how an oil shears
    around: Surroundings
    model: str  # of the friction torque
    fit: Fit | None = None
    # temperature at which clearance and fits were measured [K]; None: the clearance stays
    reference: float | None = None
    hottest: float = HIGHEST_TEMPERATURE  # of the films, beyond which no balance counts [K]
    expected: float | None = None  # film temperature of the balance of nearly the same case [K]


def heating(
    table: FrictionTable,
    temperatures: TemperaturesTable | None,
    oil: Oil,
    at_operation: Lubricant,
    delivered: Bearing,
    fit: Fit | None,
) -> HeatingInput | None:
    """Inputs of the heat balance.

    Parameters
    ----------
    table : FrictionTable
        The checked table [friction].
    temperatures : TemperaturesTable | None
        The checked table [temperatures], where there is one.
    oil : Oil
        Keys of the oil.
    at_operation : Lubricant
        The oil at the temperature of operation.
    delivered : Bearing
        The bearing as delivered.
    fit : Fit | None
        Fits of the rings, where there are any.

    Returns
    -------
    HeatingInput | None
        Surroundings [W/K], oil over temperature [K] and fits; None where no heat transfer is
        given.
    """
    if table.heat_transfer_W_K is None:
        return None
    reference = None if fit is None else REFERENCE
    if temperatures is not None:
        reference = temperatures.si()["reference"]
    return HeatingInput(
        delivered=delivered,
        oil=lambda temperature: lubricant(oil, temperature),
        rheology=lambda fluid: rheology(oil, fluid),
        around=_surroundings(table, at_operation, fit),
        model=table.heating_torque,
        fit=fit,
        reference=reference,
        hottest=table.si()["highest_temperature"],
    )


def _surroundings(table: FrictionTable, oil: Lubricant, fit: Fit | None) -> Surroundings:
    """Heat to the surroundings and to the oil that flows through [W/K, K]; shaft and housing of
    steel where no fit names them.
    """
    si = table.si()
    key = "supply_mL_min" if table.cooling_oil_mL_min is None else "cooling_oil_mL_min"
    flow = to_si(key, getattr(table, key))
    steel = load_material(FitTable.model_fields["shaft_material"].default)
    air = (Lubrication.GREASE.value, Lubrication.OIL_AIR.value)
    # a flow that is to cool wets the walls, whatever lubricates
    filled = table.cooling_oil_mL_min is not None or table.lubrication not in air
    return Surroundings(
        ambient=si["ambient"],
        conductance=si["heat_transfer"],
        oil_flow=flow * oil.density * heat_of(oil).specific_heat if flow else 0.0,
        oil_supply=si["ambient"] if table.cooling_oil_C is None else si["cooling_oil_C"],
        shaft_material=steel if fit is None else fit.shaft_material,
        housing_material=steel if fit is None else fit.housing_material,
        shaft_bore=0.0 if fit is None else fit.shaft_bore,
        housing_diameter=None if fit is None else fit.housing_outside_diameter,
        filled=filled,
    )
