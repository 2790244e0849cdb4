"""One contact of a ball with a race, placed in the bearing's frame.

n points from the ball into the race, x along the entrainment and y across, x cross y = n. The
outer contact lies at (sin ao, cos ao e_r) from the ball's centre, the inner one opposite to (sin
ai, cos ai e_r).
"""

from dataclasses import dataclass

from ehl.closed_form.hertz import HertzContact
from ehl.conditions import ContactConditions

from ..geometry import Array, Race

RACES = (Race.INNER, Race.OUTER)  # order of the contacts of a ball


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingContact:
    """Contact of one ball with one race.

    Attributes
    ----------
    ball : int
        Number of the ball, from 1, counted through all rows.
    azimuth : float
        [rad].
    race : Race
    conditions : ContactConditions or None
        What the film solver needs; None where the contact is unloaded or nothing entrains oil.
    hertz : HertzContact or None
        The dry contact; None where unloaded.
    load : float
        [N].
    contact_angle : float
        [rad].
    spin_roll_ratio : float or None
        Magnitude of relative spin over relative rolling [-].
    hirano_ratio : float or None
        Qi sin(ai)/Fc [-], at inner races; None at outer ones and without centrifugal force.
    origin : ndarray, shape (3,)
        Contact point in the bearing's frame [m].
    axis_x, axis_y, normal : ndarray, shape (3,)
        Entrainment, transverse direction and normal into the race [-].
    note : str
        Why there are no conditions; empty where there are.
    row : int
        Number of the ball's row, from 1.
    """

    ball: int
    azimuth: float
    race: Race
    conditions: ContactConditions | None
    hertz: HertzContact | None
    load: float
    contact_angle: float
    spin_roll_ratio: float | None
    hirano_ratio: float | None
    origin: Array
    axis_x: Array
    axis_y: Array
    normal: Array
    note: str = ""
    row: int = 1

    @property
    def loaded(self) -> bool:
        """Whether the film of this contact can be solved."""
        return self.conditions is not None
