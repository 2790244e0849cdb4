"""Rows of balls on one inner ring: their positions and the offsets of their grooves.

All rows have the same bearing. The undisplaced inner ring is the reference: there the middle of a
row's inner groove lies at `axial_position`, that of its outer groove `offset` behind. A row
touches at an offset of the free axial position A sin(free angle) and is preloaded beyond it; a
positive offset loads it as a push of the inner ring to +x does. Back to back, left row +, right
row -; face to face the other way round; tandem, both alike.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from ehl.arrays import Array

from .geometry import Bearing


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One row of balls."""

    # middle of the inner groove from the point about which moments and tilts count [m]
    axial_position: float = 0.0
    # middle of the inner groove from that of the outer one along +x, ring undisplaced [m]
    offset: float = 0.0
    # azimuth of its first ball [rad]; None takes the bearing's
    first_ball_azimuth: float | None = None

    def __post_init__(self) -> None:
        for field in ("axial_position", "offset"):
            if not isfinite(getattr(self, field)):
                raise ValueError(f"{field} must be finite, got {getattr(self, field)!r} m")

    def bearing(self, bearing: Bearing) -> Bearing:
        """The bearing with this row's first azimuth.

        Parameters
        ----------
        bearing : Bearing
            bearing of all rows

        Returns
        -------
        Bearing
            the same bearing, or one with the azimuth of this row's first ball
        """
        first = self.first_ball_azimuth
        return bearing if first is None else replace(bearing, first_ball_azimuth=first)

    @property
    def outer_plane(self) -> float:
        """Axial position of the middle of the outer groove [m]."""
        return self.axial_position - self.offset


SINGLE = (Row(),)


def row_azimuths(bearing: Bearing, rows: Sequence[Row]) -> Array:
    """Azimuths of the balls of all rows, row by row.

    Parameters
    ----------
    bearing : Bearing
        bearing of all rows
    rows : Sequence[Row]
        rows on the inner ring

    Returns
    -------
    Array
        azimuths, shape (N,) [rad]
    """
    return np.concatenate([row.bearing(bearing).azimuths for row in rows])


def row_directions(bearing: Bearing, rows: Sequence[Row]) -> Array:
    """Cosines and sines of the azimuths of all rows.

    Parameters
    ----------
    bearing : Bearing
        bearing of all rows
    rows : Sequence[Row]
        rows on the inner ring

    Returns
    -------
    Array
        cosines and sines, shape (2, N) [-]
    """
    return np.concatenate([row.bearing(bearing).azimuth_directions for row in rows], axis=1)


def per_ball(bearing: Bearing, values: Sequence[float]) -> Array:
    """One value a row as one value a ball.

    Parameters
    ----------
    bearing : Bearing
        bearing of all rows, which gives the number of balls a row
    values : Sequence[float]
        one value a row, shape (rows,) [any unit]

    Returns
    -------
    Array
        the values, each repeated for the balls of its row, shape (N,) [any unit]
    """
    return np.repeat(np.asarray(values, dtype=np.float64), bearing.balls)
