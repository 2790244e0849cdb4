"""What the compiled equations of motion see: numbers and arrays only, SI, in the order that
`layout` names.

`Problem` is built once a simulation (`assembly.assemble`); the kernels read it and write its
scratch arrays and the memory of the impacts, nothing else. Inner functions get single arrays of
it: a tuple of arrays handed to a compiled function costs an atomic count up and down for each of
them, which at 18 balls took ten times as long as the physics.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

INNER, OUTER, POCKET, LAND = range(4)  # rows of `Problem.normal`
STIFFNESS, EXPONENT, DAMPING = range(3)  # columns of `Problem.normal`
# `Problem.friction_kind`; FILM: a table whose films part the bodies
FRICTIONLESS, COEFFICIENT, TABLE, FILM = range(4)
DRIVE_INNER, DRIVE_OUTER, LOADS = range(3)  # accumulators: work put in [J]
(
    FRICTION_INNER,
    FRICTION_OUTER,
    RACE_DAMPING,
    POCKET_DAMPING,
    POCKET_FRICTION,
    LAND_FRICTION,
    CHURNING,
    SUPPORT,
) = range(3, 11)  # accumulators: energy dissipated [J]
FILMS = 11  # accumulator: energy that films take up, negative what they give in lifting balls [J]
ACCUMULATORS = 12
MOTION_COLUMNS = 21
RACE_COLUMNS = 11  # of `Problem.race_out`, see `RACE_NAMES`
RACE_NAMES = (
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
LOAD, APPROACH, APPROACH_SPEED, ANGLE, ENTRAINMENT, SLIDE_X, SLIDE_Y, SPIN = range(8)
FRICTION_X, FRICTION_Y, THICKNESS = range(8, 11)
POCKET_COLUMNS = 3  # of `Problem.pocket_out`: load [N], play used up [m], approach speed [m/s]


class FrictionData(NamedTuple):
    """Friction of one race: the arrays of `ehl.traction` laws, of a coefficient and of a table
    (one of them in use).
    """

    disc: Array  # quadrature over the ellipse, shape (3, n) [-]
    law: Array
    shape: Array
    axes: Array
    constants: Array
    scalars: Array
    values: Array


class Constants(NamedTuple):
    """Numbers of one bearing, SI; a tuple without arrays, which compiled functions hand on at no
    cost.
    """

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
    guide: int  # 0 balls, 1 inner ring, 2 outer ring
    land_radius: float  # [m]
    land_clearance: float
    land_width: float  # of one
    land_offset: float  # of each from the middle
    land_viscosity: float  # [Pa s]
    land_friction: float  # mu [-]
    drag: float  # of a ball over the square of its speed [N s^2/m^2]
    gravity_x: float  # [m/s^2]
    gravity_y: float
    gravity_z: float
    floor: float  # least speed that counts as that of an impact [m/s]


class Problem(NamedTuple):
    """One bearing with its cage, as numbers; SI. Vectors are along x (axial), y (load line), z,
    inertial.
    """

    constants: Constants
    # stiffness [N/m^exponent], exponent [-], damping factor [-]; inner, outer, pocket, land
    normal: Array
    friction_kind: int
    friction_inner: FrictionData
    friction_outer: FrictionData
    free: Array  # 1 or 0 for the 5 coordinates of the ring, 6 of the cage, 6 of a ball
    pocket_angle: Array  # of each pocket in the cage, shape (Z,) [rad]
    # rows: time [s], speeds of inner and outer ring [rad/s], force [N], moment [N m]; shape (n, 8)
    schedule: Array
    # speed of the impact that began each contact [m/s]; inner, outer, pocket of each ball, two
    # lands
    memory: Array
    # scratch: inner ring, outer ring, cage; centre, axis, velocity, angular velocity; shape (3,
    # 12)
    bodies: Array
    # scratch: speeds, force, moment of the schedule; load on the outer ring; of a pocket; shape
    # (32,)
    given: Array
    motion: Array  # scratch: how balls meet races, shape (2, Z, MOTION_COLUMNS)
    friction: Array  # scratch: friction of the races, shape (2, Z, 8)
    forces: Array  # scratch: force and moment on each ball, shape (Z, 6) [N], [N m]
    race_out: Array  # state of the races' contacts, shape (2, Z, RACE_COLUMNS)
    pocket_out: Array  # of the pockets, shape (Z, POCKET_COLUMNS)
    land_out: Array  # gap used up [m] and its rate [m/s] of both lands, shape (2, 2)
    # load and film of the races' contacts after the last step, shape (2, Z, 2) [N], [m]
    films: Array
    power: Array  # into and out of the accumulators [W], shape (ACCUMULATORS,)
    # of the contacts on inner ring and cage: force, moment about the centre, shape (2, 6) [N], [N
    # m]
    loads: Array
