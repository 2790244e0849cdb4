"""Friction torque from a friction law of each race: a traction table of solved films, Coulomb's
law, four constants.

What `integrated` does with every contact's own film, in milliseconds: the balls' motion in which
the laws' forces balance themselves, and the torque there. The oil's rolling resistance and the
curvature slip come out of a table as one moment about the transverse axis, so that `rolling` holds
both and `curvature` is None; a coefficient over the ellipse has the slip alone. No law has
asperities: tables hold the central film, their share follows from the minimum.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ehl.traction.laws import FrictionLaw

from ..contacts.contacts import BearingContact
from ..contacts.motion import MotionMap, ball_speeds, motion_map
from ..friction.balance import ContactLaw, balance_driven_balls, resisted_power
from ..friction.resistance import FREE, Resistance
from ..friction.tables import contact_law
from ..geometry import Array, Race
from ..quasistatic.solution import QuasistaticSolution
from .shear_torque import IntegratedTorque, SolvedShear, carried_balls, not_balanced, not_closed

ONE_MOMENT = {
    "curvature": "the friction law has one moment about the transverse axis: rolling holds the curvature slip"
}
NO_OIL = {
    "rolling": "the friction law is a coefficient over the ellipse and knows no rolling resistance of the oil"
}
NO_ASPERITIES = {
    "asperity": "the friction law holds no minimum film, from which the share of asperities follows"
}


def tabulated_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    laws: Mapping[Race, FrictionLaw],
) -> SolvedShear:
    """Torque of all lubricated contacts by the friction laws of the races, under the hypothesis
    and in balance.

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
    return law_torque(
        solution, contacts, contact_law(contacts, [laws[contact.race] for contact in contacts])
    )


def law_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactLaw,
    resistance: Resistance = FREE,
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
    return SolvedShear(
        hypothesis=hypothesis,
        balanced=found,
        carried=carried,
        note=not_closed(found),
        untold=untold,
    )


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
