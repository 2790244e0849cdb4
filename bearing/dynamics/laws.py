"""Numbers of the model in closed form: normal contact, drag of a ball, speed of the cage."""

from math import pi, sqrt

from ..geometry import Bearing, Race, contact_modulus
from ..operation import Operation
from ..rating.frequencies import kinematic_cage_speed
from .choices import NormalLaw, RaceStiffness


def damping_factor(law: NormalLaw, restitution: float) -> float:
    """chi of K d^n (1 + chi v/v_0) from the restitution, see `NormalLaw`.

    Parameters
    ----------
    law : NormalLaw
        normal law
    restitution : float
        e [-]

    Returns
    -------
    float
        chi [-]
    """
    e = restitution
    factors = {
        NormalLaw.LANKARANI_NIKRAVESH: 0.75 * (1.0 - e * e),
        NormalLaw.HUNT_CROSSLEY: 1.5 * (1.0 - e),
        NormalLaw.FLORES: 1.6 * (1.0 - e) / e,
    }
    return factors.get(law, 0.0)


def planar_stiffness(ball_radius: float, race_radius: float, modulus: float, race: Race) -> float:
    """K of a sphere on a sphere or in a spherical hollow, Lankarani and Nikravesh (1990).

    K = 4/(3 pi (h_1 + h_2)) sqrt(r R/(R + r)), h = (1 - nu^2)/(pi E), and R - r at the outer race,
    whose surface is hollow; Shan et al. (2023) Eq. (12) prints the plus sign for both. With E' (2
    E*): K = (2/3) E' sqrt(...).

    Parameters
    ----------
    ball_radius : float
        r [m]
    race_radius : float
        R [m]
    modulus : float
        E' of the pair [Pa]
    race : Race
        INNER takes the sphere, OUTER the hollow

    Returns
    -------
    float
        K [N/m^1.5]
    """
    sign = 1.0 if race is Race.INNER else -1.0
    radius = ball_radius * race_radius / (race_radius + sign * ball_radius)
    return 2.0 / 3.0 * modulus * sqrt(radius)


def race_stiffnesses(bearing: Bearing, kind: RaceStiffness) -> dict[str, float]:
    """K of inner and outer race for a `NormalContact`.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    kind : RaceStiffness
        formula of the stiffness

    Returns
    -------
    dict[str, float]
        keyword arguments [N/m^1.5]; none for that of Hertz
    """
    if kind is RaceStiffness.HERTZ:
        return {}
    ball = 0.5 * bearing.ball_diameter
    bottom = bearing.inner_centre_radius - bearing.inner_groove_radius
    top = bearing.outer_centre_radius + bearing.outer_groove_radius
    surface = Race.INNER if kind is RaceStiffness.PLANAR_AS_PRINTED else Race.OUTER
    inner_modulus, outer_modulus = (contact_modulus(bearing, race) for race in Race)
    return {
        "inner_stiffness": planar_stiffness(ball, bottom, inner_modulus, Race.INNER),
        "outer_stiffness": planar_stiffness(ball, top, outer_modulus, surface),
    }


def vibration_frequency(stiffness: float, load: float, mass: float) -> float:
    """Angular frequency of a ball between two races, sqrt(2 k/m) with k = 1.5 K^(2/3) Q^(1/3).

    Parameters
    ----------
    stiffness : float
        K [N/m^1.5]
    load : float
        Q [N]
    mass : float
        m of the ball [kg]

    Returns
    -------
    float
        angular frequency [rad/s]
    """
    return sqrt(3.0 * stiffness ** (2.0 / 3.0) * load ** (1.0 / 3.0) / mass)


def drag_of_mixture(density: float, ball_diameter: float, coefficient: float) -> float:
    """Drag of a ball over the square of its speed, C_D rho (pi/4) D^2/2, in oil and air at rest.

    Parameters
    ----------
    density : float
        rho of the mixture [kg/m^3]
    ball_diameter : float
        D [m]
    coefficient : float
        C_D [-]

    Returns
    -------
    float
        drag over speed squared [N s^2/m^2]
    """
    return 0.5 * coefficient * density * 0.25 * pi * ball_diameter**2


def drag_of_force(bearing: Bearing, operation: Operation, force: float) -> float:
    """Drag over speed squared from a drag at the kinematic orbit speed.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    operation : Operation
        speeds of the rings
    force : float
        drag of a ball at that speed [N]

    Returns
    -------
    float
        drag over speed squared; zero if the speed is [N s^2/m^2]
    """
    angle = bearing.free_contact_angle if operation.force[0] else 0.0
    speed = kinematic_cage_speed(bearing, operation.inner_speed, operation.outer_speed, angle)
    speed *= 0.5 * bearing.pitch_diameter
    return force / speed**2 if speed != 0.0 else 0.0


def cage_drag_of_torque(bearing: Bearing, operation: Operation, torque: float) -> float:
    """Torque over speed squared from a torque at the cage's kinematic speed.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    operation : Operation
        speeds of the rings
    torque : float
        drag torque of the cage at that speed [N m]

    Returns
    -------
    float
        torque over speed squared; zero if the speed is [N m s^2]
    """
    angle = bearing.free_contact_angle if operation.force[0] else 0.0
    speed = kinematic_cage_speed(bearing, operation.inner_speed, operation.outer_speed, angle)
    return torque / speed**2 if speed != 0.0 else 0.0
