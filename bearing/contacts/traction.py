"""Traction at the contacts of a bearing: how ball and race move over each other, and what the oil
does to them.

In the frame that turns with the ball's centre, the ball has the angular velocity w_R (-cos beta
e_x + sin beta e_r) and the race (Omega - w_m) e_x. Both velocities are taken at the contact's
centre, and the two bodies' motion there resolved along the contact's axes x, y, n
(`BearingContact`), so that spin and rolling have the signs of `ehl.traction.ContactKinematics`,
body 1 the ball.
"""

from dataclasses import dataclass

from ehl.kinematics import ContactKinematics
from ehl.oil.rheology import Rheology
from ehl.solution import ContactSolution
from ehl.traction.shear import TractionResult, integrate_traction

from ..quasistatic.solution import QuasistaticSolution
from .contact import BearingContact
from .motion import BallMotion, bearing_kinematics


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactTraction:
    """Traction of one contact of a bearing, and the motion it belongs to; `result` has body 1 the
    ball.
    """

    contact: BearingContact
    kinematics: ContactKinematics
    result: TractionResult


def contact_traction(
    solution: QuasistaticSolution,
    contact: BearingContact,
    film: ContactSolution,
    rheology: Rheology,
    motion: BallMotion | None = None,
) -> ContactTraction:
    """Forces and moments of one contact, integrated over its film.

    Parameters
    ----------
    solution, contact
        As in `bearing_kinematics`.
    film : ContactSolution
        Of the contact's conditions [m], [Pa].
    rheology : Rheology
    motion : BallMotion, optional
        Of the ball; None: that of the equilibrium [rad/s].

    Returns
    -------
    ContactTraction
    """
    kinematics = bearing_kinematics(solution, contact, motion)
    result = integrate_traction(
        film, kinematics, rheology, temperature=solution.operation.temperature
    )
    return ContactTraction(contact=contact, kinematics=kinematics, result=result)
