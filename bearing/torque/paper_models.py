"""Torque models of single papers, computed on request: lines of pure rolling, Houpert, Kakuta and
Yao.

Every model is brought to the shaft by energy: a moment times the angular speed it works against,
over the speed of the inner ring relative to the outer. All moments act between ball and race: m_s
against the spin, m_r against the rolling.

Lines of pure rolling: along the transverse axis y of the contact, in units of its semi-axis a,
ball and race slide past each other at

    v(y) = w_s y a - w_r (y^2 - const) a^2/(2 R),    R = 2 r D/(2 r + D),

with the spin w_s, the rolling speed w_r and the radius R of the loaded surface; the two roots are
the lines y = c_1 and y = -c_2 of pure rolling, c_1 = c_2 + E, E = 2 R w_s/(w_r a). The pressure is
Hertz's, the friction mu p against the sliding, the lines lie so that no net force along the
rolling direction is left (Jones, 1959; Harris and Kotzalas; the updated c-values of the sliding
friction paper of deep groove ball bearings, re-derived).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import asin, cos, inf, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.polynomial.polynomial import polyval
from scipy.special import ellipe

from oilfilm.ehl import Lubricant

from ..contacts.contact import BearingContact
from ..contacts.motion import ball_speeds, motion_map
from ..contacts.shape import groove_curvature_radius
from ..friction.balance import BalancedFriction
from ..friction.coulomb import balanced_friction
from ..friction.resistance import contact_rolling_power, hysteresis_torque
from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from .inputs import FrictionInput
from .models import ModelTorque, cage_and_drag, summed

# coefficient of Jones (1959), as quoted in the comparison of sliding friction torques [-]
CONSTANT_COULOMB = 0.07
SYMMETRIC_CURVATURE = 0.161142  # S of two lines at c = 0.347296, no spin
# f_c and f_p of Houpert (1999) over the spin ratio E, as quoted in an open code; fitted for E in
# [0, 1]
HOUPERT_CURVATURE = (1.0026, -0.1653, -0.2638, -2.5521, 1.9749)
HOUPERT_SPIN = (0.0042, 1.1045, 0.4625, -0.5648)


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingLines:
    """Positions of the lines and the force and moments that they leave, all [-]."""

    first: float  # c_1, of the line on the side of the spin; beyond 1 outside the contact
    second: float  # c_2, of the other
    force: float  # F/(mu Q), along the rolling direction
    spin_moment: float  # m_s/(mu Q a)
    curvature: float  # S, m_r = mu Q a^2/(2 R) S


def rolling_lines(spin_ratio: float, force: float = 0.0) -> RollingLines:
    """Lines of pure rolling of a contact.

    Parameters
    ----------
    spin_ratio : float
        E = 2 R w_s/(w_r a), not negative; infinite without rolling [-]
    force : float, default 0.0
        F/(mu Q) that the friction has to carry, from -1 to 1 [-]

    Returns
    -------
    RollingLines
        place of the lines and what they leave [-]

    Raises
    ------
    ValueError
        if the friction cannot carry the force
    """
    if not -1.0 < force < 1.0:
        raise ValueError(f"force must lie between -1 and 1 times the friction, got {force!r}")

    second = _second_line(spin_ratio, force)
    first = second + spin_ratio
    return RollingLines(
        first=first,
        second=second,
        force=line_force(first, second),
        spin_moment=line_spin_moment(first, second),
        curvature=line_curvature(first, second),
    )


def _second_line(spin_ratio: float, force: float) -> float:
    """c_2 at which `line_force` is the force [-].

    With both lines in the contact m = (c_1 + c_2)/2 is a root of m^3 - 3 (1 - E^2/4) m + 1 - F;
    with the first one beyond it c_2 is one of c^3 - 3 c - 2 F.
    """
    half = 0.5 * spin_ratio
    room = 1.0 - half * half
    if room > 0.0:
        share = (1.0 - force) / (2.0 * room**1.5)
        if share <= 1.0:
            middle = 2.0 * sqrt(room) * sin(asin(share) / 3.0)
            if middle + half <= 1.0:
                return middle - half
    return -2.0 * sin(asin(force) / 3.0)


def _inside(first: float, second: float) -> tuple[float, float]:
    return min(max(first, -1.0), 1.0), min(max(second, -1.0), 1.0)


def line_force(first: float, second: float) -> float:
    """F/(mu Q) = 1 - 3/2 (c_1 + c_2) + 1/2 (c_1^3 + c_2^3); lines beyond the contact count at its
    end.

    Parameters
    ----------
    first : float
        c_1 [-]
    second : float
        c_2 [-]

    Returns
    -------
    float
        force [-]
    """
    c, d = _inside(first, second)
    return 1.0 - 1.5 * (c + d) + 0.5 * (c**3 + d**3)


def line_spin_moment(first: float, second: float) -> float:
    """m_s/(mu Q a) = 3/8 [2 (c_1^2 - c_2^2) - (c_1^4 - c_2^4)].

    Parameters
    ----------
    first : float
        c_1 [-]
    second : float
        c_2 [-]

    Returns
    -------
    float
        moment [-]
    """
    c, d = _inside(first, second)
    return 0.375 * (2.0 * (c**2 - d**2) - (c**4 - d**4))


def line_curvature(first: float, second: float) -> float:
    """S = 1/5 - 3/2 [(c_1^3 + c_2^3)/3 - (c_1^5 + c_2^5)/5].

    Parameters
    ----------
    first : float
        c_1 [-]
    second : float
        c_2 [-]

    Returns
    -------
    float
        S [-]
    """
    c, d = _inside(first, second)
    return 0.2 - 1.5 * ((c**3 + d**3) / 3.0 - (c**5 + d**5) / 5.0)


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
    """The loaded contacts of a bearing as models of sliding friction take them.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        its contacts

    Returns
    -------
    tuple[SlidingContact, ...]
        loaded ones in their order, SI
    """
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
    """Torque by the lines of pure rolling, no net force along the rolling direction.

    Parameters
    ----------
    contacts : Sequence[SlidingContact]
        loaded contacts
    speed : float
        of the shaft [rad/s]
    friction : float
        Coulomb's mu [-]

    Returns
    -------
    SlidingTorque
        torque [N m]
    """

    def moments(c: SlidingContact) -> tuple[float, float]:
        lines = rolling_lines(c.spin_ratio)
        curvature = friction * c.load * c.semi_axis**2 / (2.0 * c.radius) * lines.curvature
        return friction * c.load * c.semi_axis * lines.spin_moment, curvature

    return _torque(contacts, speed, moments)


def kakuta_torque(
    contacts: Sequence[SlidingContact], speed: float, friction: float
) -> SlidingTorque:
    """Kakuta's torque: spin on the inner race alone and as on a plane, 3/8 mu Q a E(k) sin(alpha);
    lines as without spin.

    Parameters
    ----------
    contacts : Sequence[SlidingContact]
        loaded contacts
    speed : float
        of the shaft [rad/s]
    friction : float
        Coulomb's mu [-]

    Returns
    -------
    SlidingTorque
        torque [N m]
    """

    def moments(c: SlidingContact) -> tuple[float, float]:
        slip = c.semi_axis**2 / (2.0 * c.radius)
        return 0.0, friction * c.load * slip * SYMMETRIC_CURVATURE

    spin = sum(spin_moment(c, friction) * sin(abs(c.angle)) for c in contacts if c.inner)
    return _torque(contacts, speed, moments)._replace(spin=spin)


def spin_moment(contact: SlidingContact, friction: float) -> float:
    """Moment of pure spin, 3/8 mu Q a E(k), k^2 = 1 - (b/a)^2, Harris and Kotzalas.

    Parameters
    ----------
    contact : SlidingContact
        loaded contact
    friction : float
        Coulomb's mu [-]

    Returns
    -------
    float
        moment [N m]
    """
    longer = max(contact.semi_axis, contact.semi_axis_rolling)
    ratio = min(contact.semi_axis, contact.semi_axis_rolling) / longer
    return float(0.375 * friction * contact.load * longer * ellipe(1.0 - ratio**2))


def houpert_torque(
    contacts: Sequence[SlidingContact], speed: float, friction: float
) -> SlidingTorque:
    """Houpert's (1999) fits of curvature and spin moment over the spin ratio, at Hertz's exact
    ellipse: M_C = 0.0806 mu Q a^2/R f_c(E), M_P = 3/8 mu Q a f_p(E).

    Parameters
    ----------
    contacts : Sequence[SlidingContact]
        loaded contacts
    speed : float
        of the shaft [rad/s]
    friction : float
        Coulomb's mu [-]

    Returns
    -------
    SlidingTorque
        torque [N m]
    """

    def moments(c: SlidingContact) -> tuple[float, float]:
        ratio = min(c.spin_ratio, 1.0)
        shape = max(float(polyval(ratio, HOUPERT_CURVATURE)), 0.0)
        pivot = float(polyval(ratio, HOUPERT_SPIN)) if c.spin > 0.0 else 0.0
        curvature = 0.0806 * friction * c.load * c.semi_axis**2 / c.radius * shape
        return 0.375 * friction * c.load * c.semi_axis * pivot, curvature

    return _torque(contacts, speed, moments)


def line_models(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    mu: float,
    lines: BalancedFriction | None = None,
) -> dict[str, ModelTorque]:
    """Sliding friction by the lines of pure rolling, and the models that they are compared with.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing; the rings turn against each other.
    contacts : sequence of BearingContact
        Its contacts.
    mu : float
        Coulomb's coefficient [-].
    lines : BalancedFriction, optional
        Lines of pure rolling in balance; None: sought here.

    Returns
    -------
    dict of ModelTorque
        By the names of the models [N m].
    """
    speed = solution.operation.shaft_speed
    loaded = sliding_contacts(solution, contacts)
    if lines is None:
        lines = balanced_friction(solution, contacts, mu, lines=True)
    houpert = houpert_torque(loaded, speed, mu)
    return {
        "pure_rolling_lines": summed(pure_rolling_line_torque(loaded, speed, mu)._asdict()),
        "balanced_lines": _balanced(lines, speed),
        "houpert": summed(
            {
                "spin": houpert.spin,
                "curvature": houpert.rotation + houpert.orbit,
                "hydrodynamic": sum(map(contact_rolling_power, contacts)) / speed,
            }
        ),
        "kakuta": summed(kakuta_torque(loaded, speed, mu)._asdict()),
        "constant_coulomb": summed(
            pure_rolling_line_torque(loaded, speed, CONSTANT_COULOMB)._asdict()
        ),
    }


def _balanced(balance: BalancedFriction, speed: float) -> ModelTorque:
    """Lines in balance of force and moments on every ball."""
    if not balance.converged:
        residual = f"residual {balance.residual:.1e} of mu Q"
        return ModelTorque(note=f"no balance of the friction on the balls ({residual})")
    k = balance.kinematics
    f = balance.forces
    rotation = float(-(f[..., 3] * balance.ball_rolling).sum() / speed)
    spin = float(-(f[..., 2] * k[..., 2]).sum() / speed)
    orbit = float(balance.power.sum()) / speed - spin - rotation
    return summed({"spin": spin, "rotation": rotation, "orbit": orbit})


def yao_model(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    mu: float,
) -> ModelTorque:
    """The five terms of Yao et al. (2022), M_C and M_L by models of our own: those printed are no
    torques.

    M_D = d_m/(2 D) [(1 - g_i^2) sum M_Di + (1 - g_e^2) sum M_De] f_s with M_D = 0.0806 Q a^2/R and
    M_S = 3/8 f_s sum E(k) a Q sin(alpha), E(k) the complete elliptic integral; M_E is
    `hysteresis_torque`.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    lubricant : Lubricant
        The oil.
    friction : FrictionInput
        Hysteresis, cage, and oil in the cavity.
    mu : float
        Coefficient of the sliding friction, f_s [-].

    Returns
    -------
    ModelTorque
        The five terms [N m], or what is missing.
    """
    needed = {"friction.oil_fraction": friction.oil_fraction}
    missing = [key for key, value in needed.items() if value is None]
    if missing:
        return ModelTorque(note=f"needs {', '.join(missing)}")
    bearing = solution.bearing
    speed = solution.operation.shaft_speed
    ratio = bearing.pitch_diameter / (2.0 * bearing.ball_diameter)
    rotation = spin = 0.0
    for c in sliding_contacts(solution, contacts):
        slope = bearing.ball_diameter * cos(c.angle) / bearing.pitch_diameter
        curvature = 0.0806 * c.load * c.semi_axis**2 / c.radius
        rotation += ratio * (1.0 - slope**2) * curvature * mu
        spin += spin_moment(c, mu) * sin(abs(c.angle))
    resistance = cage_and_drag(solution, lubricant, friction)
    return summed(
        {
            "ME": hysteresis_torque(solution, contacts, friction.hysteresis_loss),
            "MD": rotation,
            "MS": spin,
            "MC": resistance["cage"],
            "ML": sum(map(contact_rolling_power, contacts)) / speed + resistance["drag"],
        }
    )
