"""Friction torque from a friction law of each race: a traction table of solved films, Coulomb's law, four constants.

What `integrated` does with every contact's own film, in milliseconds: the balls' motion in which the laws' forces
balance themselves, and the torque there. The oil's rolling resistance and the curvature slip come out of a law as one
moment about the transverse axis, so that `rolling` holds both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ehl.traction.laws import FrictionLaw

from ..contacts import BearingContact
from ..geometry import Array, Race
from ..quasistatic import QuasistaticSolution
from ..traction_forces import bearing_kinematics
from .balance import BalancedFriction, ContactLaw, balance_driven_balls, ring_power
from .contact_friction import Dissipation
from .integrated import STRENGTH, IntegratedTorque, SolvedShear, carried_balls
from .resistance import FREE, Resistance

STEPS = (1.0e-5, 1.0e-5, 1.0e-5)  # of slide_x, slide_y over u, and spin over u/R_x, for difference quotients [-]


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
    motion = np.array([_motion(solution, contact) for contact in contacts])
    forces = -law.dissipation(motion, np.arange(len(contacts))).gradient
    hypothesis = _torque(solution, contacts, motion, forces)
    balance = balance_driven_balls(solution, contacts, law, resistance)
    if not balance.converged:
        note = f"no traction equilibrium found (residual {balance.residual:.1e}), the hypothesis of the motion is kept"
        return SolvedShear(hypothesis=hypothesis, note=note)
    found = _torque(solution, contacts, balance.kinematics.reshape(-1, 4), balance.forces.reshape(-1, 4))
    found = replace(found, resisted=balance.resisted)
    return SolvedShear(hypothesis=hypothesis, balanced=found, carried=carried_balls(solution, balance))


def law_balance(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], laws: Mapping[Race, FrictionLaw]
) -> BalancedFriction:
    """Motion of all balls in which the laws' forces balance themselves; arguments as in `tabulated_torque`, SI."""
    law = contact_law(contacts, [laws[contact.race] for contact in contacts])
    return balance_driven_balls(solution, contacts, law)


def contact_law(contacts: Sequence[BearingContact], laws: Sequence[FrictionLaw]) -> ContactLaw:
    """Friction [N] of all contacts by a law each, where they are lubricated."""

    def law(motion: Array, numbers: NDArray[np.int64]) -> Dissipation:
        gradient, slope = np.zeros((numbers.size, 4)), np.zeros((numbers.size, 4, 4))
        for row, number in enumerate(numbers):
            contact = contacts[number]
            if contact.conditions is not None:
                gradient[row], slope[row] = _gradient(laws[number], contact, motion[row])
        return Dissipation(np.zeros(numbers.size), gradient, slope)

    load = np.array([contact.load if contact.conditions is not None else 0.0 for contact in contacts])
    return ContactLaw(dissipation=law, strength=STRENGTH * load, potential=False)


def _motion(solution: QuasistaticSolution, contact: BearingContact) -> Array:
    k = bearing_kinematics(solution, contact)
    return np.array([k.sliding_x, k.sliding_y, k.spin, k.rolling])


def _forces(law: FrictionLaw, contact: BearingContact, motion: Array) -> Array:
    """Forces and moments (4,) on the ball; the entrainment is that which belongs to the rolling speed."""
    c = contact.conditions
    assert c is not None  # of a lubricated contact
    found = law.forces(c.load, c.entrainment_speed, float(motion[0]), float(motion[1]), float(motion[2]))
    return np.array(found[:4])


def _gradient(law: FrictionLaw, contact: BearingContact, motion: Array) -> tuple[Array, Array]:
    """Minus the forces (4,), and their slope (4, 4) by sliding and spin."""
    c = contact.conditions
    assert c is not None  # of a lubricated contact
    u = c.entrainment_speed
    here, slope = _forces(law, contact, motion), np.zeros((4, 4))
    for j, step in enumerate((STEPS[0] * u, STEPS[1] * u, STEPS[2] * u / c.radius_x)):
        moved = motion.copy()
        moved[j] += step
        slope[:, j] = -(_forces(law, contact, moved) - here) / step
    return -here, slope


def _torque(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], motion: Array, forces: Array
) -> IntegratedTorque:
    speed = abs(solution.operation.inner_speed - solution.operation.outer_speed)
    powers = -forces * motion
    heat = powers.sum(axis=1)
    return IntegratedTorque(
        rolling=float(powers[:, 3].sum()) / speed,
        sliding=float(powers[:, :2].sum()) / speed,
        spin=float(powers[:, 2].sum()) / speed,
        curvature=0.0,
        shaft_power=sum(ring_power(solution, c, f) for c, f in zip(contacts, forces, strict=True)),
        heat=float(heat.sum()),
        per_ball=heat.reshape(-1, 2).sum(axis=1) / speed,
    )
