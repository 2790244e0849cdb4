"""Traction at the contacts of a bearing: shear of their films at the motion of ball and race."""

from dataclasses import dataclass

from ehl.conditions import ContactKinematics
from ehl.oil.rheology import Rheology
from ehl.solution import ContactSolution
from ehl.traction.rolling_moment import rolling_moment
from ehl.traction.shear import TractionResult, integrate_traction

from ..quasistatic.solution import QuasistaticSolution
from .contact import BearingContact
from .motion import BallMotion, bearing_kinematics

# along x of the films whose shear is summed, at most, in the balance of the balls and in the
# torque: with the nodes of one and of the other the rings' power misses the heat by what the mesh
# changes of a friction that nearly vanishes, half of the heat of a 6306 with little oil. A 6306 at
# 10 kN, films on 1025 nodes, takes 201.039 N mm so and 201.037 by all nodes, in a quarter of the
# time
TRACTION_POINTS = 513


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
    resistance: float | None = None,
) -> ContactTraction:
    """Forces and moments of one contact, integrated over its film on at most `TRACTION_POINTS`.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contact : BearingContact
        one of its contacts
    film : ContactSolution
        film of the contact's conditions [m], [Pa]
    rheology : Rheology
        shear law of the oil
    motion : BallMotion | None, optional
        motion of the ball [rad/s]; None: that of the equilibrium
    resistance : float | None, optional
        moment that resists rolling [N m]; None: that of the film's oil up to the meniscus

    Returns
    -------
    ContactTraction
        traction of the contact, body 1 the ball
    """
    kinematics = bearing_kinematics(solution, contact, motion)
    result = integrate_traction(
        film.thinned(TRACTION_POINTS),
        kinematics,
        rheology,
        temperature=solution.operation.temperature,
        rolling_resistance=rolling_moment(film).value if resistance is None else resistance,
    )
    return ContactTraction(contact=contact, kinematics=kinematics, result=result)
