"""Elastic rings in the summary: seat, compliance, what they yield, cost of the finite elements."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from bearing.geometry import Race
from bearing.quasistatic.ring import ball_forces, seat_reactions
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rings.compliance import response_of
from bearing.rings.elastic_ring import ElasticRing
from ehl.solid.bodies import RingResponse, Seat
from ehl.units import MEGAPASCAL, MICROMETRE

from ..quantities import values_of
from .quantities import RING_BODY

SMALL_TENSION = 1e3  # of a loose seat, not worth a message [Pa]


@dataclass(frozen=True, slots=True)
class RingBody:
    """One elastic ring of an equilibrium."""

    race: str
    ring: ElasticRing
    response: RingResponse
    movement: tuple[np.ndarray, np.ndarray]  # axial and radial at the balls [m]

    @property
    def axial_compliance(self) -> float:
        """At a ball, of its own force, beyond Hertz' [m/N]."""
        return float(self.response.at(np.zeros(1))[0, 0])

    @property
    def radial_compliance(self) -> float:
        """Likewise [m/N]."""
        return float(self.response.at(np.zeros(1))[1, 0])

    @property
    def deflection(self) -> float:
        """Largest movement of the groove's centre at a ball [m]."""
        return float(np.hypot(*self.movement).max())

    @property
    def ovality(self) -> float:
        """Largest less smallest radial movement [m]."""
        return float(np.ptp(self.movement[1]))


def ring_bodies(state: QuasistaticSolution) -> tuple[RingBody, ...]:
    """The elastic rings of an equilibrium, inner ring first.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    tuple[RingBody, ...]
        The rings.
    """
    rings = state.model.rings
    pairs = () if rings is None else (("inner", rings.inner), ("outer", rings.outer))
    return tuple(
        RingBody(
            race,
            ring,
            response_of(ring),
            (getattr(state, f"{race}_ring_axial"), getattr(state, f"{race}_ring_radial")),
        )
        for race, ring in pairs
        if ring is not None
    )


def ring_blocks(state: QuasistaticSolution) -> list[dict[str, Any]]:
    """Seat, compliance, movements and finite elements of each elastic ring; none, if rigid.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    list[dict[str, Any]]
        Values by key, a dictionary for each ring.
    """
    return [
        {
            "race": body.race,
            "seat": body.ring.seat.value,
            **values_of(body, RING_BODY),
            "shoulder_estimated": body.ring.estimated_shoulder,
            "unknowns": body.response.unknowns,
            "iterations": body.response.iterations,
            "method": body.response.method,
        }
        for body in ring_bodies(state)
    ]


def ring_messages(state: QuasistaticSolution) -> Iterator[str]:
    """Describe the seats of the elastic rings, and what was estimated.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    for body in ring_bodies(state):
        estimate = ", its shoulders estimated" if body.ring.estimated_shoulder else ""
        yield (
            f"{body.race} ring: an elastic body, {body.ring.seat.value} on its seat{estimate}; "
            f"grooves move by up to {body.deflection / MICROMETRE:.3g} um at the balls, beyond "
            "Hertz' approach; films and pressures are those of half-spaces"
        )
        for forces, _ in zip(*seat_reactions(state, Race(body.race)), strict=True):
            places = (
                f"{np.degrees(azimuth):.4g} deg: {force:.4g} N"
                for azimuth, force in zip(body.ring.supports, forces, strict=True)
            )
            yield f"{body.race} ring: pressed by its supports at {', '.join(places)}"
        tension = seat_tension(state, body)
        if tension > SMALL_TENSION:
            yield (
                f"{body.race} ring: its seat does not open: opposite the load it pulls with up to "
                f"{tension / MEGAPASCAL:.3g} MPa, where a loose ring would lift off and bend more"
            )


def seat_tension(state: QuasistaticSolution, body: RingBody) -> float:
    """Largest pull of a loose seat, F/(pi R B), with the cosine from the load; zero for other
    seats.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.
    body : RingBody
        Elastic ring.

    Returns
    -------
    float
        Largest pull [Pa].
    """
    if body.ring.seat is not Seat.FREE:
        return 0.0
    radial = ball_forces(state, Race(body.race))[1].reshape(len(state.rows), -1)
    turns = state.azimuth.reshape(radial.shape)
    load = np.hypot((radial * np.cos(turns)).sum(axis=1), (radial * np.sin(turns)).sum(axis=1))
    profile = body.ring.profile
    return float(load.max() / (pi * profile.seat_radius * profile.width))


def ring_lines(state: QuasistaticSolution) -> dict[str, str]:
    """A line of the terminal's table for each elastic ring.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    lines = {}
    for block in ring_blocks(state):
        compliance = f"{block['radial_compliance_um_kN']:.3g} µm/kN beyond Hertz"
        moves = f"moves {block['deflection_um']:.3g} µm, ovality {block['ovality_um']:.3g} µm"
        lines[f"{block['race']} ring"] = f"elastic, seat {block['seat']}: {compliance}, {moves}"
    return lines
