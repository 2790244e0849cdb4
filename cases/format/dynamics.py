"""[dynamics] and [cage]: the time simulation, and the cage for friction and simulation."""

from collections.abc import Iterator
from math import pi
from typing import Annotated, Any, Literal

from oilfilm.bearing.dynamics.choices import (
    Guidance,
    Integration,
    LoadType,
    NormalLaw,
    RaceStiffness,
    Start,
)
from oilfilm.bearing.friction.resistance import Cage
from oilfilm.bearing.geometry import Race
from oilfilm.ehl.traction.friction_coefficients import COEFFICIENTS
from oilfilm.ehl.units import from_si

from .fields import (
    FREE_WORD,
    LENGTH_MAXIMUM,
    Clearances,
    DisplacementTable,
    Gravity,
    LoadTable,
    MomentTable,
    OneOf,
    SpeedTable,
    Table,
    TemperatureTable,
    TiltTable,
    above,
    between,
    described,
    within,
)
from .friction import SIMULATED, FrictionTable
from .lubricant import VISCOSITIES, oil_data, oil_of
from .rules import (
    Below,
    CaseProblem,
    CaseValues,
    Excludes,
    Needs,
    OnlyWith,
    Relation,
    Where,
    bounded,
    shown,
)


class DynamicsTable(Table):
    """Time simulation: `oilfilm dynamics`."""

    end_time_s: float | None = above(
        0, 1e4, 'simulated time; the longest one with end_time = "steady", then 5 if left out'
    )
    end_time: Literal["steady"] | None = described(
        "steady: ends where speeds of cage and balls drift no more"
    )
    output_interval_us: float | None = above(
        0,
        1e9,
        "between rows of the history; default: a 2000th of the simulated time, with end_time = "
        '"steady" a 64th of a turn; with [form] a multiple of the record\'s',
    )
    start: Annotated[str, OneOf(Start)] = described(
        "equilibrium; balls rolling on the outer race; or at rest there", "quasi-static"
    )
    starts: int | None = between(
        1,
        100,
        "runs, with balls turned by a part of a pitch, and slower; default: 2 where pockets alone "
        "drive balls under a load across the axis, else 1",
    )
    equations: Annotated[str, OneOf("by load", LoadType)] = described(
        "the fewest that the loads allow, or those named", "by load"
    )
    integration: Annotated[str, OneOf(Integration)] = described(
        "explicit: resolves contact vibration and impacts; implicit: without them, in a tenth to "
        "a half of the time",
        "explicit",
    )
    speed_table_rpm: SpeedTable | None = described(
        "[[time in s, speed of the inner ring], ...], linear between, instead of a constant speed"
    )
    outer_speed_table_rpm: SpeedTable | None = described(
        "[[time in s, speed of the outer ring], ...], likewise"
    )
    load_table_N: LoadTable | None = described(
        "[[time in s, fx, fy, fz], ...], linear between, instead of a constant load"
    )
    moment_table_N_mm: MomentTable | None = described(
        "[[time in s, my, mz], ...], linear between, where the tilt is free"
    )
    displacement_table_um: DisplacementTable | None = described(
        '[[time in s, x, y, z], ...], likewise; "free" as in displacement_um of [operation]'
    )
    tilt_table_mrad: TiltTable | None = described(
        "[[time in s, about y, about z], ...], likewise, where the tilt is held"
    )
    temperature_table_C: TemperatureTable | None = described(
        "[[time in s, temperature], ...], of the oil in pockets and lands; one of the library"
    )
    contact_law: Annotated[str, OneOf(NormalLaw)] = described(
        "normal force; lubricated: the film of the traction table", "lankarani-nikravesh"
    )
    restitution: float = above(0, 1, "e that the contact law is given", 0.9)
    impact_speed_floor_m_s: float = above(
        0, 1e3, "least speed of an impact; slower ones are damped by their film", 0.05
    )
    race_stiffness: Annotated[str, OneOf(RaceStiffness)] = described(
        "of the grooved race, or a sphere on the race's circle, Shan et al. (2023)", "hertz"
    )
    friction: Annotated[str, OneOf(*COEFFICIENTS, "coulomb", "table", "none")] = described(
        "of ball on race, constants in [friction]; table: solved films", "four constants"
    )
    friction_on: Literal["ellipse", "centre"] = described(
        "a coefficient holds over the Hertz ellipse, or at its centre only", "ellipse"
    )
    friction_dead_band_m_s: float = between(0, 100, "coulomb: v0, no friction below", 0.0)
    friction_full_m_s: float = above(0, 100, "coulomb: v1, all of it above", 0.05)
    ball_drag_N: float | None = between(0, 1e4, "of a ball at its kinematic speed; grows as v^2")
    mixture_density_kg_m3: float | None = between(0, 2e4, "of oil and air; or ball_drag_N")
    drag_coefficient: float = between(0, 10, "of a ball in the mixture", 0.47)
    rotating_load_N: float | None = above(
        0, 1e9, "rotating, on the inner ring across the axis, added to the loads of [operation]"
    )
    rotating_load_speed_rpm: float | None = within(
        1e6, "of this load; default: that of the inner ring in [operation]"
    )
    rotating_load_phase_deg: float = within(360, "from +y at time zero", 0.0)
    gravity_m_s2: Gravity = described("[x, y, z]", (0.0, 0.0, 0.0))
    ring_mass_kg: float | None = above(0, 1e6, "ring and what turns with it; else ring alone")
    ring_damping_N_s_m: float = between(0, 1e9, "of the inner ring's support along x, y, z", 0.0)
    unbalance_g_mm: float = between(0, 1e9, "of the inner ring", 0.0)
    unbalance_phase_deg: float = within(360, "from +y at time zero", 0.0)
    cage: bool = described("false: a full complement of balls, which meet each other", True)
    ball_on_ball_friction: float = between(0, 1, "Coulomb's mu, without a cage", 0.0)
    cage_film: bool = described("oil film in the pockets and lands of the cage", True)
    cage_friction_ramp_m_s: float = above(0, 100, "sliding speed up to which friction rises", 0.01)
    tolerance: float = between(1e-8, 1e-2, "of a step, in units of contact approach", 1.0e-4)


