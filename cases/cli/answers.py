"""Answers without an oil: dry contacts after Hertz, and the frequencies of a bearing's parts.

A designation is answered from the catalogue, without the solvers and their kernels; a case is read
and checked as for a run.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from math import cos, degrees, pi, radians
from pathlib import Path
from typing import Any

from oilfilm.bearing import geometry
from oilfilm.bearing.library.bearings import (
    catalogue_name,
    estimated_fields,
    load_catalogue_entry,
    unverified_size,
)
from oilfilm.bearing.quasistatic.solution import ball_spin_without_slip, cage_speed_without_slip
from oilfilm.bearing.quasistatic.thrust import loads_at_rest
from oilfilm.ehl.closed_form.hertz import HertzContact, hertz_contact
from oilfilm.ehl.units import RPM, from_si
from oilfilm.ehl.version import version

from ..format.rules import CaseError

FREQUENCIES = ("cage", "ball_pass_outer", "ball_pass_inner", "ball_spin", "twice_ball_spin")
ESTIMATES = ("balls", "ball_diameter_mm", "pitch_diameter_mm", "free_contact_angle_deg")


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownBearing:
    """A bearing by a designation or a case, and what else of it is known."""

    bearing: geometry.Bearing
    nominal_angle: float  # [rad]
    ranges: Mapping[str, tuple[float, float]]  # of estimated keys, in their units
    speeds: tuple[float, float] | None  # of inner and outer ring, of a case [rad/s]
    loads: tuple[float, float] | None  # radial and axial, of a case with one row [N]


def known_bearing(name: str) -> KnownBearing:
    """The bearing that a file, a shipped case or a designation names.

    Parameters
    ----------
    name : str
        Path, stem of a shipped case, or designation.

    Returns
    -------
    KnownBearing
        The bearing.

    Raises
    ------
    CaseError
        If there is none of this name, or the case is no bearing.
    """
    from ..format.shipped import shipped_cases

    is_file = Path(name).is_file() or Path(f"{name}.toml").is_file()
    is_case = is_file or name.removesuffix(".toml") in shipped_cases()
    if is_case or (catalogue_name(name) is None and name.endswith(".toml")):
        return _of_case(name)
    try:
        entry = load_catalogue_entry(name)
    except ValueError as error:
        raise CaseError(f"{error}; or a case file or the name of a shipped case") from None
    return KnownBearing(
        bearing=geometry.bearing_of_entry(entry),
        nominal_angle=radians(entry.get("free_contact_angle_deg") or 0.0),
        ranges={key: entry["range"][key] for key in ESTIMATES if key in entry.get("range", {})},
        speeds=None,
        loads=None,
    )


def _of_case(name: str) -> KnownBearing:
    from ..format.bearing import nominal_contact_angle
    from ..format.case import Case, load_case

    case = load_case(name)
    if not isinstance(case, Case):
        raise CaseError(f"{name}: is a single contact; allowed: a bearing")
    table = case.document["bearing"]
    named = case.file.bearing.name or ""
    fields = estimated_fields(named, table)
    ranges = load_catalogue_entry(named)["range"] if fields else {}
    operation = case.operation
    force = operation.force
    single = case.rows is None and None not in force
    x, y, z = (value or 0.0 for value in force)
    return KnownBearing(
        bearing=case.bearing,
        nominal_angle=nominal_contact_angle(case.file.bearing),
        ranges={key: ranges[key] for key in ESTIMATES if key in fields},
        speeds=(operation.inner_speed, operation.outer_speed),
        loads=((y**2 + z**2) ** 0.5, abs(x)) if single else None,
    )


def contact_answer(contact: HertzContact, **more: Any) -> dict[str, Any]:
    """A dry contact in the units of results.

    Parameters
    ----------
    contact : HertzContact
        The contact, SI.
    **more : Any
        Values to begin with.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    values = {
        "load_N": contact.load,
        "radius_x_mm": contact.radius_x,
        "radius_y_mm": contact.radius_y,
        "reduced_modulus_GPa": contact.reduced_modulus,
        "semi_axis_rolling_mm": contact.semi_axis_x,
        "semi_axis_transverse_mm": contact.semi_axis_y,
        "hertz_pressure_GPa": contact.pressure,
        "approach_um": contact.approach,
        "stiffness_N_um": 1.5 * contact.load / contact.approach,
    }
    return {**more, **{key: float(from_si(key, value)) for key, value in values.items()}}


