"""What a loaded contact does to its bodies: stress below it and sliding in it.

The ellipse, pressure and stresses are those of the dry Hertz contact. Sliding is that of the ball
hypotheses: none in the middle, spin about the normal, and the difference of radii across the
curved contact (Heathcote).
"""

from dataclasses import dataclass
from math import pi

import numpy as np

from ehl.closed_form.hertz import HertzContact
from ehl.closed_form.hertz_stress import hertz_maximum_shear, hertz_orthogonal_shear

from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from .contact import BearingContact
from .motion import bearing_kinematics
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
    """Stress, sliding and truncation of a contact of an equilibrium; None where it is unloaded."""
    hertz = contact.hertz
    if hertz is None:
        return None
    bearing = solution.bearing
    race = contact.race
    ring = bearing.inner_ring_material if race is Race.INNER else bearing.outer_ring_material
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    shear = hertz_maximum_shear(axes, hertz.pressure, ring.poisson_ratio)
    orthogonal = hertz_orthogonal_shear(*axes, hertz.pressure)
    motion = bearing_kinematics(solution, contact)
    sliding = largest_sliding(hertz, motion.spin, motion.rolling, motion.curvature_radius)
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
    angle = np.linspace(0.0, 2.0 * pi, ANGLES, endpoint=False)[:, None]
    share = np.linspace(0.0, 1.0, RINGS + 1)[None, :]
    x, y = hertz.semi_axis_x * share * np.cos(angle), hertz.semi_axis_y * share * np.sin(angle)
    speed = np.hypot(-spin * y + 0.5 * rolling * y * y / radius, spin * x)
    pressure = hertz.pressure * np.sqrt(1.0 - share**2)
    return float(speed.max()), float((pressure * speed).max())
