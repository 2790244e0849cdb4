"""Sliding friction torque of a bearing from its internal loads: lines of pure rolling, Houpert,
Kakuta, Coulomb.

Every model is brought to the shaft by energy: a moment times the angular speed it works against,
over the speed of the inner ring relative to the outer. All moments act between ball and race: m_s
against the spin, m_r against the rolling.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, sin
from typing import NamedTuple

import numpy as np
from numpy.polynomial.polynomial import polyval
from scipy.special import ellipe

from ..contacts.contact import BearingContact
from ..contacts.motion import ball_speeds, motion_map
from ..contacts.shape import groove_curvature_radius
from ..geometry import Array, Race
from ..quasistatic.solution import QuasistaticSolution
from .pure_rolling_lines import rolling_lines

SYMMETRIC_CURVATURE = 0.161142  # S of two lines at c = 0.347296, no spin
# f_c and f_p of Houpert (1999) over the spin ratio E, as quoted in an open code; fitted for E in
# [0, 1]
HOUPERT_CURVATURE = (1.0026, -0.1653, -0.2638, -2.5521, 1.9749)
HOUPERT_SPIN = (0.0042, 1.1045, 0.4625, -0.5648)


@dataclass(frozen=True, slots=True, kw_only=True)
class SlidingContact:
    """A contact as models of sliding friction take it, SI."""

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
        if self.rolling == 0.0:
            return inf
        return 2.0 * self.radius * self.spin / (self.rolling * self.semi_axis)


class SlidingTorque(NamedTuple):
    """Torque on the shaft [N m] by what slides."""

    spin: float
    rotation: float  # curvature slip, against the ball's own rotation
    orbit: float  # curvature slip, against the races' motion past the orbiting balls

    @property
    def total(self) -> float:
        """Sum [N m]."""
        return self.spin + self.rotation + self.orbit


def sliding_contacts(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[SlidingContact, ...]:
    """The loaded contacts of a bearing as sliding friction takes them; SI."""
    loaded = [(contact, contact.hertz) for contact in contacts if contact.hertz is not None]
    kinematics = motion_map(solution, [contact for contact, _ in loaded])
    balls, races = kinematics.bodies(*ball_speeds(solution))
    spin = np.abs(balls[:, 2] - races[:, 2])
    ball_rolling = np.abs(balls[:, 3])
    rolling = np.abs(balls[:, 3] - races[:, 3])
    return tuple(
        SlidingContact(
            load=contact.load,
            semi_axis=hertz.semi_axis_y,
            semi_axis_rolling=hertz.semi_axis_x,
            radius=groove_curvature_radius(solution.bearing, contact.race),
            spin=float(spin[n]),
            ball_rolling=float(ball_rolling[n]),
            orbit_rolling=float(rolling[n] - ball_rolling[n]),
            angle=contact.contact_angle,
            inner=contact.race is Race.INNER,
        )
        for n, (contact, hertz) in enumerate(loaded)
    )


def _torque(
    contacts: Sequence[SlidingContact],
    speed: float,
    friction: Callable[[SlidingContact], tuple[float, float]],
) -> SlidingTorque:
    """Torque at a shaft's speed [rad/s] by the spin moment and the curvature moment of each
    contact [N m].
    """
    spin = rotation = orbit = 0.0
    for c in contacts:
        pivot, curvature = friction(c)
        spin += pivot * c.spin
        rotation += curvature * c.ball_rolling
        orbit += curvature * c.orbit_rolling
    return SlidingTorque(spin / speed, rotation / speed, orbit / speed)


def pure_rolling_line_torque(
    contacts: Sequence[SlidingContact], speed: float, friction: float
) -> SlidingTorque:
    """Torque by the lines of pure rolling, no net force along the rolling direction [N m].

    `speed`: of the shaft [rad/s]; `friction`: Coulomb's mu [-].
    """

    def moments(c: SlidingContact) -> tuple[float, float]:
        lines = rolling_lines(c.spin_ratio)
        curvature = friction * c.load * c.semi_axis**2 / (2.0 * c.radius) * lines.curvature
        return friction * c.load * c.semi_axis * lines.spin_moment, curvature

    return _torque(contacts, speed, moments)


def kakuta_torque(
    contacts: Sequence[SlidingContact], speed: float, friction: float
) -> SlidingTorque:
    """Kakuta's: spin on the inner race alone and as on a plane, 3/8 mu Q a E(k) sin(alpha); lines
    as without spin.

    Parameters as in `pure_rolling_line_torque`; torque in [N m].
    """

    def moments(c: SlidingContact) -> tuple[float, float]:
        slip = c.semi_axis**2 / (2.0 * c.radius)
        return 0.0, friction * c.load * slip * SYMMETRIC_CURVATURE

    spin = sum(spin_moment(c, friction) * sin(abs(c.angle)) for c in contacts if c.inner)
    return _torque(contacts, speed, moments)._replace(spin=spin)


def spin_moment(contact: SlidingContact, friction: float) -> float:
    """Moment of pure spin, 3/8 mu Q a E(k), k^2 = 1 - (b/a)^2, Harris and Kotzalas [N m]; mu
    [-].
    """
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

    def moments(c: SlidingContact) -> tuple[float, float]:
        ratio = min(c.spin_ratio, 1.0)
        shape = max(float(polyval(ratio, HOUPERT_CURVATURE)), 0.0)
        pivot = float(polyval(ratio, HOUPERT_SPIN)) if c.spin > 0.0 else 0.0
        curvature = 0.0806 * friction * c.load * c.semi_axis**2 / c.radius * shape
        return 0.375 * friction * c.load * c.semi_axis * pivot, curvature

    return _torque(contacts, speed, moments)


def spent_powers(powers: Array) -> Array:
    """Parts of the friction power of contacts (N, 3) [W], none negative, sums as they are.

    At one centre one motion may drive what another one resists, for example curvature slip a
    ball's sliding: what it drives is taken from the other parts by their share.
    """
    resisting = np.maximum(powers, 0.0)
    whole = resisting.sum(axis=1, keepdims=True)
    share = powers.sum(axis=1, keepdims=True) / np.where(whole > 0.0, whole, 1.0)
    return np.asarray(np.maximum(share, 0.0) * resisting, dtype=np.float64)
