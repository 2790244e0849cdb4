"""Resistance of a bearing beside sliding: hysteresis of the contacts, the oil's rolling
resistance, cage and churning.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, pi

import numpy as np

from oilfilm.ehl.arrays import Array

from ..contacts.contact import BearingContact
from ..films.heavy_moment import heavy_moment
from ..geometry import Bearing
from ..quasistatic.solution import QuasistaticSolution

# C_D of a smooth sphere, 1e3 < Re < 2e5 (Hoerner, 1965); not verified for balls behind each other
SPHERE_DRAG = 0.47
STANDARD_GRAVITY = 9.80665  # CGPM, 1901 [m/s^2]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cage:
    """Guidance of the cage and friction in its pockets."""

    pocket_friction: float  # Coulomb's mu of ball against pocket [-]
    land_diameter: float | None = None  # of the guiding land [m]; None: guided by the balls
    land_width: float | None = None  # both lands together [m]
    land_clearance: float | None = None  # radial [m]
    outer_guided: bool = True
    land_oil_share: float = 1.0  # of the land that oil fills; the rest rubs dry [-]
    land_friction: float = 0.0  # Coulomb's mu of the dry land [-]
    mass: float = 0.0  # that the dry land carries [kg]


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance:
    """Resistance to the balls on their orbits beside the races."""

    ball: float = 0.0  # drag of the oil over the square of a ball's speed [N s^2/m^2]
    land: float = 0.0  # torque of the cage's guiding land over its slip, Petroff (1883) [N m s]
    rub: float = 0.0  # mu (1 - s) r m of a land that oil fills to the share s [kg m]
    play: float = 0.0  # radial, of the land [m]
    outer_guided: bool = True  # the land runs on the outer ring, else on the inner one
    pocket: float = 0.0  # Coulomb's mu of ball against pocket [-]

    def drag(self, speed: Array) -> Array:
        """Drag of each ball against its motion along the orbit.

        Parameters
        ----------
        speed : Array
            of the balls, shape (balls,) [m/s]

        Returns
        -------
        Array
            force, shape (balls,) [N]
        """
        return self.ball * speed * np.abs(speed)

    def cage_power(self, solution: QuasistaticSolution, cage_speed: float) -> float:
        """Power that the balls give to the cage against the drag of its land.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing
        cage_speed : float
            of the cage [rad/s]

        Returns
        -------
        float
            power [W]
        """
        slip = cage_speed - self.guiding_speed(solution)
        return self.land_torque(slip, cage_speed) * cage_speed

    def guiding_power(self, solution: QuasistaticSolution, cage_speed: float) -> float:
        """Power that the guiding ring gives to the land of the cage.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing
        cage_speed : float
            of the cage [rad/s]

        Returns
        -------
        float
            power [W]
        """
        ring = self.guiding_speed(solution)
        return -self.land_torque(cage_speed - ring, cage_speed) * ring

    def land_torque(self, slip: float, cage_speed: float) -> float:
        """Torque on the cage, against its slip over the land: oil by Petroff, and dry by Coulomb
        under the weight of the cage and the centrifugal force of a cage that lies on its land.

        Parameters
        ----------
        slip : float
            of the cage over the land [rad/s]
        cage_speed : float
            of the cage [rad/s]

        Returns
        -------
        float
            torque [N m]
        """
        load = STANDARD_GRAVITY + self.play * cage_speed**2
        return float(self.land * slip + self.rub * load * np.sign(slip))

    def guiding_speed(self, solution: QuasistaticSolution) -> float:
        """Speed of the ring that the land runs on.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing

        Returns
        -------
        float
            speed [rad/s]
        """
        operation = solution.operation
        return operation.outer_speed if self.outer_guided else operation.inner_speed


NO_RESISTANCE = Resistance()


@dataclass(frozen=True, slots=True, kw_only=True)
class ResistedPower:
    """Power that goes into heat beside the contacts [W]."""

    drag: float = 0.0  # from the balls into the oil around them
    pocket: float = 0.0  # from the balls into their pockets
    land: float = 0.0  # into the oil between the land and its ring
    guiding: float = 0.0  # of the land's, what its ring feeds in; the balls push the rest

    @property
    def of_balls(self) -> float:
        """Power that the balls give [W]."""
        return self.drag + self.pocket + self.land - self.guiding

    @property
    def heat(self) -> float:
        """All of it [W]."""
        return self.drag + self.pocket + self.land


NOTHING_RESISTED = ResistedPower()


def resistance_of(
    cage: Cage | None,
    bearing: Bearing,
    viscosity: float,
    density: float,
    oil_fraction: float | None,
) -> Resistance:
    """Resistance of the balls' drag as `churning_power` has it, of the land as `land_power`, and
    of the friction in the pockets.

    Parameters
    ----------
    cage : Cage | None
        its guidance; None without one
    bearing : Bearing
        the bearing
    viscosity : float
        of the oil [Pa s]
    density : float
        of the oil [kg/m^3]
    oil_fraction : float | None
        of the cavity that oil fills [-]; None: none

    Returns
    -------
    Resistance
        what holds the balls back beside the races
    """
    ball = ball_drag(bearing, density, oil_fraction or 0.0)
    if cage is None:
        return Resistance(ball=ball)
    return replace(_cage_resistance(cage, viscosity), ball=ball)


def _cage_resistance(cage: Cage, viscosity: float) -> Resistance:
    """Resistance of land and pockets, by the oil's viscosity [Pa s]."""
    return Resistance(
        land=land_drag(cage, viscosity),
        rub=land_rub(cage),
        play=cage.land_clearance or 0.0,
        outer_guided=cage.outer_guided,
        pocket=cage.pocket_friction,
    )