def hertz_answer(
    name: str, load: float | None, radial: float | None, axial: float | None, angle: float | None
) -> dict[str, Any]:
    """Contacts of the heaviest ball of a bearing with both races.

    Parameters
    ----------
    name : str
        Designation or case.
    load : float | None
        Load of the ball [N]; None: that of the heaviest ball under the bearing's loads.
    radial, axial : float | None
        Loads of the bearing [N]; None: those of the case.
    angle : float | None
        Contact angle of a ball whose load is given [deg]; None: the free one.

    Returns
    -------
    dict[str, Any]
        The answer.

    Raises
    ------
    CaseError
        If no load is given, or a value is impossible.
    """
    known = known_bearing(name)
    bearing = known.bearing
    given = {"radial_load_N": radial, "axial_load_N": axial}
    if load is not None:
        contact_angle = bearing.free_contact_angle if angle is None else radians(angle)
        if radial is not None or axial is not None:
            raise CaseError("oilfilm hertz: --load and --radial or --axial; allowed: one of them")
    else:
        if radial is None and axial is None:
            if known.loads is None:
                raise CaseError(
                    f"oilfilm hertz {name}: a load is needed: --load of a ball, or --radial and "
                    "--axial of the bearing [N]"
                )
            radial, axial = known.loads
        radial, axial = radial or 0.0, axial or 0.0
        if min(radial, axial) < 0.0 or max(radial, axial) <= 0.0:
            raise CaseError("oilfilm hertz: --radial, --axial: allowed: from 0, one above 0")
        loads, angles = loads_at_rest(bearing, radial, axial)
        heaviest = int(loads.argmax())
        load, contact_angle = float(loads[heaviest]), float(angles[heaviest])
        given = {"radial_load_N": radial, "axial_load_N": axial}
    contacts = []
    for race in geometry.Race:
        radii = geometry.reduced_radii(bearing, race, contact_angle)
        contact = hertz_contact(load, *radii, geometry.contact_modulus(bearing, race))
        angle_deg = degrees(contact_angle)
        contacts.append(contact_answer(contact, race=race.value, contact_angle_deg=angle_deg))
    total = sum(contact["approach_um"] for contact in contacts)
    return {
        "oilfilm": version(),
        "bearing": bearing.name,
        **given,
        "contacts": contacts,
        "approach_of_rings_um": total,
        "messages": _estimated_text(known),
    }


def _estimated_text(known: KnownBearing) -> list[str]:
    if not known.ranges:
        return []
    parts = [f"{key} {low:g} to {high:g}" for key, (low, high) in known.ranges.items()]
    size = unverified_size(known.bearing.name)
    return [f"internal geometry is estimated: {', '.join(parts)}{size}"]


def frequencies_answer(
    name: str, speed: float | None, outer_speed: float | None, angle: float | None
) -> dict[str, Any]:
    """Frequencies of cage and balls without sliding, with the interval of an estimated interior.

    Parameters
    ----------
    name : str
        Designation or case.
    speed, outer_speed : float | None
        Speeds of inner and outer ring [r/min]; None: those of the case, or one turn a second.
    angle : float | None
        Contact angle [deg]; None: the nominal one.

    Returns
    -------
    dict[str, Any]
        The answer.
    """
    known = known_bearing(name)
    messages = _estimated_text(known)
    if speed is None and outer_speed is None:
        inner, outer = known.speeds or (60.0 * RPM, 0.0)
        if known.speeds is None:
            messages.append("no speed given: frequencies at 60 r/min, which is once a second")
    else:
        inner, outer = (speed or 0.0) * RPM, (outer_speed or 0.0) * RPM
    contact_angle = known.nominal_angle if angle is None else radians(angle)
    bearing = known.bearing
    values = _frequencies(
        bearing.balls, bearing.ball_diameter / bearing.pitch_diameter, contact_angle, inner, outer
    )
    corners = _corners(known, contact_angle, fixed=angle is not None, speeds=(inner, outer))
    ranges = {key: [min(one), max(one)] for key, one in corners.items()} if corners else None
    relative = abs(inner - outer) / (2.0 * pi)
    return {
        "oilfilm": version(),
        "bearing": bearing.name,
        "balls": bearing.balls,
        "ball_diameter_mm": 1e3 * bearing.ball_diameter,
        "pitch_diameter_mm": 1e3 * bearing.pitch_diameter,
        "contact_angle_deg": degrees(contact_angle),
        "inner_speed_rpm": inner / RPM,
        "outer_speed_rpm": outer / RPM,
        "frequencies_Hz": values,
        "ranges_Hz": ranges,
        "per_turn": {key: value / relative for key, value in values.items()} if relative else None,
        "messages": messages,
    }


def _frequencies(
    balls: float, ratio: float, angle: float, inner: float, outer: float
) -> dict[str, float]:
    """Frequencies [Hz] of `balls` balls, D/d_m [-], at a contact angle [rad], speeds [rad/s]."""
    turn = 2.0 * pi
    gamma = ratio * cos(angle)
    cage = cage_speed_without_slip(gamma, inner, outer)
    spin = ball_spin_without_slip(ratio, gamma, inner, outer) / turn
    values = (
        abs(cage) / turn,
        balls * abs(cage - outer) / turn,
        balls * abs(inner - cage) / turn,
        spin,
        2.0 * spin,
    )
    return dict(zip(FREQUENCIES, values, strict=True))


def _corners(
    known: KnownBearing, angle: float, *, fixed: bool, speeds: tuple[float, float]
) -> dict[str, list[float]]:
    """Frequencies [Hz] at the ends of all intervals; none of a bearing without estimates."""
    ends = dict(known.ranges)
    if not ends:
        return {}
    bearing = known.bearing
    numbers = ends.get("balls", (bearing.balls,))
    diameters = ends.get("ball_diameter_mm", (1e3 * bearing.ball_diameter,))
    pitches = ends.get("pitch_diameter_mm", (1e3 * bearing.pitch_diameter,))
    angles = [radians(end) for end in ends.get("free_contact_angle_deg", ())]
    found: dict[str, list[float]] = {key: [] for key in FREQUENCIES}
    for balls, diameter, pitch, at in product(
        numbers, diameters, pitches, [angle] if fixed or not angles else angles
    ):
        for key, value in _frequencies(balls, diameter / pitch, at, *speeds).items():
            found[key].append(value)
    return found