class CageTable(Table):
    """The cage."""

    pocket_friction: float | None = between(
        0, 1, "Coulomb's mu of the pockets; default: 0.05 (0.02 to 0.15), none in a simulation"
    )
    guided_by: Annotated[str, OneOf(Guidance)] = described("what guides it", "balls")
    land_diameter_mm: float | None = above(0, LENGTH_MAXIMUM, "of the guiding land")
    land_width_mm: float | None = above(0, LENGTH_MAXIMUM, "of both lands together")
    land_clearance_um: float | None = above(0, 1e4, "radial, between cage and land")
    land_friction: float = between(
        0, 1, "Coulomb's mu where the film is used up; dynamics, and a dry land", 0.0
    )
    land_oil_share: float = between(
        0, 1, "of the land that oil fills; the rest rubs dry under weight and play; assumed", 1.0
    )
    pocket_clearance_mm: float | None = above(
        0, 100, "diametral, pocket less ball; default: estimated"
    )
    pocket_clearances_mm: Clearances | None = described(
        "dynamics: diametral, pocket by pocket, instead of pocket_clearance_mm"
    )
    unbalance_g_mm: float = between(0, 1e9, "dynamics: towards the first pocket", 0.0)
    drag_N_mm: float = between(
        0, 1e9, "dynamics: torque of the oil at the kinematic speed; grows as its square", 0.0
    )
    thickness_mm: float | None = above(0, LENGTH_MAXIMUM, "radial; default: estimated")
    width_mm: float | None = above(0, LENGTH_MAXIMUM, "axial; default: estimated")
    mass_g: float | None = above(0, 1e6, "default: from the dimensions")
    polar_inertia_g_mm2: float | None = above(
        0, 1e15, "about the bearing's axis; default: from the dimensions"
    )


