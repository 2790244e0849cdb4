"""The law of traction: forces and moments of a contact as a function of its load and motion.

One protocol for all of them. Coefficients over the Hertz ellipse (`shear.EllipseLaw`) and tables
of solved films (`traction_table.TractionTable`) satisfy it, and so does any object with the method
`forces`. A coefficient by the local sliding is added in `friction_coefficients`, for the equations
of motion too.
"""

from typing import NamedTuple, Protocol


class TractionForces(NamedTuple):
    """Traction on body 1, the ball, at a contact's centre; SI."""

    force_x: float  # F_x, along the entrainment [N]
    force_y: float  # F_y, across [N]
    spin_moment: float  # M_n, about the normal [N m]
    rolling_moment: float  # M_y, about the transverse axis [N m]
    power_loss: float  # heat of both surfaces [W]
    film: float  # central film; zero, as stiffness and damping, where a law has none [m]
    stiffness: float  # of the contact along its normal [N/m]
    damping: float  # likewise [N s/m]
    outside: tuple[str, ...]  # names of the quantities outside the range of the law


class TractionLaw(Protocol):
    """Force over motion of one contact: all laws of traction have this method and no other."""

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Evaluate the traction on body 1 at a load and a motion.

        Parameters
        ----------
        load : float
            normal load Q [N]
        speed : float
            entrainment speed u along x [m/s]
        slide_x, slide_y : float
            velocity of body 1 less that of body 2 at the centre, along x and y [m/s]
        spin : float
            angular speed of body 1 relative to body 2 about the normal [rad/s]

        Returns
        -------
        TractionForces
            forces and moments; film, stiffness and damping where the law has them
        """
        ...
