"""Numbers of a model for the compiled equations of motion, and indices in the state."""

from typing import NamedTuple

from ehl.arrays import Array

# first index of a body's coordinates in the state
INNER = 0  # x, y, z, tilt y, tilt z of the inner ring
OUTER = 5  # x, y, z of the outer ring
SENSOR = 8  # of the oscillator on it
BALLS = 9  # axial and radial position of each ball

# work done since the start of the record
EXTERNAL = 0  # by loads, centrifugal forces, and the cage that turns the balls
BY_FORM = 1  # by the form of the surfaces, which pushes the bodies apart
LOST = 2  # in films, seat and sensor
STORED = 3  # place of the elastic energy beside their powers

# columns of the law of a contact, over the logarithm of the approach
FACTOR = 0  # elastic force over approach^n [N/m^n]
DAMPING = 1  # [N s/m]
ENERGY = 2  # elastic energy over approach^(n + 1) [J/m^(n + 1)]


class ContactLawTable(NamedTuple):
    """Law of the contacts with one race, even in the logarithm of the approach."""

    first: float  # ln of the smallest approach [ln m]
    step: float  # [-]
    table: Array  # (n, 3), see FACTOR
    exponent: float  # n [-]


class VibrationArrays(NamedTuple):
    """Numbers of the equations of motion, SI."""

    balls: int
    azimuth: Array  # of the balls at time zero [rad], shape (Z,)
    speeds: Array  # of inner ring, outer ring, cage, ball against the cage, at the end [rad/s]
    start_ratio: float  # of the speeds at time zero over those at the end [-]
    duration: float  # from time zero [s]
    inner_centre_radius: float  # of the circle of the groove's centres [m]
    outer_centre_radius: float
    inner_length: float  # groove radius less ball radius [m]
    outer_length: float
    ball_excess: Array  # radius of each ball over the nominal one [m], shape (Z,)
    inner_law: ContactLawTable
    outer_law: ContactLawTable
    inner_height: Array  # form over a turn [m], shape (n,)
    outer_height: Array
    ball_height: Array  # at the inner and outer race, shape (2, 1 or Z, n) [m]
    mass: Array  # of the 9 coordinates of rings and sensor [kg], [kg m^2], shape (9,)
    free: Array  # 1 of those that move, else 0, shape (9,)
    polar_inertia: float  # of the inner ring [kg m^2]
    load: Array  # on inner and outer ring [N], [N m], shape (8,)
    seat_stiffness: Array  # x, y, z [N/m], shape (3,)
    seat_damping: float  # [N s/m]
    sensor: Array  # stiffness [N/m], damping [N s/m], axis it moves along (0, 1, 2), shape (3,)
    ball_mass: float  # [kg]
    centrifugal_force: float  # on a ball at the end's speed [N]
