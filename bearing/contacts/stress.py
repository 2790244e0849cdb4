"""What a loaded contact does to its bodies: stress below it and sliding in it.

The ellipse, pressure and stresses are those of the dry Hertz contact. Sliding is that of the ball
hypotheses: none in the middle, spin about the normal, and the difference of radii across the
curved contact (Heathcote).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import pi

import numpy as np

from ehl.closed_form.hertz import HertzContact
from ehl.closed_form.hertz_stress import hertz_maximum_shear, hertz_orthogonal_shear

from ..geometry import Array, Race
from ..quasistatic.solution import QuasistaticSolution
from .contact import BearingContact
from .motion import ball_speeds, motion_map
from .shape import groove_curvature_radius
from .shoulder import Truncation, truncation

# points at which pressure times sliding is evaluated, around and across half the ellipse
ANGLES = 180
RINGS = 40


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
    """Stress [Pa], sliding [m/s] and truncation of a contact of an equilibrium; None where it is
    unloaded.
    """
    return contact_stresses(solution, [contact])[0]


def contact_stresses(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> list[ContactStress | None]:
    """As `contact_stress`, of many contacts [Pa], [m/s]."""
    motion = motion_map(solution, contacts).motion(*ball_speeds(solution))
    return [
        _stress(solution, contact, float(spin), float(rolling))
        for contact, (spin, rolling) in zip(contacts, motion[:, 2:].tolist(), strict=True)
    ]


def _stress(
    solution: QuasistaticSolution, contact: BearingContact, spin: float, rolling: float
) -> ContactStress | None:
    """Of a contact with the relative angular speeds of its bodies [rad/s]."""
    hertz = contact.hertz
    if hertz is None:
        return None
    bearing = solution.bearing
    race = contact.race
    ring = bearing.inner_ring_material if race is Race.INNER else bearing.outer_ring_material
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    shear = hertz_maximum_shear(axes, hertz.pressure, ring.poisson_ratio)
    orthogonal = hertz_orthogonal_shear(*axes, hertz.pressure)
    sliding = largest_sliding(hertz, spin, rolling, groove_curvature_radius(bearing, race))
    return ContactStress(
        mean_pressure=2.0 / 3.0 * hertz.pressure,
        shear_maximum=shear[0],
        shear_depth=shear[1],
        orthogonal_shear=orthogonal[0],
        orthogonal_depth=orthogonal[1],
        sliding_speed=sliding[0],
        pressure_sliding=sliding[1],
        truncation=truncation(bearing, race, contact.contact_angle, hertz),
    )


def largest_sliding(
    hertz: HertzContact, spin: float, rolling: float, radius: float
) -> tuple[float, float]:
    """Largest sliding speed, and largest product of pressure and sliding speed, in an ellipse.

    v_x = -w_s y + w_r y^2/(2 R), v_y = w_s x [m/s], x along the rolling direction; no sliding in
    the middle, |v| is largest on the rim. `spin`, `rolling`: relative angular speeds w_s about the
    normal and w_r about the transverse direction [rad/s]; `radius`: R of the deformed surface
    across the rolling direction, 2 r D/(2 r + D) [m]. The product in [W/m^2].
    """
    along, across, pressure = _places()
    x, y = hertz.semi_axis_x * along, hertz.semi_axis_y * across
    speed = np.hypot(-spin * y + 0.5 * rolling * y * y / radius, spin * x)
    return float(speed.max()), hertz.pressure * float((pressure * speed).max())


@cache
def _places() -> tuple[Array, Array, Array]:
    """x and y over the semi-axes, shape (ANGLES // 2 + 1, RINGS + 1), and pressure over Hertz',
    (RINGS + 1,), of the half of an ellipse with x >= 0: speeds are even in x.
    """
    angle = np.linspace(-0.5 * pi, 0.5 * pi, ANGLES // 2 + 1)[:, None]
    share = np.linspace(0.0, 1.0, RINGS + 1)
    return share * np.cos(angle), share * np.sin(angle), np.sqrt(1.0 - share**2)
