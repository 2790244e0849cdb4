"""Laws that every result of a bearing obeys, checked while it runs.

A broken law is a fault of the program, or of a model outside its range: the result is then not
converged, and a message names the law, the place and the amount.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from oilfilm.ehl.units import from_si

from .contacts.contact import BearingContact
from .films.film import ContactFilm, FilmOrigin
from .heating.network import NODES
from .heating.self_heating import SelfHeatingSolution
from .quasistatic.solution import Frequencies, QuasistaticSolution
from .torque.breakdown import TorqueBreakdown
from .torque.integrated import SolvedShear

FORCE_TOLERANCE = 1.0e-6  # of forces and moments in balance, over the largest [-]
CONTACT_TOLERANCE = 1.0e-8  # of forces of contacts, over the largest load [-]
POWER_TOLERANCE = 1.0e-3  # of rings' power against torque times speed, balls in balance [-]
FILM_TOLERANCE = 1.0e-6  # of films that must be the same, and of the minimum over the centre [-]
GAP_TOLERANCE = 1.0e-3  # of films against the gap that they fill [-]
TEMPERATURE_TOLERANCE = 0.01  # [K]
TORQUE_TOLERANCE = 1.0e-9  # of a part that must not be negative, over the total [-]
FREQUENCY_TOLERANCE = 1.0e-9  # [-]
# parts of the torque that can only resist; curvature and sliding exchange power with each other
RESISTING = ("rolling", "spin", "asperity", "cage", "drag", "seal")


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckedState:
    """Results of one bearing that the laws connect."""

    quasistatic: QuasistaticSolution
    pour_point: float | None  # of the oil [K]; None: not known
    contacts: Sequence[BearingContact]
    films: Sequence[ContactFilm | None]  # operating ones of the contacts, as results show them
    frequencies: Frequencies
    torque: TorqueBreakdown | None
    heating: SelfHeatingSolution | None

    @property
    def shear(self) -> SolvedShear | None:
        """Shear of the films in the torque, where there is one."""
        return None if self.torque is None else self.torque.shear


def broken_laws(results: CheckedState) -> tuple[str, ...]:
    """Name the laws that a result breaks.

    Parameters
    ----------
    results : CheckedState
        Results of a bearing.

    Returns
    -------
    tuple of str
        A sentence each; empty where all hold, and without an equilibrium.
    """
    if not results.quasistatic.converged:
        return ()
    return tuple(f"check failed: {fault}" for check in CHECKS for fault in check(results))


def _flow(results: CheckedState) -> Iterator[str]:
    """Check that the oil flows: films, torque and life are those of an oil that does."""
    operation = results.quasistatic.operation
    least = results.pour_point
    if least is not None and operation.temperature < least and operation.shaft_speed > 0.0:
        at, end = (from_si("temperature_C", t) for t in (operation.temperature, least))
        yield (
            f"at {at:.0f} C the oil lies below its pour point, {end:.0f} C, and does not flow: "
            "no film, torque and modified life"
        )


def _minimum_films(results: CheckedState) -> Iterator[str]:
    """Check h_min <= h_c, both positive and finite."""
    for contact, film in zip(results.contacts, results.films, strict=True):
        if film is None:
            continue
        central = film.central.value
        least = central if film.minimum is None else film.minimum.value
        place = f"ball {contact.ball}, {contact.race.value} race"
        if not (np.isfinite(central) and 0.0 < least):
            yield f"{place}: the film is not a positive length"
        elif least > central * (1.0 + FILM_TOLERANCE):
            yield (
                f"{place}: the minimum film, {from_si('film_um', least):.4g} um, exceeds the "
                f"central one, {from_si('film_um', central):.4g} um"
            )


def _gaps(results: CheckedState) -> Iterator[str]:
    """Check that films of balls between two films fit their gaps.

    These were found with the films of atlas or formula, which a solved one differs from.
    """
    for contact, film in zip(results.contacts, results.films, strict=True):
        if contact.gap is None or contact.hertz is None:
            continue
        if film is None or film.origin is FilmOrigin.SOLVED or film.scaled:
            continue
        room = contact.gap + contact.hertz.approach
        central = film.central.value
        if abs(central - room) > GAP_TOLERANCE * central:
            yield (
                f"ball {contact.ball}, {contact.race.value} race: the film, "
                f"{from_si('film_um', central):.4g} um, does not fit the gap of "
                f"{from_si('film_um', room):.4g} um"
            )


def _sheared_films(results: CheckedState) -> Iterator[str]:
    """Check that torque and results have the same films."""
    shear = results.shear
    if shear is None or not shear.films:
        return
    pairs = zip(results.contacts, shear.films, results.films, strict=True)
    apart = [
        (contact, sheared.central.value, shown.central.value)
        for contact, sheared, shown in pairs
        if sheared is not None
        and shown is not None
        and abs(sheared.central.value - shown.central.value) > FILM_TOLERANCE * shown.central.value
    ]
    if apart:
        contact, sheared, shown = max(apart, key=lambda one: abs(one[1] / one[2] - 1.0))
        yield (
            f"the torque is of other films than the results: ball {contact.ball}, "
            f"{contact.race.value} race, {from_si('film_um', sheared):.4g} against "
            f"{from_si('film_um', shown):.4g} um"
        )


def _forces(results: CheckedState) -> Iterator[str]:
    """Check forces and moments of ring and balls in the equilibrium, and forces of the contacts.

    The contacts of balls between two films carry other loads than the dry equilibrium has.
    """
    residual = results.quasistatic.residual
    if not residual <= FORCE_TOLERANCE:
        yield f"forces and moments balance to {residual:.1e} only ({FORCE_TOLERANCE:g} allowed)"
    for name, left in forces_left(results.quasistatic, results.contacts).items():
        if not left <= CONTACT_TOLERANCE:
            yield f"the loads of the contacts leave {left:.1e} of the largest one on {name}"


def forces_left(s: QuasistaticSolution, contacts: Sequence[BearingContact]) -> dict[str, float]:
    """Force that contacts, friction and body forces leave on balls and inner ring.

    Parameters
    ----------
    s : QuasistaticSolution
        Equilibrium of the bearing, which has friction and body forces.
    contacts : sequence of BearingContact
        Its contacts, which have the loads.

    Returns
    -------
    dict of str to float
        Over the largest load [-], by what it acts on.
    """
    load = np.array([contact.load for contact in contacts])
    normal = np.array([contact.normal for contact in contacts])
    azimuth = np.array([contact.azimuth for contact in contacts])
    radial = np.stack([np.zeros_like(azimuth), np.cos(azimuth), np.sin(azimuth)], axis=1)
    around = np.stack([np.zeros_like(azimuth), -np.sin(azimuth), np.cos(azimuth)], axis=1)
    # the race pushes the ball against n, friction acts across it, in the plane of the axis
    friction = -np.stack([s.inner_friction, s.outer_friction], axis=1).ravel()
    force = -load[:, None] * normal + friction[:, None] * np.cross(normal, around)
    inner = force[::2]
    on_balls = inner + force[1::2] + s.centrifugal_force[:, None] * radial[::2]
    held = np.array([force is None for force in s.operation.force])
    # the balls drive the ring along their orbit
    of_balls = s.inner_drive[:, None] * around[::2] - inner
    on_ring = s.ring_force + of_balls.sum(axis=0)
    on_ring[held] = 0.0
    largest = max(float(load.max(initial=0.0)), 1e-300)
    return {
        "a ball": float(np.abs(on_balls).max(initial=0.0)) / largest,
        "the inner ring": float(np.abs(on_ring).max(initial=0.0)) / largest,
    }


def _powers(results: CheckedState) -> Iterator[str]:
    """Check torque times speed against the rings' power."""
    shear = results.shear
    if shear is None or not shear.closed:
        return
    error = shear.torque.relative_error
    if not error <= POWER_TOLERANCE:
        yield f"torque times speed and the power of the rings differ by {error:.1e}"