LAND = ("land_diameter_mm", "land_width_mm", "land_clearance_um")
RACES = {"inner ring": Race.INNER, "outer ring": Race.OUTER}
# a cage whose land is needed: for its friction, or its motion
GUIDED_BY_RING = tuple(
    Where("cage.guided_by", ring, also=(Where(use),))
    for ring in RACES
    for use in ("cage.pocket_friction", "dynamics")
)
LARGEST_HISTORY = 2_000_000  # rows; of ten balls, some 420 numbers each, 7 GB
SAMPLES = 2000  # of a history by default
TURN_SAMPLES = 64  # of a turn, where the end is not known
LONGEST = 5.0  # [s]
TEMPERATURES = ("dynamics", "temperature_table_C")
RELATIONS: tuple[Relation, ...] = (
    OnlyWith("cage.land_oil_share", (Where("cage.pocket_friction"),), default=1.0),
    Excludes("dynamics.ball_drag_N", "dynamics.mixture_density_kg_m3"),
    Excludes("cage.pocket_clearances_mm", "cage.pocket_clearance_mm"),
    Below("dynamics.friction_dead_band_m_s", "dynamics.friction_full_m_s", low_default=0.0),
    OnlyWith("dynamics.rotating_load_speed_rpm", (Where("dynamics.rotating_load_N"),)),
    OnlyWith(
        "dynamics.rotating_load_phase_deg", (Where("dynamics.rotating_load_N"),), default=0.0
    ),
    *(
        Needs(f"cage.{name}", where, "needed where a ring guides the cage")
        for name in LAND
        for where in GUIDED_BY_RING
    ),
)


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [dynamics] and [cage]: a history that is too long, a law without its table.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    if values.given("dynamics") and not (
        values.given("dynamics", "end_time_s") or values.given("dynamics", "end_time")
    ):
        allowed = 'needed: the simulated time [s], or end_time = "steady"'
        yield CaseProblem(("dynamics", "end_time_s"), "missing", allowed)
    share = values.get("cage", "land_oil_share")
    if share is not None and share < 1.0:
        for name in ("land_friction", "mass_g"):
            if not values.get("cage", name):
                finding = f"missing with land_oil_share = {shown(share)}"
                yield CaseProblem(("cage", name), finding, "needed: what rubs on a dry land")
        if values.get("cage", "guided_by") not in RACES:
            finding = f"found {shown(share)} for a cage that balls guide"
            yield CaseProblem(("cage", "land_oil_share"), finding, "allowed with a guiding ring")
    end = values.get("dynamics", "end_time_s")
    if end is not None:
        least = from_si("output_interval_us", end / LARGEST_HISTORY)
        allowed = f"at least {least:.3g}, {LARGEST_HISTORY} rows"
        key = "dynamics.output_interval_us"
        yield from bounded(values, key, lambda interval: interval >= least, allowed)
    yield from _schedule_faults(values)
    lubricated = values.get("dynamics", "contact_law") == "lubricated"
    if lubricated and values.get("dynamics", "friction") != "table":
        path = ("dynamics", "contact_law")
        allowed = 'needed: friction = "table", which holds film and damping'
        yield CaseProblem(path, 'found "lubricated"', allowed)


def _schedule_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of tables over time with [operation], and temperatures without effect."""
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


def end_time(table: DynamicsTable) -> float:
    """Simulated time, the longest one of a simulation that ends where it is steady.

    Parameters
    ----------
    table : DynamicsTable
        The checked table.

    Returns
    -------
    float
        The time [s].
    """
    return LONGEST if table.end_time_s is None else table.end_time_s


def sample_interval(table: DynamicsTable, speed: float) -> float:
    """Time between rows of the history.

    Parameters
    ----------
    table : DynamicsTable
        The checked table.
    speed : float
        Speed of the rings against each other [rad/s].

    Returns
    -------
    float
        The time [s].
    """
    interval = table.si()["output_interval"]
    end = end_time(table)
    usual = end / SAMPLES
    if table.end_time is not None and speed != 0.0:
        usual = 2.0 * pi / abs(speed) / TURN_SAMPLES
    return min(usual if interval is None else interval, end)


def simulated_friction(table: FrictionTable) -> dict[str, float]:
    """The four constants and Coulomb's mu of a simulation.

    Parameters
    ----------
    table : FrictionTable
        The checked table [friction].

    Returns
    -------
    dict[str, float]
        Values by key [-].
    """
    given = {name: getattr(table, name) for name in SIMULATED}
    return {name: SIMULATED[name] if x is None else x for name, x in given.items()}


def cage_friction(table: CageTable | None, dynamics: DynamicsTable | None) -> Cage:
    """Friction of the cage, typical where it is not given.

    Parameters
    ----------
    table : CageTable | None
        The checked table [cage], where there is one.
    dynamics : DynamicsTable | None
        The checked table [dynamics], where there is one, whose balls may be without a cage.

    Returns
    -------
    Cage
        The cage, SI.
    """
    if dynamics is not None and not dynamics.cage:
        return Cage(pocket_friction=0.0)
    if table is None:
        return Cage()
    land = table.si(*LAND) if table.guided_by in RACES else {}
    outer_guided = table.guided_by == "outer ring"
    mass = table.si()["mass"]
    return Cage(
        pocket_friction=table.pocket_friction,
        outer_guided=outer_guided,
        land_oil_share=table.land_oil_share,
        land_friction=table.land_friction,
        mass=mass or 0.0,
        **land,
    )


def guiding_land(table: CageTable | None) -> tuple[Race, float] | None:
    """The race that guides the cage, and the diameter of its land.

    Parameters
    ----------
    table : CageTable | None
        The checked table [cage], where there is one.

    Returns
    -------
    tuple[Race, float] | None
        Race and diameter [m]; None where balls guide it.
    """
    if table is None or table.guided_by not in RACES or table.land_diameter_mm is None:
        return None
    return RACES[table.guided_by], table.si()["land_diameter"]
