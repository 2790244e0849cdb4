"""Sliding friction torque of a bearing from its internal loads: lines of pure rolling, Houpert,
Kakuta, Coulomb.

Every model is brought to the shaft by energy: a moment times the angular speed it works against,
over the speed of the inner ring relative to the outer. All moments act between ball and race: m_s
against the spin, m_r against the rolling.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import ellipe

from ..contacts.contacts import BearingContact
from ..contacts.motion import bearing_kinematics
from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from .pure_rolling_lines import rolling_lines

SYMMETRIC_CURVATURE = 0.161142  # S of two lines at c = 0.347296, no spin
# f_c and f_p of Houpert (1999) over the spin ratio E, as quoted in an open code; the fit holds from 0 to 1
HOUPERT_CURVATURE = (1.0026, -0.1653, -0.2638, -2.5521, 1.9749)
HOUPERT_SPIN = (0.0042, 1.1045, 0.4625, -0.5648)
# of the quadrature over the ellipse
RADII = 24
ANGLES = 64


@dataclass(frozen=True, slots=True, kw_only=True)
class SlidingContact:
    """What sliding friction asks of a contact, SI."""

    load: float  # Q [N]
    semi_axis: float  # a, transverse [m]
    semi_axis_rolling: float  # b [m]
    radius: float  # R of the loaded surface [m]
    spin: float  # |w_s| [rad/s]
    ball_rolling: float  # part of the rolling speed from the ball's own rotation [rad/s]
    orbit_rolling: float  # part of it from the race in the frame of the orbit [rad/s]
    angle: float  # contact angle [rad]
    inner: bool

    @property
    def rolling(self) -> float:
        """w_r, magnitude [rad/s]."""
        return abs(self.ball_rolling + self.orbit_rolling)

    @property
    def spin_ratio(self) -> float:
        """E = 2 R w_s/(w_r a) [-]."""
        return (
            2.0 * self.radius * self.spin / (self.rolling * self.semi_axis)
            if self.rolling > 0.0
            else float("inf")
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class SlidingTorque:
    """Torque on the shaft [N m] by what slides."""

    spin: float
    rotation: float  # curvature slip, against the ball's own rotation
    orbit: float  # curvature slip, against the races' motion past the orbiting balls

    @property
    def total(self) -> float:
        """Sum [N m]."""
        return self.spin + self.rotation + self.orbit


def shaft_speed(solution: QuasistaticSolution) -> float:
    """Speed of the inner ring relative to the outer, magnitude [rad/s]."""
    return abs(solution.operation.inner_speed - solution.operation.outer_speed)


def sliding_contacts(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[SlidingContact, ...]:
    """The loaded contacts of a bearing, as sliding friction sees them; SI."""
    return tuple(_sliding_contacts(solution, contacts))


def _sliding_contacts(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> Iterator[SlidingContact]:
    for contact in contacts:
        if contact.hertz is None:
            continue
        k = contact.ball - 1
        motion = bearing_kinematics(solution, contact)
        inner = contact.race is Race.INNER
        ball = abs(
            float(solution.spin_speed[k])
            * cos(float(solution.attitude[k]) - contact.contact_angle)
        )
        total = abs(motion.rolling)
        yield SlidingContact(
            load=contact.load,
            semi_axis=contact.hertz.semi_axis_y,
            semi_axis_rolling=contact.hertz.semi_axis_x,
            radius=motion.curvature_radius,
            spin=abs(motion.spin),
            ball_rolling=ball,
            orbit_rolling=total - ball,
            angle=contact.contact_angle,
            inner=inner,
        )


def pure_rolling_line_torque(
    contacts: Sequence[SlidingContact], speed: float, friction: float
) -> SlidingTorque:
    """Torque by the lines of pure rolling, no net force along the rolling direction.

    Parameters
    ----------
    contacts : sequence of SlidingContact
    speed : float
        Of the shaft [rad/s].
    friction : float
        Coulomb's mu [-].

    Returns
    -------
    SlidingTorque
        [N m].
    """
    spin = rotation = orbit = 0.0
    for c in contacts:
        lines = rolling_lines(c.spin_ratio)
        moment = friction * c.load * c.semi_axis**2 / (2.0 * c.radius) * lines.curvature
        spin += friction * c.load * c.semi_axis * lines.spin_moment * c.spin
        rotation += moment * c.ball_rolling
        orbit += moment * c.orbit_rolling
    return SlidingTorque(spin=spin / speed, rotation=rotation / speed, orbit=orbit / speed)


def kakuta_torque(
    contacts: Sequence[SlidingContact], speed: float, friction: float
) -> SlidingTorque:
    """Kakuta's: spin on the inner race alone and as on a plane, 3/8 mu Q a E(k) sin(alpha); lines
    as without spin.

    Parameters as in `pure_rolling_line_torque`; torque in [N m].
    """
    spin = rotation = orbit = 0.0
    for c in contacts:
        moment = friction * c.load * c.semi_axis**2 / (2.0 * c.radius) * SYMMETRIC_CURVATURE
        rotation += moment * c.ball_rolling
        orbit += moment * c.orbit_rolling
        if c.inner:
            spin += spin_moment(c, friction) * sin(abs(c.angle))
    return SlidingTorque(spin=spin, rotation=rotation / speed, orbit=orbit / speed)


def spin_moment(contact: SlidingContact, friction: float) -> float:
    """Moment of pure spin, 3/8 mu Q a E(k), k^2 = 1 - (b/a)^2, Harris and Kotzalas [N m]; mu [-]."""
    longer = max(contact.semi_axis, contact.semi_axis_rolling)
    ratio = min(contact.semi_axis, contact.semi_axis_rolling) / longer
    return float(0.375 * friction * contact.load * longer * ellipe(1.0 - ratio**2))


def houpert_torque(
    contacts: Sequence[SlidingContact], speed: float, friction: float
) -> SlidingTorque:
    """Houpert's (1999) fits of curvature and spin moment over the spin ratio, at Hertz's exact
    ellipse.

    M_C = 0.0806 mu Q a^2/R f_c(E), M_P = 3/8 mu Q a f_p(E). Parameters as in
    `pure_rolling_line_torque`; [N m].
    """
    spin = rotation = orbit = 0.0
    for c in contacts:
        ratio = min(c.spin_ratio, 1.0)
        shape = max(float(np.polynomial.polynomial.polyval(ratio, HOUPERT_CURVATURE)), 0.0)
        moment = 0.0806 * friction * c.load * c.semi_axis**2 / c.radius * shape
        pivot = (
            float(np.polynomial.polynomial.polyval(ratio, HOUPERT_SPIN)) if c.spin > 0.0 else 0.0
        )
        spin += 0.375 * friction * c.load * c.semi_axis * pivot * c.spin
        rotation += moment * c.ball_rolling
        orbit += moment * c.orbit_rolling
    return SlidingTorque(spin=spin / speed, rotation=rotation / speed, orbit=orbit / speed)


def coulomb_power(contact: SlidingContact, friction: float) -> float:
    """Friction power of a contact under Coulomb's law, integrated over the ellipse in both
    directions [W].

    The sliding of the centre along the rolling direction is that for which no net force is left.
    The friction force is the derivative of the power by it, so that it is the one of least power;
    mu [-].
    """
    area, x, y = _quadrature(contact)
    curved = contact.rolling * (y * y - 0.25 * contact.semi_axis**2) / (2.0 * contact.radius)
    across = (contact.spin * x) ** 2

    def power(slide: float) -> float:
        along = slide - contact.spin * y - curved
        return float(np.sum(area * np.sqrt(along * along + across)))

    bound = contact.spin * contact.semi_axis + contact.rolling * contact.semi_axis**2 / (
        2.0 * contact.radius
    )
    if bound == 0.0:
        return 0.0
    found = minimize_scalar(
        power, bounds=(-bound, bound), method="bounded", options={"xatol": 1e-9 * bound}
    )
    return friction * contact.load * float(found.fun)


def _quadrature(contact: SlidingContact) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Weights p dA/Q with Hertz's pressure, and places x, y of the nodes [m]."""
    nodes, weights = np.polynomial.legendre.leggauss(RADII)
    t = 0.25 * pi * (nodes + 1.0)  # r = sin t takes the root out of the pressure
    angle = (np.arange(ANGLES) + 0.5) * 2.0 * pi / ANGLES
    r = np.sin(t)[:, None]
    f = angle[None, :]
    weight = 0.25 * pi * weights * 1.5 * np.cos(t) ** 2 * np.sin(t) / pi
    area = np.broadcast_to(weight[:, None] * 2.0 * pi / ANGLES, (RADII, ANGLES))
    return area, contact.semi_axis_rolling * r * np.cos(f), contact.semi_axis * r * np.sin(f)


def coulomb_torque(contacts: Sequence[SlidingContact], speed: float, friction: float) -> float:
    """Torque under Coulomb's law, both directions of sliding [N m]; speed [rad/s], mu [-]."""
    return sum(coulomb_power(c, friction) for c in contacts) / speed