def _torque_parts(results: CheckedState) -> Iterator[str]:
    """Check that parts of the torque resist, and that they add up to the total."""
    torque = results.torque
    if torque is None or torque.chosen is None or torque.total is None:
        return
    if not np.isfinite(torque.total) or torque.total < 0.0:
        yield f"the torque, {from_si('torque_N_mm', torque.total):.4g} N mm, drives the bearing"
    parts = torque.models[torque.chosen].components
    left = torque.total - sum(parts.values())
    scale = sum(map(abs, parts.values()))
    if abs(left) > TORQUE_TOLERANCE * scale:
        yield f"the parts of the torque miss the total by {from_si('torque_N_mm', left):.3g} N mm"
    for name, value in parts.items():
        if name in RESISTING and value < -TORQUE_TOLERANCE * scale:
            yield (
                f"part '{name}' of the torque, {from_si('torque_N_mm', value):.3g} N mm, drives "
                "the bearing"
            )


def _temperatures(results: CheckedState) -> Iterator[str]:
    """Check that no node is colder than what cools the bearing."""
    heating = results.heating
    if heating is None or heating.state is None or not heating.converged:
        return
    state = heating.state
    coldest = min(state.network.boundaries.values())
    colder = [
        f"{name} at {from_si('temperature_C', float(value)):.2f} C"
        for name, value in zip(NODES, state.temperatures, strict=True)
        if np.isfinite(value) and value < coldest - TEMPERATURE_TOLERANCE
    ]
    if colder:
        yield (
            f"colder than all surroundings ({from_si('temperature_C', coldest):.2f} C): "
            f"{', '.join(colder)}"
        )


def _frequencies(results: CheckedState) -> Iterator[str]:
    """Check BPFO + BPFI = Z |n_i - n_o| of a cage between the speeds of the rings."""
    operation = results.quasistatic.operation
    cage = results.quasistatic.cage_speed
    low, high = sorted((operation.inner_speed, operation.outer_speed))
    rounding = FREQUENCY_TOLERANCE * max(abs(low), abs(high))  # rings of one speed, too
    if not low - rounding <= cage <= high + rounding:
        yield (
            f"the cage turns at {from_si('speed_rpm', cage):.4g} r/min, outside the speeds of "
            "the rings"
        )
        return
    found = results.frequencies.ball_pass_outer + results.frequencies.ball_pass_inner
    expected = results.quasistatic.bearing.balls * (high - low) / (2.0 * pi)
    if abs(found - expected) > FREQUENCY_TOLERANCE * expected + rounding:
        yield "the ball pass frequencies do not add up to balls times shaft speed"


CHECKS: tuple[Callable[[CheckedState], Iterator[str]], ...] = (
    _flow,
    _minimum_films,
    _gaps,
    _sheared_films,
    _forces,
    _powers,
    _torque_parts,
    _temperatures,
    _frequencies,
)
