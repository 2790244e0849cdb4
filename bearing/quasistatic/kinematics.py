r"""Rolling of a ball between two races, the body forces of its motion, the Hertz stiffness of its
contacts, and limits that NumPy and compiled functions share.

In the frame that turns with the ball's centre at the orbit speed w_m, the ball spins at w_R about
an axis inclined by the attitude beta in the axial plane, :math:`\omega = w_R(-\cos\beta\, e_x +
\sin\beta\, e_r)`. No sliding at the centres of both contacts gives (Harris and Kotzalas, Advanced
Concepts of Bearing Technology, re-derived), with g = D/d_m::

    w_R cos(beta - a_o) = (w_m - w_outer) (1 + g cos a_o)/g
    w_R cos(beta - a_i) = (w_inner - w_m) (1 - g cos a_i)/g

Multiplied out, nothing is divided by the cosines. The attitude is the hypothesis: tan(beta) = sin
a_o/(cos a_o + g) without spin at the outer race, sin a_i/(cos a_i - g) without spin at the inner
one, or the mean contact angle. Directions are kept as (sine, cosine) pairs and every function
takes complex arguments, so that a complex step differentiates them to round-off.

The reduced radius in the rolling direction, D/2 (1 -+ D cos(angle)/d_m), and with it K in Q = K
approach^1.5 depend on the cosine of the contact angle c alone, and analytically: the nearest
singularity lies at abs(c) = d_m/D > 1. A Chebyshev series of ln K over 0 <= c <= 1 with 24 terms
is exact to round-off (d_m/D = 2 loses a factor 5.8 a term), so the equilibrium needs no elliptic
integrals in its loop.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import acos, cos, log, pi, ulp
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import contact_stiffness

from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from ..operation import BallKinematics, Curvature

Numbers = NDArray[Any]  # float64 or, under a complex step, complex128

INNER_PART = {
    BallKinematics.OUTER_RACE_CONTROL: 0.0,
    BallKinematics.INNER_RACE_CONTROL: 2.0,
    BallKinematics.HALF_AND_HALF: 1.0,
}  # lambda_i of the friction force lambda_i Mg/D at the inner race; lambda_o is 2 less this [-]

TERMS = 24

# friction over load beyond which a hypothesis asks more than a contact gives: above SKF's
# coefficient of boundary lubrication, 0.12 running and 0.15 at the start (`torque.skf`) [-]
FRICTION_LIMIT = 0.2
# cosine of 80 degrees: beyond, the load fades to none at 90, where no groove reaches [-]
EDGE_COSINE = 0.17
ROUND_OFF = 8.0 * ulp(1.0)  # [-]


class Direction(NamedTuple):
    """Sine and cosine of an angle in the axial plane, from the radial direction towards +x [-]."""

    sin: Numbers
    cos: Numbers


class Motion(NamedTuple):
    """Orbit speed and spin speed [rad/s], and the attitude of the spin as a direction [-]."""

    orbit_speed: Numbers
    spin_speed: Numbers
    attitude: Direction


@dataclass(frozen=True, slots=True, kw_only=True)
class PrescribedBalls:
    """Motion of the balls and friction on them as a balance of traction gives them; each of shape
    (Z,).
    """

    # about the axis, about the ball's own in the axial plane, about the tangent of the orbit
    # [rad/s]
    orbit_speed: Array
    spin_speed: Array  # likewise [rad/s]
    pivot_speed: Array  # likewise [rad/s]
    attitude: Array  # of the spin axis in the axial plane [rad]
    # across the rolling direction, positive as those of a positive gyroscopic couple [N]
    inner_friction: Array
    outer_friction: Array  # likewise [N]
    inner_drive: Array  # of the ball on the inner ring along the tangent of the orbit [N]

    @property
    def motion(self) -> Motion:
        """Orbit and spin [rad/s]."""
        axis = Direction(np.sin(self.attitude), np.cos(self.attitude))
        return Motion(self.orbit_speed, self.spin_speed, axis)


def direction(sin: Numbers, cos: Numbers) -> Direction:
    """Normalise a pair of components to a direction.

    Parameters
    ----------
    sin, cos : Numbers
        components, of equal shape [any unit]

    Returns
    -------
    Direction
        direction [-]
    """
    length = np.sqrt(sin * sin + cos * cos)
    return Direction(sin / length, cos / length)


def attitude(
    outer: Direction, inner: Direction, gamma: float, kinematics: BallKinematics
) -> Direction:
    """Attitude of a ball's spin under a hypothesis, Jones (1960), Harris and Kotzalas.

    Parameters
    ----------
    outer, inner : Direction
        contact angles [-]
    gamma : float
        D/d_m [-]
    kinematics : BallKinematics
        hypothesis

    Returns
    -------
    Direction
        direction of the spin axis [-]
    """
    if kinematics is BallKinematics.OUTER_RACE_CONTROL:
        return direction(outer.sin, outer.cos + gamma)
    if kinematics is BallKinematics.INNER_RACE_CONTROL:
        return direction(inner.sin, inner.cos - gamma)
    return direction(outer.sin + inner.sin, outer.cos + inner.cos)


def blend(start: Direction, end: Direction, fraction: Numbers) -> Direction:
    """Direction between two others.

    Parameters
    ----------
    start, end : Direction
        directions at 0 and 1 [-]
    fraction : Numbers
        fraction of the way from `start` to `end` [-]

    Returns
    -------
    Direction
        direction [-]
    """
    sine = start.sin + fraction * (end.sin - start.sin)
    return direction(sine, start.cos + fraction * (end.cos - start.cos))


def rolling_motion(
    outer: Direction,
    inner: Direction,
    beta: Direction,
    gamma: float,
    inner_speed: float,
    outer_speed: float,
) -> Motion:
    """Orbit and spin of a ball that slides at neither contact centre.

    Parameters
    ----------
    outer, inner : Direction
        contact angles [-]
    beta : Direction
        attitude of the spin [-]
    gamma : float
        D/d_m [-]
    inner_speed, outer_speed : float
        speeds of the rings [rad/s]

    Returns
    -------
    Motion
        motion [rad/s]
    """
    radius_outer = 1.0 + gamma * outer.cos
    radius_inner = 1.0 - gamma * inner.cos
    arm_outer = outer.cos * beta.cos + outer.sin * beta.sin
    arm_inner = inner.cos * beta.cos + inner.sin * beta.sin
    total = radius_inner * arm_outer + radius_outer * arm_inner
    orbit = inner_speed * radius_inner * arm_outer + outer_speed * radius_outer * arm_inner
    spin = (inner_speed - outer_speed) / gamma * radius_inner * radius_outer / total
    return Motion(orbit / total, spin, beta)


def ball_mass(ball_diameter: float, density: float) -> float:
    """Mass of a ball, rho pi D^3/6.

    Parameters
    ----------
    ball_diameter : float
        D [m]
    density : float
        rho [kg/m^3]

    Returns
    -------
    float
        mass [kg]
    """
    return density * np.pi / 6.0 * ball_diameter**3


def centrifugal_force(mass: float, pitch_diameter: float, orbit_speed: Numbers) -> Numbers:
    """Centrifugal force of a ball, m d_m w_m^2/2.

    Parameters
    ----------
    mass : float
        m [kg]
    pitch_diameter : float
        d_m [m]
    orbit_speed : Numbers
        w_m [rad/s]

    Returns
    -------
    Numbers
        force [N]
    """
    return 0.5 * mass * pitch_diameter * orbit_speed * orbit_speed


def gyroscopic_moment(mass: float, ball_diameter: float, motion: Motion) -> Numbers:
    """Couple Mg that the races must exert on a ball about e_t, J w_m w_R sin(beta), J = m D^2/10.

    Parameters
    ----------
    mass : float
        m [kg]
    ball_diameter : float
        D [m]
    motion : Motion
        orbit and spin of the ball

    Returns
    -------
    Numbers
        Mg [N m]
    """
    inertia = 0.1 * mass * ball_diameter**2
    return inertia * motion.orbit_speed * motion.spin_speed * motion.attitude.sin


@lru_cache(maxsize=256)
def stiffness_series(bearing: Bearing, race: Race, curvature: Curvature) -> Array:
    """Chebyshev coefficients of ln K and of its slope over the cosine of the contact angle.

    In 2 c - 1 over c in [0, 1]; second column d(ln K)/dc. K in N/m^1.5; with FREE that at the free
    angle.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    race : Race
        raceway in contact
    curvature : Curvature
        contact angle at which the curvature is taken

    Returns
    -------
    Array
        coefficients, shape (TERMS, 2) [-]
    """
    modulus = contact_modulus(bearing, race)

    def log_stiffness(angle: float) -> float:
        return log(contact_stiffness(*reduced_radii(bearing, race, angle), modulus))

    series = np.zeros((TERMS, 2))
    if curvature is Curvature.FREE:
        series[0, 0] = log_stiffness(bearing.free_contact_angle)
        return series
    nodes = [cos(pi * (k + 0.5) / TERMS) for k in range(TERMS)]
    values = np.array([log_stiffness(acos(0.5 * (1.0 + x))) for x in nodes])
    series[:, 0] = chebyshev.chebfit(nodes, values, TERMS - 1)
    series[:-1, 1] = 2.0 * chebyshev.chebder(series[:, 0])
    return series


def stiffness_at(series: Array, cosine: Numbers) -> Numbers:
    """K at cosines of contact angles, real or under a complex step.

    Continued linearly beyond a right angle.

    Parameters
    ----------
    series : Array
        coefficients of `stiffness_series` [-]
    cosine : Numbers
        cosines of contact angles [-]

    Returns
    -------
    Numbers
        K, in the shape of the cosines [N/m^1.5]
    """
    c = np.clip(cosine.real, 0.0, 1.0)
    # the same for all directions of a complex step, along the first axis
    distinct = c[:1] if np.iscomplexobj(cosine) and c.ndim > 1 else c
    polynomials = np.cos(np.arange(TERMS) * np.arccos(2.0 * distinct - 1.0)[..., None])
    both = polynomials @ series
    return np.exp(both[..., 0]) * (1.0 + both[..., 1] * (cosine - c))
