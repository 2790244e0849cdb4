"""Balls in balance of Coulomb friction: by the lines of pure rolling, or over the whole ellipse in
both directions.
"""

from collections.abc import Sequence

import numpy as np

from ..contacts.contacts import BearingContact
from ..contacts.motion import groove_curvature_radius
from ..geometry import Array
from ..quasistatic.solution import QuasistaticSolution
from .balance import BalancedFriction, ContactLaw, balance_balls, curvature_slip
from .ellipse import Ellipses, coulomb_dissipation, line_dissipation

# of Coulomb's law, over the largest sliding that the curvature of the contact makes [-]
ROUNDING = 3.0e-3


def balanced_friction(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    friction: float | Array,
    *,
    lines: bool = False,
    gyroscopic: bool = True,
) -> BalancedFriction:
    """Motion of all balls in balance under Coulomb friction, and what it costs.

    Parameters
    ----------
    solution : QuasistaticSolution
    contacts : sequence of BearingContact
        All of its contacts, inner then outer, ball by ball.
    friction : float or ndarray, shape (contacts,)
        Coulomb's mu [-].
    lines : bool
        Leave out the sliding across the rolling direction, as models by lines of pure rolling do;
        the gyroscopic couple, which such a model cannot carry, is then left out too.
    gyroscopic : bool
        Whether the contacts have to hold the gyroscopic couple.

    Returns
    -------
    BalancedFriction
        In SI; not `converged` where the friction cannot hold a ball.
    """
    found = contact_ellipses(solution, contacts, friction)
    chosen = line_dissipation if lines else coulomb_dissipation
    law = ContactLaw(
        dissipation=lambda motion, numbers: chosen(motion, found.some(numbers)),
        strength=found.friction * found.load,
        plane=lines,
    )
    return balance_balls(solution, contacts, law, gyroscopic=gyroscopic)


def contact_ellipses(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], friction: float | Array
) -> Ellipses:
    """The ellipses of all contacts under Coulomb's mu [-], lengths in [m]; friction rounded as
    `ROUNDING` says.
    """
    hertz = [c.hertz for c in contacts]
    radius = np.array([groove_curvature_radius(solution.bearing, c.race) for c in contacts])
    transverse = np.array([1e-6 if h is None else h.semi_axis_y for h in hertz])
    return Ellipses(
        load=np.array([0.0 if h is None else h.load for h in hertz]),
        semi_axis_x=np.array([1e-6 if h is None else h.semi_axis_x for h in hertz]),
        semi_axis_y=transverse,
        radius=radius,
        friction=np.broadcast_to(np.asarray(friction, dtype=np.float64), radius.shape),
        rounding=ROUNDING * curvature_slip(solution, contacts),
    )
