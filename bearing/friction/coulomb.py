r"""Coulomb friction of ball and race over the Hertz ellipse, a potential of their relative motion.

With the motion k = (S_x, S_y, Omega, omega) of ball against race
(`oilfilm.ehl.conditions.ContactKinematics`) the ball slides at

    s_x = S_x - Omega y - omega y^2/(2 R),      s_y = S_y + Omega x,

which is linear in k. Friction mu p against the sliding is then the gradient of the power
:math:`\phi(k) = \mu \iint p\,|s|\,dA`, a convex function:

    d phi/dk = -(F_x, F_y, M_n, M_y),   forces and moments on the ball about n and y at the
    contact's centre,

so that the motion in which friction balances itself on the ball is the one of least power. Two
laws: the full integral over the ellipse, and the one of narrow ellipses, which leaves out s_y
(lines of pure rolling; Jones, 1959). Array axes: contacts first.

A coefficient by the local sliding is added in `ehl.traction.friction_coefficients`.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.traction.shear import EllipseRule, ellipse_nodes

from ..contacts.contact import BearingContact
from ..contacts.shape import dry_contacts
from ..quasistatic.solution import QuasistaticSolution
from . import _kernels
from .balance import BalancedFriction, balance_balls, curvature_slip
from .contact_friction import ContactFriction, Dissipation

# e of Coulomb's law over the largest sliding that the curvature of the contact makes [-]: half and
# double of it change the friction power of 25 random bearings by 2.4e-3 at most, as much as the
# quadrature. The ramp of a simulation (`RampedCoulomb`), as wide, changes it by 9e-4, but its
# kinks stop Newton's method: of these bearings 13 find a balance, of rounded friction all. A
# simulation keeps the ramp, whose dead band and width are keys of a case.
ROUNDING = 3.0e-3


class Ellipses(NamedTuple):
    """Loaded ellipses of contacts, each of shape (N,)."""

    load: Array  # Q [N]; zero where there is no contact
    # along and across the rolling direction, positive also where unloaded
    semi_axis_x: Array  # [m]
    semi_axis_y: Array  # [m]
    radius: Array  # R of the loaded surface across the rolling direction [m]
    friction: Array  # Coulomb's mu [-]
    # e, sliding below which friction is rounded off where it is integrated by quadrature [m/s]
    rounding: Array

    def take(self, indices: NDArray[np.int64]) -> "Ellipses":
        """Some of the ellipses.

        Parameters
        ----------
        indices : NDArray[np.int64]
            numbers of the contacts, shape (n,) [-]

        Returns
        -------
        Ellipses
            ellipses of these contacts
        """
        return Ellipses(*(values[indices] for values in self))

    @property
    def numbers(self) -> Array:
        """mu Q, semi-axes along and across, 1/(2R), e as kernels take them, shape (N, 5)."""
        friction = self.friction * self.load
        axes = (self.semi_axis_x, self.semi_axis_y)
        return np.stack([friction, *axes, 0.5 / self.radius, self.rounding], axis=1)


def ellipse_sums(motion: Array, numbers: Array) -> Dissipation:
    """Friction over the whole ellipse, both directions of sliding, by quadrature.

    |s| is rounded to sqrt(s^2 + e^2) [m/s]. Hertz's pressure is taken into the weights.

    Parameters
    ----------
    motion : Array
        S_x, S_y [m/s], Omega and omega [rad/s], shape (N, 4)
    numbers : Array
        `Ellipses.numbers`, shape (N, 5)

    Returns
    -------
    Dissipation
        power with its gradient and slope [W]
    """
    result = _empty(len(motion))
    _kernels.coulomb_sums(ellipse_nodes(EllipseRule.BALANCE), numbers, motion, *result)
    return result


def line_sums(motion: Array, numbers: Array) -> Dissipation:
    """Friction of narrow ellipses: exact integrals between the lines of pure rolling, the roots of
    s_x.

    Parameters
    ----------
    motion : Array
        S_x, S_y [m/s], Omega and omega [rad/s], shape (N, 4); S_y does not count
    numbers : Array
        `Ellipses.numbers`, shape (N, 5)

    Returns
    -------
    Dissipation
        power with its gradient and slope [W]
    """
    result = _empty(len(motion))
    _kernels.line_sums(numbers, motion, *result)
    return result


def _empty(count: int) -> Dissipation:
    """Dissipation of so many contacts, to be filled."""
    return Dissipation(np.empty(count), np.empty((count, 4)), np.empty((count, 4, 4)))


def contact_ellipses(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], friction: float | Array
) -> Ellipses:
    """The ellipses of all contacts under Coulomb's friction, rounded by `ROUNDING`.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    friction : float | Array
        Coulomb's mu, one value or one a contact [-]

    Returns
    -------
    Ellipses
        ellipses, lengths in [m]
    """
    load, semi_axis_x, semi_axis_y, radius = dry_contacts(solution.bearing, contacts)
    return Ellipses(
        load=load,
        semi_axis_x=semi_axis_x,
        semi_axis_y=semi_axis_y,
        radius=radius,
        friction=np.broadcast_to(np.asarray(friction, dtype=np.float64), radius.shape),
        rounding=ROUNDING * curvature_slip(solution, contacts),
    )


def coulomb_law(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    friction: float | Array,
    *,
    lines: bool = False,
) -> ContactFriction:
    """Coulomb's friction over the ellipses of all contacts; no rolling resistance.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    friction : float | Array
        Coulomb's mu, one value or one a contact [-]
    lines : bool, default False
        by lines of pure rolling: without sliding across the rolling direction

    Returns
    -------
    ContactFriction
        law of the contacts
    """
    ellipses = contact_ellipses(solution, contacts, friction)
    numbers = ellipses.numbers
    sums = line_sums if lines else ellipse_sums
    return ContactFriction(
        evaluate=lambda motion, indices: sums(motion, numbers[indices]),
        reference_force=ellipses.friction * ellipses.load,
        longitudinal_only=lines,
        has_rolling_resistance=False,
        kinds=np.stack(ellipses, axis=1),
    )


def balanced_friction(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    friction: float | Array,
    *,
    lines: bool = False,
    gyroscopic: bool = True,
    initial_guess: BalancedFriction | None = None,
) -> BalancedFriction:
    """Motion of all balls in balance under Coulomb's friction, and its power.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    friction : float | Array
        Coulomb's mu, one value or one a contact [-]
    lines : bool, default False
        by lines of pure rolling, which cannot hold the gyroscopic couple: it is left out
    gyroscopic : bool, default True
        the contacts have to hold the gyroscopic couple
    initial_guess : BalancedFriction | None, optional
        balance of a similar law, where the search begins

    Returns
    -------
    BalancedFriction
        balance of the balls
    """
    law = coulomb_law(solution, contacts, friction, lines=lines)
    return balance_balls(
        solution, contacts, law, gyroscopic=gyroscopic, initial_guess=initial_guess
    )
