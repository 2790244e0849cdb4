"""One contact of a ball with a race, placed in the bearing's frame.

n points from the ball into the race, x along the entrainment and y across, x cross y = n. The
outer contact lies at (sin ao, cos ao e_r) from the ball's centre, the inner one opposite to (sin
ai, cos ai e_r).
"""

from dataclasses import dataclass

from ehl.arrays import Array
from ehl.closed_form.hertz import HertzContact
from ehl.conditions import ContactConditions

from ..geometry import Race

RACES = (Race.INNER, Race.OUTER)  # order of the contacts of a ball


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingContact:
    """Contact of one ball with one race."""

    ball: int  # number of the ball, from 1, counted through all rows
    azimuth: float  # [rad]
    race: Race
    # what the film solver needs; None where the contact is unloaded or nothing entrains oil
    conditions: ContactConditions | None
    hertz: HertzContact | None  # the dry contact; None where unloaded
    load: float  # [N]
    contact_angle: float  # [rad]
    spin_roll_ratio: float | None  # magnitude of relative spin over relative rolling [-]
    # Qi sin(ai)/Fc [-], at inner races; None at outer ones and without centrifugal force
    hirano_ratio: float | None
    origin: Array  # (3,) contact point in the bearing's frame [m]
    axis_x: Array  # (3,) direction of the entrainment [-]
    axis_y: Array  # (3,) transverse direction [-]
    normal: Array  # (3,) into the race [-]
    note: str = ""  # why there are no conditions; empty where there are
    row: int = 1  # number of the ball's row, from 1

    @property
    def loaded(self) -> bool:
        """Whether the film of this contact can be solved."""
        return self.conditions is not None
