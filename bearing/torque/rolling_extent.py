"""How far the boxes of the films decide the rolling part of the integrated torque.

The hydrodynamic rolling moment of a flooded contact grows with the logarithm of the distance up to
which its oil counts (`ehl.traction.rolling_moment`). The integrated torque takes the solved boxes,
whose sizes follow the films and not the bearing: here stands beside it what oil up to one stated
distance from every contact would give, at the same motion.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from ehl.solution import ContactSolution
from ehl.traction.rolling_moment import RollingMoment, moment_of_doubling, rolling_moment

from ..contacts.traction import ContactTraction
from ..quasistatic.solution import QuasistaticSolution


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingExtent:
    """Rolling torque of all films by where their oil is."""

    box: float  # of the solved boxes, as in the integrated torque [N m]
    beyond_box: float | None  # of Kapitza's pressure from the boxes to the stated distance [N m]
    beyond_extent: float | None  # the part of `box` that lies farther out than that [N m]
    doubling: float  # what oil up to twice the distance would add [N m]
    note: str = ""  # why there is only that of the boxes

    @property
    def within_extent(self) -> float | None:
        """Of all oil up to the stated distance [N m]."""
        if self.beyond_box is None or self.beyond_extent is None:
            return None
        return self.box - self.beyond_extent + self.beyond_box


def rolling_moments(films: Sequence[ContactSolution | None]) -> tuple[RollingMoment | None, ...]:
    """Rolling moment of every film [N m], equal films once; None where there is none."""
    known = {id(film): rolling_moment(film) for film in films if film is not None}
    return tuple(None if film is None else known[id(film)] for film in films)


def rolling_extent(
    solution: QuasistaticSolution,
    tractions: Sequence[ContactTraction | None],
    films: Sequence[ContactSolution | None],
) -> RollingExtent | None:
    """Rolling torque [N m] of the solved boxes, beyond them by Kapitza (1955), and within the
    stated distance; None if the rings do not turn against each other.

    It is the power of the moment at the motion of the tractions over the speed of the shaft.
    `tractions`, `films`: of all contacts, None where there is none.
    """
    speed = solution.operation.shaft_speed
    if speed == 0.0:
        return None
    box = beyond = counted = doubling = 0.0
    notes = []
    for traction, film, moment in zip(tractions, films, rolling_moments(films), strict=True):
        if traction is None or film is None or moment is None:
            continue
        k = traction.kinematics
        ratio = (k.rolling + 0.5 * k.curvature_difference * k.sliding_x) / speed
        box += ratio * moment.box
        doubling += ratio * moment_of_doubling(film)
        beyond += ratio * (moment.beyond_box or 0.0)
        counted += ratio * (moment.beyond_extent or 0.0)
        notes += [moment.note] if moment.note else []
    known = not notes
    return RollingExtent(
        box=box,
        beyond_box=beyond if known else None,
        beyond_extent=counted if known else None,
        doubling=doubling,
        note="" if known else notes[0],
    )
