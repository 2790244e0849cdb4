"""Stress below a loaded contact, and sliding in it.

The ellipse, pressure and stresses are those of the dry Hertz contact. Sliding is that of the ball
hypotheses: none in the middle, spin about the normal, and the difference of radii across the
curved contact (Heathcote).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from math import pi

import numpy as np

from ehl.arrays import Array
from ehl.closed_form.hertz import HertzContact
from ehl.closed_form.hertz_stress import hertz_maximum_shear, hertz_orthogonal_shear

from ..geometry import Race, ring_material
from ..quasistatic.solution import QuasistaticSolution
from ._kernels import largest_sliding_speeds
from .contact import BearingContact
from .motion import ball_speeds, motion_map
from .shape import groove_curvature_radius
from .shoulder import Truncation, truncation

# points at which pressure times sliding is evaluated, around and across half the ellipse
ANGLES = 180
RINGS = 40
COLUMNS = (  # of `ContactStress`, as they are computed
    *("mean_pressure", "shear_maximum", "shear_depth", "orthogonal_shear", "orthogonal_depth"),
    *("sliding_speed", "pressure_sliding"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactStress:
    """Stress and sliding of one loaded contact."""

    mean_pressure: float  # 2/3 p_h [Pa]
    shear_maximum: float  # largest principal shear below the contact [Pa]
    shear_depth: float  # its depth [m]
    orthogonal_shear: float  # amplitude along the rolling direction [Pa]
    orthogonal_depth: float  # its depth [m]
    sliding_speed: float  # largest sliding speed in the ellipse [m/s]
    pressure_sliding: float  # largest product of pressure and sliding speed [W/m^2]
    truncation: Truncation | None  # None where no shoulder diameter is known


def contact_stress(solution: QuasistaticSolution, contact: BearingContact) -> ContactStress | None:
    """Stress, sliding and truncation of a contact of an equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contact : BearingContact
        one of its contacts

    Returns
    -------
    ContactStress | None
        stress [Pa] and sliding [m/s]; None if the contact is unloaded
    """
    return contact_stresses(solution, [contact])[0]


def contact_stresses(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> list[ContactStress | None]:
    """Stress, sliding and truncation of many contacts, as `contact_stress`.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        its contacts

    Returns
    -------
    list[ContactStress | None]
        stress [Pa] and sliding [m/s] of each; None for unloaded contacts
    """
    loaded = [(n, c, c.hertz) for n, c in enumerate(contacts) if c.hertz is not None]
    results: list[ContactStress | None] = [None] * len(contacts)
    if loaded:
        loaded_contacts = [contact for _, contact, _ in loaded]
        stresses = _stresses(solution, loaded_contacts, [hertz for _, _, hertz in loaded])
        for (n, _, _), stress in zip(loaded, stresses, strict=True):
            results[n] = stress
    return results


def _stresses(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    hertz: Sequence[HertzContact],
) -> Iterator[ContactStress]:
    """Stress and sliding of loaded contacts."""
    bearing = solution.bearing
    motion = motion_map(solution, contacts).motion(*ball_speeds(solution))
    ellipses = np.array([(h.semi_axis_x, h.semi_axis_y, h.pressure) for h in hertz]).T
    poisson = {race: ring_material(bearing, race).poisson_ratio for race in Race}
    radius = {race: groove_curvature_radius(bearing, race) for race in Race}
    pressure = ellipses[2]
    shear = hertz_maximum_shear(
        (ellipses[0], ellipses[1]), pressure, np.array([poisson[c.race] for c in contacts])
    )
    orthogonal = hertz_orthogonal_shear(*ellipses)
    curvature = np.array([radius[c.race] for c in contacts])
    sliding = largest_sliding(ellipses, motion[:, 2], motion[:, 3], curvature)
    columns = np.stack([2.0 / 3.0 * pressure, *shear, *orthogonal, *sliding], axis=1)
    for contact, ellipse, row in zip(contacts, hertz, columns.tolist(), strict=True):
        cut = truncation(bearing, contact.race, contact.contact_angle, ellipse)
        yield ContactStress(**dict(zip(COLUMNS, row, strict=True)), truncation=cut)


def largest_sliding(
    ellipses: Array, spin: Array, rolling: Array, radius: Array
) -> tuple[Array, Array]:
    """Largest sliding speed, and largest product of pressure and sliding speed, in ellipses.

    v_x = -w_s y + w_r y^2/(2 R), v_y = w_s x, x along the rolling direction; no sliding in the
    middle, |v| is largest on the rim.

    Parameters
    ----------
    ellipses : Array
        semi-axes along x and y [m] and Hertz' pressure [Pa], shape (3, n)
    spin : Array
        relative angular speed w_s about the normal, shape (n,) [rad/s]
    rolling : Array
        relative angular speed w_r about the transverse direction, shape (n,) [rad/s]
    radius : Array
        R of the deformed surface across the rolling direction, 2 r D/(2 r + D), shape (n,) [m]

    Returns
    -------
    speed
        largest sliding speed, shape (n,) [m/s]
    product
        largest pressure times sliding speed, shape (n,) [W/m^2]
    """
    shapes = np.stack([ellipses[0], ellipses[1], spin, 0.5 * rolling / radius], axis=1)
    largest = np.empty((len(shapes), 2))
    largest_sliding_speeds(shapes, *_ellipse_points(), largest)
    return largest[:, 0], ellipses[2] * largest[:, 1]


@cache
def _ellipse_points() -> tuple[Array, Array, Array]:
    """Points of the half of an ellipse with x >= 0: speeds are even in x.

    x and y over the semi-axes, shape (ANGLES // 2 + 1, RINGS + 1), and pressure over Hertz',
    shape (RINGS + 1,).
    """
    angle = np.linspace(-0.5 * pi, 0.5 * pi, ANGLES // 2 + 1)[:, None]
    radius = np.linspace(0.0, 1.0, RINGS + 1)
    return radius * np.cos(angle), radius * np.sin(angle), np.sqrt(1.0 - radius**2)
