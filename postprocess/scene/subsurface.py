"""Stress below the solved pressure of contacts, as volumes for VTK; computed on request only."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing.contacts.contact import BearingContact
from ehl import ContactSolution
from ehl.arrays import Array
from ehl.solid.subsurface import subsurface_stress

from ..contact.frame import principal_coordinates, resampled
from .geometry import Placement, contact_frame, place_patch

CELLS = 81  # each way
LEFT_OUT = 0.01  # pressure over the largest one below which the box may end [-]
MARGIN = 1.15  # of the box beyond the nodes with more pressure than that [-]
# in half the shorter side of the box; the largest shear lies at 0.48 (circle) to 0.78 (line) of
# the shorter semi-axis, Johnson, Contact Mechanics (1985), section 4.2
DEEPEST = 2.0
LEVELS = 26  # depths from the surface to there


@dataclass(frozen=True, slots=True, kw_only=True)
class StressVolume:
    """Stress in the race below one contact."""

    points: Array  # in the bearing's frame, shape (nx, ny, nz, 3) [m]
    depth: Array  # shape (nz,) [m]
    # xx, yy, zz, xy, yz, xz in the contact's frame, z into the race, shape (6, nx, ny, nz) [Pa]
    stress: Array
    von_mises: Array  # shape (nx, ny, nz) [Pa]
    maximum_shear: Array  # shape (nx, ny, nz) [Pa]


def stress_volume(
    contact: BearingContact, solution: ContactSolution, ball_radius: float, poisson_ratio: float
) -> StressVolume:
    """Stress in a race below the solved pressure, which acts without friction on a half-space.

    Parameters
    ----------
    contact : BearingContact
        Contact of a ball and a race.
    solution : ContactSolution
        Solved film of the contact.
    ball_radius : float
        Radius of the ball [m].
    poisson_ratio : float
        Poisson's ratio of the race [-].

    Returns
    -------
    StressVolume
        Stress in the race.

    Raises
    ------
    ValueError
        If the contact has no lengths.
    """
    long = solution.x
    wide = solution.y
    pressure = solution.pressure
    if long is None or wide is None or solution.semi_axis_x is None:
        raise ValueError("a contact given by Moes' groups has no lengths and no stress in pascals")
    a = solution.semi_axis_x
    b = solution.semi_axis_x * solution.semi_axis_ratio
    pressed = pressure > LEFT_OUT * pressure.max()
    x, y = _span(long, pressed.any(axis=1), a), _span(wide, pressed.any(axis=0), b)
    depth = np.linspace(0.0, DEEPEST, LEVELS) * 0.5 * min(float(np.ptp(x)), float(np.ptp(y)))
    even = resampled(long, wide, pressure, x, y, outside=0.0)
    field = subsurface_stress(even, x, y, depth, poisson_ratio)
    frame = contact_frame(contact, ball_radius)
    along, across = principal_coordinates(x, y, solution.frame_angle)
    levels = [
        place_patch(along, across, frame, Placement(), np.full(along.shape, z)) for z in depth
    ]
    return StressVolume(
        points=np.stack(levels, axis=2),
        depth=depth,
        stress=field.stress,
        von_mises=field.von_mises,
        maximum_shear=field.maximum_shear,
    )


def _span(axis: Array, pressed: NDArray[np.bool_], semi_axis: float) -> Array:
    """Even nodes over the Hertz ellipse and all nodes that carry pressure [m]."""
    ends = np.array([min(axis[pressed].min(), -semi_axis), max(axis[pressed].max(), semi_axis)])
    middle = ends.mean()
    half = 0.5 * np.ptp(ends)
    return np.asarray(middle + MARGIN * half * np.linspace(-1.0, 1.0, CELLS))
