"""Friction torque from a friction law of each race: a traction table of solved films, Coulomb's law, four constants.

What `integrated` does with every contact's own film, in milliseconds: the balls' motion in which the laws' forces
balance themselves, and the torque there. The oil's rolling resistance and the curvature slip come out of a table as one
moment about the transverse axis, so that `rolling` holds both and `curvature` is None; a coefficient over the ellipse
has the slip alone. No law has asperities: tables hold the central film, their share follows from the minimum.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ehl.traction.laws import CoulombLaw, FourConstantLaw, FrictionLaw
from ehl.traction.table import TractionTable

from ..contacts import BearingContact
from ..geometry import Array, Race
from ..quasistatic import QuasistaticSolution
from .balance import BalancedFriction, ContactLaw, balance_driven_balls, resisted_power
from .contact_friction import Dissipation
from .integrated import STRENGTH
from .motion_map import MotionMap, ball_speeds, motion_map
from .resistance import FREE, Resistance
from .shear_torque import IntegratedTorque, SolvedShear, carried_balls, not_balanced, not_closed

Evaluate = Callable[[NDArray[np.int64], Array, Array], tuple[Array, Array]]
ONE_MOMENT = {
    "curvature": "the friction law has one moment about the transverse axis: rolling holds the curvature slip"
}
NO_OIL = {"rolling": "the friction law is a coefficient over the ellipse and knows no rolling resistance of the oil"}
NO_ASPERITIES = {"asperity": "the friction law holds no minimum film, from which the share of asperities follows"}
STEP = 1.0e-5  # of slides over u, and spin over u/R_x, for difference quotients [-]


def tabulated_torque(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], laws: Mapping[Race, FrictionLaw]
) -> SolvedShear:
    """Torque of all lubricated contacts by the friction laws of the races, under the hypothesis and in balance.

    Parameters
    ----------
    solution : QuasistaticSolution
        With rings that turn against each other [rad/s].
    contacts : sequence of BearingContact
        All of its contacts, inner then outer, ball by ball.
    laws : mapping of Race to FrictionLaw

    Returns
    -------
    SolvedShear
        [N m], [W].
    """
    return law_torque(solution, contacts, contact_law(contacts, [laws[contact.race] for contact in contacts]))


def law_torque(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], law: ContactLaw, resistance: Resistance = FREE
) -> SolvedShear:
    """Torque by the friction of all contacts, at the motion of the solution and in balance.

    Parameters
    ----------
    solution, contacts
        As in `tabulated_torque`.
    law : ContactLaw
        Friction in [N], [N m].
    resistance : Resistance, optional
        What holds the balls back beside the races.

    Returns
    -------
    SolvedShear
        [N m], [W].
    """
    move = motion_map(solution, contacts)
    motion = move.motion(*ball_speeds(solution))
    forces = -law.dissipation(motion, np.arange(len(contacts))).gradient
    untold = (ONE_MOMENT if law.pumps else NO_OIL) | NO_ASPERITIES
    hypothesis = _torque(solution, move, (motion, forces), law)
    hypothesis = replace(hypothesis, resisted=resisted_power(solution, resistance))
    balance = balance_driven_balls(solution, contacts, law, resistance)
    if not balance.converged:
        return SolvedShear(hypothesis=hypothesis, note=not_balanced(balance), untold=untold)
    balanced = balance.kinematics.reshape(-1, 4), balance.forces.reshape(-1, 4)
    found = replace(_torque(solution, move, balanced, law), resisted=balance.resisted)
    carried = carried_balls(solution, balance)
    return SolvedShear(hypothesis=hypothesis, balanced=found, carried=carried, note=not_closed(found), untold=untold)


def law_balance(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], laws: Mapping[Race, FrictionLaw]
) -> BalancedFriction:
    """Motion of all balls in which the laws' forces balance themselves; arguments as in `tabulated_torque`, SI."""
    law = contact_law(contacts, [laws[contact.race] for contact in contacts])
    return balance_driven_balls(solution, contacts, law)


def contact_law(contacts: Sequence[BearingContact], laws: Sequence[FrictionLaw]) -> ContactLaw:
    """Friction [N] of all contacts by a law each, where they are lubricated."""
    groups = _groups(contacts, laws)
    places = np.array([_place(contact) for contact in contacts])

    def law(motion: Array, numbers: NDArray[np.int64]) -> Dissipation:
        gradient, slope = np.zeros((numbers.size, 4)), np.zeros((numbers.size, 4, 4))
        for members, evaluate in groups:
            rows = np.flatnonzero(members[numbers])
            if rows.size:
                gradient[rows], slope[rows] = evaluate(numbers[rows], places[numbers[rows]], motion[rows])
        return Dissipation(np.zeros(numbers.size), gradient, slope)

    load = np.array([contact.load if contact.conditions is not None else 0.0 for contact in contacts])
    pumps = not all(isinstance(one, CoulombLaw | FourConstantLaw) for one in laws)
    return ContactLaw(dissipation=law, strength=STRENGTH * load, potential=False, pumps=pumps)


