"""Capacitance of a bearing between its rings, and the voltage that breaks its films down.

From race to race two films and a ball lie in series, the balls side by side:

    C = sum over the balls of 1/(1/C_i + 1/C_b + 1/C_o)

A ball of steel conducts (1/C_b = 0). One of silicon nitride has a capacitance between that of two
spots as large as Hertz' ellipses on half-spaces, by the analogy with heat, 1/C = 2 K(m)/(2 pi
eps a) with the mean semi-axes, and that of straight columns from cap to cap, pi R eps: the
geometric mean is the value (assumed). The cage and the air beside the oil are left out.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import HertzContact
from oilfilm.ehl.traction.instruments import VACUUM_PERMITTIVITY, FilmInstruments

from ..geometry import Bearing, Race
from ..material import Material, MaterialKind
from .contact import BearingContact

# relative, of silicon nitride [-], from memory, unverified
CERAMIC_PERMITTIVITY = 8.0
CONDUCTOR = MaterialKind.BEARING_STEEL
INSULATOR = MaterialKind.SILICON_NITRIDE
Ends = tuple[float, float, float]  # value, low and high end


@dataclass(frozen=True, slots=True, kw_only=True)
class Electrical:
    """Capacitance and breakdown voltage of a bearing between its rings."""

    capacitance: float  # [F]
    capacitance_low: float  # by films and balls [F]
    capacitance_high: float  # [F]
    breakdown_voltage: float | None  # at which the first film breaks down [V]; ceramic balls: None
    breakdown_voltage_low: float | None  # [V]
    breakdown_voltage_high: float | None  # [V]


Contacts = Sequence[BearingContact]
Films = Sequence[FilmInstruments | None]


def bearing_electrical(bearing: Bearing, contacts: Contacts, films: Films) -> Electrical:
    """Capacitance of a bearing between its rings, and the voltage that breaks its films down.

    Parameters
    ----------
    bearing : Bearing
        a bearing of which `electrical_lack` misses nothing
    contacts : Contacts
        contacts of its equilibrium
    films : Films
        electrical values of the film of each contact, None without a solved film

    Returns
    -------
    Electrical
        capacitance [F] and breakdown voltage [V] with their ranges
    """
    paths = _paths(bearing, contacts, films)
    insulating = bearing.ball_material.kind is INSULATOR
    totals = [
        sum(_in_series(inner, outer, ball)[end] for inner, outer, ball in paths)
        for end in range(3)
    ]
    voltages: list[float | None] = [None] * 3
    if not insulating:
        voltages = [
            min(_first_breakdown(inner, outer, end) for inner, outer, _ in paths)
            for end in range(3)
        ]
    return Electrical(
        capacitance=totals[0],
        capacitance_low=totals[1],
        capacitance_high=totals[2],
        breakdown_voltage=voltages[0],
        breakdown_voltage_low=voltages[1],
        breakdown_voltage_high=voltages[2],
    )


def electrical_lack(bearing: Bearing, contacts: Contacts, films: Films) -> str:
    """Reason why a bearing has no capacitance; empty if it has one.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    contacts : Contacts
        contacts of its equilibrium
    films : Films
        electrical values of the film of each contact, None without a solved film

    Returns
    -------
    str
        reason, for a message
    """
    rings = (bearing.inner_ring_material, bearing.outer_ring_material)
    if any(ring.kind is INSULATOR for ring in rings):
        return "a ring of silicon nitride insulates"
    unknown = [m.name for m in (*rings, bearing.ball_material) if not _is_classified(m)]
    if unknown:
        return f"it is not known whether {unknown[0]!r} conducts"
    if not _paths(bearing, contacts, films):
        return "no ball has solved films that converged at both races"
    for contact, film in zip(contacts, films, strict=True):
        unsolved = contact.conditions is not None and film is None
        if unsolved and _carries_both(contacts, contact.ball):
            return 'not every loaded ball has solved films ([ehl] film_maps = "all")'
    return ""


def _is_classified(material: Material) -> bool:
    return material.kind in (CONDUCTOR, INSULATOR)


def _carries_both(contacts: Contacts, ball: int) -> bool:
    """Check that a ball touches both races: an unloaded inner contact breaks the path."""
    ball_contacts = [c for c in contacts if c.ball == ball]
    return all(c.conditions is not None for c in ball_contacts)


def _paths(
    bearing: Bearing, contacts: Contacts, films: Films
) -> list[tuple[FilmInstruments, FilmInstruments, Ends | None]]:
    """Films of the inner and outer contact, and the ball, of every ball that has both."""
    by_race: dict[Race, dict[int, tuple[HertzContact, FilmInstruments]]] = {}
    for contact, film in zip(contacts, films, strict=True):
        if film is not None and contact.hertz is not None:
            by_race.setdefault(contact.race, {})[contact.ball] = (contact.hertz, film)
    inner, outer = (by_race.get(race, {}) for race in (Race.INNER, Race.OUTER))
    insulating = bearing.ball_material.kind is INSULATOR
    paths = []
    for ball in sorted(inner.keys() & outer.keys()):
        capacitance = None
        if insulating:
            spots = [
                (hertz.semi_axis_x, hertz.semi_axis_y) for hertz, _ in (inner[ball], outer[ball])
            ]
            capacitance = _ball_capacitance(np.array(spots), 0.5 * bearing.ball_diameter)
        paths.append((inner[ball][1], outer[ball][1], capacitance))
    return paths


def _ball_capacitance(spots: Array, radius: float) -> Ends:
    """Capacitance of a ball of silicon nitride [F]; semi-axes of both spots (2, 2), radius [m]."""
    permittivity = VACUUM_PERMITTIVITY * CERAMIC_PERMITTIVITY
    short, long = np.sort(spots, axis=1).T
    one = 2.0 * pi * permittivity * long / scipy.special.ellipk(1.0 - (short / long) ** 2)
    low = float(1.0 / np.sum(1.0 / one))
    high = pi * radius * permittivity
    return sqrt(low * high), low, high


def _in_series(inner: FilmInstruments, outer: FilmInstruments, ball: Ends | None) -> Ends:
    """Two films and a ball [F]; the films with their error bars against and with each other."""
    ends = []
    for end, sign in enumerate((0.0, -1.0, 1.0)):
        films = [film.capacitance + sign * film.capacitance_uncertainty for film in (inner, outer)]
        series = [max(film, 0.0) for film in films]
        if ball is not None:
            series.append(ball[end])
        ends.append(0.0 if min(series) <= 0.0 else 1.0 / sum(1.0 / one for one in series))
    return ends[0], ends[1], ends[2]


def _first_breakdown(inner: FilmInstruments, outer: FilmInstruments, end: int) -> float:
    """Voltage from race to race at which one of two films in series breaks down [V]: each takes
    the share of the other's capacitance.
    """
    names = ("breakdown_voltage", "breakdown_voltage_low", "breakdown_voltage_high")
    together = inner.capacitance + outer.capacitance
    fractions = (outer.capacitance / together, inner.capacitance / together)
    pairs = zip((inner, outer), fractions, strict=True)
    return min(float(getattr(film, names[end])) / fraction for film, fraction in pairs)
