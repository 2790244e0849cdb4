"""Resistance of a bearing beside sliding: hysteresis of the contacts, the oil's rolling
resistance, cage, and drag of the balls in oil.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, pi

import numpy as np

from oilfilm.ehl.arrays import Array

from ..contacts.contact import BearingContact
from ..films.heavy_moment import elastic_moment, heavy_moment
from ..library.plugins import library_data
from ..quasistatic.solution import QuasistaticSolution

# drag of balls behind each other over that of a lone sphere [-]: chosen with the measured heat of
# NASA's 35-mm bearing known (docs/validation/heat_of_bearings.md); range: several times less than
# alone (Marchesse et al., 2014, second hand) up to alone
SHIELDING = 0.5
SHIELDING_RANGE = (0.2, 1.0)
# share of the elastic energy lost in rolling, hardened steel [-]; range from memory
HYSTERESIS = 0.01
HYSTERESIS_RANGE = (0.005, 0.02)
TYPICAL = "typical.toml"
STANDARD_GRAVITY = 9.80665  # CGPM, 1901 [m/s^2]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cage:
    """Guidance of the cage and friction in its pockets."""

    # Coulomb's mu of ball against pocket [-]; None: typical
    pocket_friction: float | None = None
    land_diameter: float | None = None  # of the guiding land [m]; None: guided by the balls
    land_width: float | None = None  # both lands together [m]
    land_clearance: float | None = None  # radial [m]
    outer_guided: bool = True
    land_oil_share: float = 1.0  # of the land that oil fills; the rest rubs dry [-]
    land_friction: float = 0.0  # Coulomb's mu of the dry land [-]
    mass: float = 0.0  # that the dry land carries [kg]

    @property
    def friction(self) -> float:
        """Coulomb's mu of ball against pocket [-]."""
        typical = library_data(TYPICAL)["cage_friction"]["value"]
        return typical if self.pocket_friction is None else self.pocket_friction


@dataclass(frozen=True, slots=True, kw_only=True)
class Mixture:
    """Oil and air around the balls: what stands in the way of a ball is that of oil, times the
    share that oil has (Dukler's viscosity of a homogeneous mixture, weighted by volume).
    """

    oil_share: float  # X, of the cavity [-]
    density: float  # of the oil [kg/m^3]
    viscosity: float  # of the oil [Pa s]
    ball_radius: float  # [m]

    def drag(self, speed: Array) -> Array:
        """Drag of each ball against its orbit, s X C_D rho V^2/2 pi D^2/4, C_D = 24/Re + 6/(1 +
        sqrt(Re)) + 0.4 (White, Viscous Fluid Flow), Re = rho V D/eta.

        Parameters
        ----------
        speed : Array
            V, of the balls, shape (balls,) [m/s]

        Returns
        -------
        Array
            force, shape (balls,) [N]
        """
        size = np.abs(speed)
        creep = self.viscosity / (self.density * 2.0 * self.ball_radius)  # V/Re [m/s]
        coefficient = 6.0 / (1.0 + np.sqrt(size / creep)) + 0.4
        pressure = 0.5 * self.density * pi * self.ball_radius**2
        return SHIELDING * self.oil_share * pressure * (24.0 * creep + coefficient * size) * speed

    def spin_drag(self, surface: Array) -> Array:
        """Moment over the radius that resists each ball's rotation, s X C_M rho r^4 w^2/2, C_M =
        6.45/sqrt(Re) + 32.1/Re (Dennis, Singh and Ingham, 1980), Re = rho r^2 w/eta; that of
        creeping flow, 16 pi/Re, where it is more, below Re = 8.

        Parameters
        ----------
        surface : Array
            r w, velocities of rotation, shape (balls, 3) [m/s]

        Returns
        -------
        Array
            force, shape (balls, 3) [N]
        """
        creep = self.viscosity / (self.density * self.ball_radius)  # r w/Re [m/s]
        size = np.linalg.norm(surface, axis=1)[:, None]
        pressure = 0.5 * self.density * self.ball_radius**2
        moment = np.maximum(6.45 * np.sqrt(creep * size) + 32.1 * creep, 16.0 * np.pi * creep)
        return SHIELDING * self.oil_share * pressure * moment * surface


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance:
    """Resistance to the balls on their orbits beside the races."""

    mixture: Mixture | None = None  # that the balls go through
    bath: float = 0.0  # drag of the oil bath on each ball [N]
    land: float = 0.0  # torque of the cage's guiding land over its slip, Petroff (1883) [N m s]
    rub: float = 0.0  # mu (1 - s) r m of a land that oil fills to the share s [kg m]
    play: float = 0.0  # radial, of the land [m]
    outer_guided: bool = True  # the land runs on the outer ring, else on the inner one
    pocket: float = 0.0  # Coulomb's mu of ball against pocket [-]

    def drag(self, velocities: Array) -> Array:
        """Forces of the oil against the motion of each ball.

        Parameters
        ----------
        velocities : Array
            along the orbit, and of rotation times the radius, shape (balls, 4) [m/s]

        Returns
        -------
        Array
            along the orbit, and moments over the radius, shape (balls, 4) [N]
        """
        forces = np.zeros_like(velocities)
        forces[:, 0] = self.bath * np.sign(velocities[:, 0])
        if self.mixture is not None:
            forces[:, 0] += self.mixture.drag(velocities[:, 0])
            forces[:, 1:] = self.mixture.spin_drag(velocities[:, 1:])
        return forces

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
    cage: Cage, viscosity: float, mixture: Mixture | None = None, bath: float = 0.0
) -> Resistance:
    """Resistance of oil around the balls, of the cage's land and of the friction in its pockets.

    Parameters
    ----------
    cage : Cage
        its guidance
    viscosity : float
        of the oil [Pa s]
    mixture : Mixture | None, optional
        of oil and air in the cavity
    bath : float, default 0.0
        drag of an oil bath on each ball [N]

    Returns
    -------
    Resistance
        what holds the balls back beside the races
    """
    return replace(_cage_resistance(cage, viscosity), mixture=mixture, bath=bath)


def _cage_resistance(cage: Cage, viscosity: float) -> Resistance:
    """Resistance of land and pockets, by the oil's viscosity [Pa s]."""
    return Resistance(
        land=land_drag(cage, viscosity),
        rub=land_rub(cage),
        play=cage.land_clearance or 0.0,
        outer_guided=cage.outer_guided,
        pocket=cage.friction,
    )


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

    Phi is `elastic_moment` over R_x.

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
            phi = elastic_moment(contact, loss) / contact.hertz.radius_x
            torque += 0.25 * pitch * (1.0 - slope**2) * phi
    return torque