def _place(contact: BearingContact) -> tuple[float, float, float]:
    """Load [N], entrainment speed [m/s] and rolling radius [m]."""
    c = contact.conditions
    return (0.0, 0.0, 1.0) if c is None else (c.load, c.entrainment_speed, c.radius_x)


def _groups(
    contacts: Sequence[BearingContact], laws: Sequence[FrictionLaw]
) -> list[tuple[NDArray[np.bool_], Evaluate]]:
    """Lubricated contacts that are evaluated together: those of one table, those of one kind of coefficient."""
    kinds: dict[object, list[int]] = {}
    for number, (contact, law) in enumerate(zip(contacts, laws, strict=True)):
        if contact.conditions is not None:
            alike = type(law) if isinstance(law, CoulombLaw | FourConstantLaw) else id(law)
            kinds.setdefault(alike, []).append(number)
    groups = []
    for numbers in kinds.values():
        members = np.zeros(len(contacts), dtype=np.bool_)
        members[numbers] = True
        groups.append((members, _evaluation(laws, laws[numbers[0]])))
    return groups


def _evaluation(laws: Sequence[FrictionLaw], first: FrictionLaw) -> Evaluate:
    """Minus the forces and their slopes of some contacts, by number, place and motion, for laws like the first."""
    from . import _kernels

    if isinstance(first, CoulombLaw | FourConstantLaw):
        disc, blank = first.disc, (first.kernel_law(), first.shape.constants)
        alike = [law if isinstance(law, type(first)) else None for law in laws]
        constants = np.array([blank[0] if law is None else law.kernel_law() for law in alike])
        shapes = np.array([blank[1] if law is None else law.shape.constants for law in alike])

        def coefficients(numbers: NDArray[np.int64], places: Array, motion: Array) -> tuple[Array, Array]:
            found = np.empty((numbers.size, 4)), np.empty((numbers.size, 4, 4))
            _kernels.hertz_gradients(disc, constants[numbers], shapes[numbers], places, motion, STEP, *found)
            return found

        return coefficients
    if isinstance(first, TractionTable):
        arguments = first.kernel_arguments()

        def table(numbers: NDArray[np.int64], places: Array, motion: Array) -> tuple[Array, Array]:
            found = np.empty((numbers.size, 4)), np.empty((numbers.size, 4, 4))
            _kernels.table_gradients(*arguments, places, motion, STEP, *found)
            return found

        return table

    def one_by_one(numbers: NDArray[np.int64], places: Array, motion: Array) -> tuple[Array, Array]:
        found = [law_gradient(first, place, k) for place, k in zip(places, motion, strict=True)]
        return np.array([gradient for gradient, _ in found]), np.array([slope for _, slope in found])

    return one_by_one


def law_gradient(law: FrictionLaw, place: Array, motion: Array) -> tuple[Array, Array]:
    """Minus the forces and moments (4,) on the ball by a law, and their slope (4, 4) by sliding and spin.

    Parameters
    ----------
    law : FrictionLaw
    place : ndarray, shape (3,)
        Load [N], entrainment speed [m/s], rolling radius [m]; the entrainment is that of the rolling speed.
    motion : ndarray, shape (4,)
        Sliding along and across [m/s], spin and rolling [rad/s].
    """
    load, speed, radius = (float(value) for value in place)
    here, slope = np.array(law.forces(load, speed, *(float(part) for part in motion[:3]))[:4]), np.zeros((4, 4))
    for j, step in enumerate((STEP * speed, STEP * speed, STEP * speed / radius)):
        moved = motion[:3].copy()
        moved[j] += step
        slope[:, j] = -(np.array(law.forces(load, speed, *(float(part) for part in moved))[:4]) - here) / step
    return -here, slope


def _torque(
    solution: QuasistaticSolution, move: MotionMap, moved: tuple[Array, Array], law: ContactLaw
) -> IntegratedTorque:
    """Torque from the motions and forces (contacts, 4) of all contacts [m/s], [rad/s], [N], [N m]."""
    motion, forces = moved
    speed = abs(solution.operation.inner_speed - solution.operation.outer_speed)
    powers = -forces * motion
    heat = powers.sum(axis=1)
    across = float(powers[:, 3].sum()) / speed
    return IntegratedTorque(
        rolling=across if law.pumps else None,
        sliding=float(powers[:, :2].sum()) / speed,
        spin=float(powers[:, 2].sum()) / speed,
        curvature=None if law.pumps else across,
        asperity=None,
        shaft_power=-float(np.sum(forces * move.ring)),
        heat=float(heat.sum()),
        per_ball=heat.reshape(-1, 2).sum(axis=1) / speed,
    )