def ball_drag(bearing: Bearing, density: float, oil_fraction: float) -> float:
    """Drag of a ball over the square of its speed, C_D/2 rho X pi D^2/4.

    Parameters
    ----------
    bearing : Bearing
        the bearing
    density : float
        of the oil [kg/m^3]
    oil_fraction : float
        X, of the cavity that oil fills [-]

    Returns
    -------
    float
        [N s^2/m^2]
    """
    area = 0.25 * pi * bearing.ball_diameter**2
    return 0.5 * SPHERE_DRAG * density * oil_fraction * area


def land_drag(cage: Cage, viscosity: float) -> float:
    """Torque of the cage's guiding lands over its slip, Petroff (1883): 2 pi eta r^3 B/c, of the
    fraction that oil fills.

    Parameters
    ----------
    cage : Cage
        its guidance
    viscosity : float
        of the oil [Pa s]

    Returns
    -------
    float
        [N m s]; zero if guided by the balls
    """
    if cage.land_diameter is None or cage.land_width is None or cage.land_clearance is None:
        return 0.0
    radius = 0.5 * cage.land_diameter
    wet = cage.land_oil_share * cage.land_width
    return viscosity * 2.0 * pi * radius**3 * wet / cage.land_clearance


def land_rub(cage: Cage) -> float:
    """Torque of a land that oil fills to the fraction s, over the acceleration that presses the
    cage on it, mu (1 - s) r m.

    Parameters
    ----------
    cage : Cage
        its guidance

    Returns
    -------
    float
        [kg m]; zero if guided by the balls
    """
    radius = 0.5 * (cage.land_diameter or 0.0)
    return cage.land_friction * (1.0 - cage.land_oil_share) * radius * cage.mass


def contact_rolling_power(contact: BearingContact) -> float:
    """Power of the oil's rolling resistance of one flooded contact.

    Parameters
    ----------
    contact : BearingContact
        contact of a bearing

    Returns
    -------
    float
        power [W]
    """
    c = contact.conditions
    hertz = contact.hertz
    if c is None or hertz is None:
        return 0.0
    moment = heavy_moment(c, hertz.semi_axis_y, hertz.semi_axis_x)
    return moment * c.entrainment_speed / c.radius_x


def hysteresis_torque(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], loss: float
) -> float:
    """M_E = 1/4 D_pw [(1 - g_i^2) sum Phi_i + (1 - g_e^2) sum Phi_e] beta_a, Phi = 3/16 Q b/Rx,
    g = D cos(alpha)/D_pw.

    The energy stored in front of a rolling contact, of which the fraction beta_a is lost
    (Greenwood, Minshall and Tabor, 1961): Phi is the moment of the pressure ahead of the centre
    over the ball's radius.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        its contacts
    loss : float
        beta_a [-]

    Returns
    -------
    float
        torque [N m]
    """
    ball = solution.bearing.ball_diameter
    pitch = solution.bearing.pitch_diameter
    torque = 0.0
    for contact in contacts:
        if contact.hertz is not None:
            slope = ball * cos(contact.contact_angle) / pitch
            phi = 3.0 / 16.0 * contact.load * contact.hertz.semi_axis_x / contact.hertz.radius_x
            torque += 0.25 * pitch * (1.0 - slope**2) * phi * loss
    return torque


def land_power(cage: Cage, viscosity: float, ring_speed: float, cage_speed: float) -> float:
    """Power sheared and rubbed in the guiding lands.

    Parameters
    ----------
    cage : Cage
        its guidance
    viscosity : float
        of the oil [Pa s]
    ring_speed : float
        of the guiding ring [rad/s]
    cage_speed : float
        of the cage [rad/s]

    Returns
    -------
    float
        power [W]
    """
    slip = cage_speed - ring_speed
    return _cage_resistance(cage, viscosity).land_torque(slip, cage_speed) * slip


def pocket_power(
    cage: Cage, bearing: Bearing, solution: QuasistaticSolution, drag_power: float
) -> float:
    """Power rubbed in the pockets by the forces that pull the cage against its land drag.

    Parameters
    ----------
    cage : Cage
        its guidance
    bearing : Bearing
        the bearing
    solution : QuasistaticSolution
        equilibrium of the bearing
    drag_power : float
        of the land [W]

    Returns
    -------
    float
        power [W]
    """
    slip = abs(solution.cage_speed)
    if slip == 0.0:
        return 0.0
    force = drag_power / (slip * 0.5 * bearing.pitch_diameter)  # of all balls on the cage
    surface_speed = float(abs(solution.spin_speed).mean()) * 0.5 * bearing.ball_diameter
    return cage.pocket_friction * force * surface_speed


def churning_power(solution: QuasistaticSolution, density: float, oil_fraction: float) -> float:
    """Power of the balls' drag in the mixture of air and oil, Z C_d/2 rho X (pi D^2/4) v^3.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    density : float
        of the oil [kg/m^3]
    oil_fraction : float
        X, of the cavity that oil fills [-]

    Returns
    -------
    float
        power [W]
    """
    speeds = abs(solution.orbit_speed) * 0.5 * solution.bearing.pitch_diameter
    return float((ball_drag(solution.bearing, density, oil_fraction) * speeds**3).sum())
