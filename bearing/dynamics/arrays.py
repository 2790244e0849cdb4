"""Numbers and arrays that the compiled equations of motion share, and the names of their rows and
columns; SI, vectors along x (axial), y (load line) and z, inertial.

`EquationData` is assembled once a simulation; the kernels write its scratch arrays and the memory
of the impacts. Inner kernels get single arrays of it: a tuple of arrays passed to a compiled
function costs an atomic count up and down for each, at 18 balls ten times the time of the physics.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# rows of `normal` and, times the number of balls, first places in `memory`
INNER, OUTER, POCKET, LAND = range(4)
STIFFNESS, EXPONENT, DAMPING = range(3)  # columns of `normal`
# `friction_kind`; FILM: a traction table whose films separate the bodies
FRICTIONLESS, COEFFICIENT, TABLE, FILM = range(4)
GUIDED_BY_BALLS, GUIDED_BY_INNER_RING, GUIDED_BY_OUTER_RING = range(3)

CAGE_BODY = 2  # row of `bodies` after INNER and OUTER
# first columns of the vectors in `bodies`
CENTRE = 0
AXIS = 3
VELOCITY = 6
TURN = 9
BODY_COLUMNS = 12
RING_LOAD, CAGE_LOAD = range(2)  # rows of `loads`
# first columns of the vectors in `loads`, `forces`, `outer_load`
FORCE = 0
MOMENT = 3
LOAD_COLUMNS = 6

# columns of `given`; those of `schedule` are the time and these
INNER_SPEED = 0
OUTER_SPEED = 1
GIVEN_FORCE = 2
GIVEN_MOMENT = 5
GIVEN_COLUMNS = 7
TIME = 0
SCHEDULED = 1

# columns of `motion`: vectors (normal into the race, entrainment, across it, contact point) ...
NORMAL = 0
X_AXIS = 3
Y_AXIS = 6
POINT = 9
# ... and what `RACE_NAMES` describes; ROLL: relative turn about the y axis [rad/s]
SLIDE_X, SLIDE_Y, SPIN, ROLL, ENTRAINMENT = range(12, 17)
APPROACH_SPEED, ANGLE, APPROACH, THICKNESS = range(17, 21)
MOTION_COLUMNS = 21

# columns of `friction`, as the kernels of `ehl.traction` write them
FORCE_X, FORCE_Y, SPIN_MOMENT, ROLL_MOMENT = range(4)
CENTRAL_FILM = 5
FILM_DAMPING = 7
FRICTION_COLUMNS = 8

RACE_NAMES = (  # columns of `race_out`
    "load",  # [N]
    # of the elastic bodies, over the film where the contact is lubricated [m]; negative: gap
    "approach",
    "approach_speed",  # [m/s]
    "contact_angle",  # [rad]
    "entrainment_speed",  # [m/s]
    "slide_x",  # ball less race along the entrainment [m/s]
    "slide_y",  # [m/s]
    "spin",  # [rad/s]
    "friction_x",  # on the ball [N]
    "friction_y",  # [N]
    # of a traction table, central [m]; 0: without a table, in the record of an open contact too
    "film",
)
RACE_COLUMNS = len(RACE_NAMES)
RACE_FORCE, RACE_APPROACH, RACE_RATE, RACE_ANGLE, RACE_ENTRAINMENT = range(5)
RACE_SLIDE_X, RACE_SLIDE_Y, RACE_SPIN, RACE_FRICTION_X, RACE_FRICTION_Y, RACE_FILM = range(5, 11)
POCKET_FORCE, POCKET_APPROACH, POCKET_RATE = range(3)  # of `pocket_out` [N], [m], [m/s]
POCKET_COLUMNS = 3
LAND_APPROACH, LAND_RATE = range(2)  # of `land_out` [m], [m/s]
LAND_COLUMNS = 2
STEP_LOAD, STEP_FILM = range(2)  # of `films` [N], [m]

# accumulators: work put in, energy dissipated, energy that films take up (negative what they give
# in lifting balls) [J]
DRIVE_INNER, DRIVE_OUTER, LOADS = range(3)
FRICTION_INNER, FRICTION_OUTER, RACE_DAMPING, POCKET_DAMPING = range(3, 7)
POCKET_FRICTION, LAND_FRICTION, CHURNING, SUPPORT = range(7, 11)
FILMS = 11
ACCUMULATORS = 12
KINETIC, ELASTIC, POTENTIAL = range(3)  # columns of the stored energies [J]


class FrictionData(NamedTuple):
    """Friction of one race: arrays for a coefficient and for a table, one of them in use."""

    disc: Array  # quadrature over the ellipse, shape (3, n) [-]
    law: Array
    shape: Array
    axes: Array
    constants: Array
    scalars: Array
    values: Array


class Constants(NamedTuple):
    """Numbers of one bearing, SI; without arrays, so passed on at no cost."""

    balls: int
    ball_mass: float  # [kg]
    ball_inertia: float  # 2/5 m R^2 [kg m^2]
    ball_radius: float  # R [m]
    inner_centre: float  # radius of the circle of groove centres [m]
    outer_centre: float
    inner_groove: float  # radius of the groove [m]
    outer_groove: float
    ring_mass: float  # [kg]
    ring_transverse: float  # inertia [kg m^2]
    ring_polar: float
    ring_damping: float  # of its support, along x, y, z [N s/m]
    unbalance: float  # of the inner ring [kg m]
    unbalance_phase: float  # from +y at time zero [rad]
    cage_mass: float  # [kg]; 0: no cage
    cage_transverse: float  # inertia [kg m^2]
    cage_polar: float
    pocket_play: float  # radial [m]
    # radius of the centres of spherical pockets [m]; 0: cylindrical ones, along the radius
    pocket_circle: float
    pocket_friction: float  # mu [-]
    friction_ramp: float  # of pockets and lands [m/s]
    pocket_shear: float  # 6 pi viscosity R, Stokes' drag of a ball [N s/m]
    film_least: float  # [m]
    guide: int  # GUIDED_BY_BALLS, ...
    land_radius: float  # [m]
    land_clearance: float
    land_width: float  # of one
    land_offset: float  # of each from the middle
    land_viscosity: float  # [Pa s]
    land_friction: float  # mu [-]
    drag: float  # of a ball over the square of its speed [N s^2/m^2]
    gravity: tuple[float, float, float]  # [m/s^2]
    floor: float  # least speed that counts as that of an impact [m/s]


class EquationData(NamedTuple):
    """One bearing with its cage in numbers [SI]."""

    constants: Constants
    normal: Array  # stiffness [N/m^exponent], exponent [-], damping factor [-], shape (4, 3)
    friction_kind: int
    friction_inner: FrictionData
    friction_outer: FrictionData
    free: Array  # 1 or 0 for the 5 coordinates of the ring, 6 of the cage, 6 of a ball
    pocket_angle: Array  # of each pocket in the cage, shape (Z,) [rad]
    # time [s], speeds of inner and outer ring [rad/s], force [N], moment [N m]; shape (n, 8)
    schedule: Array
    # speed of the impact that began each contact [m/s]: inner, outer, pocket of each ball, lands
    memory: Array
    bodies: Array  # scratch: inner ring, outer ring, cage, shape (3, BODY_COLUMNS)
    given: Array  # scratch: speeds, force, moment of the schedule, shape (GIVEN_COLUMNS,)
    outer_load: Array  # scratch: force and moment on the outer ring, shape (6,) [N], [N m]
    motion: Array  # scratch: motion of balls on races, shape (2, Z, MOTION_COLUMNS)
    friction: Array  # scratch: friction of the races, shape (2, Z, FRICTION_COLUMNS)
    forces: Array  # scratch: force and moment on each ball, shape (Z, 6) [N], [N m]
    race_out: Array  # state of the races' contacts, shape (2, Z, RACE_COLUMNS)
    pocket_out: Array  # of the pockets, shape (Z, POCKET_COLUMNS)
    land_out: Array  # of the two lands, shape (2, LAND_COLUMNS)
    films: Array  # load and film of the races' contacts after the last step, shape (2, Z, 2)
    power: Array  # into and out of the accumulators [W], shape (ACCUMULATORS,)
    loads: Array  # of the contacts on inner ring and cage, shape (2, 6) [N], [N m]
