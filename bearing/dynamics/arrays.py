"""Arrays that the compiled equations of motion share, the state vector, and the names of their
rows and columns; SI, vectors along x (axial), y (load line) and z, inertial.

`EquationData` is assembled once a simulation. All of fixed size stands in two structured arrays,
one record for the bearing and one for each ball, which compiled functions hand on by reference:
`KernelData`. Kernels write scratch arrays and the speeds of the impacts there, and the fields of
`EquationData` are views of them.

The state vector has positions, velocities, the angle of the inner ring and energy accumulators.
Positions: ring x, y, z, tilt y, tilt z; cage x, y, z, rotation about x, tilt y, tilt z; outer ring
x, y, z; sensor along its axis; x, y, z of each ball. Velocities: the same, then the angular
velocities of the balls, all along inertial axes. Behind them the angles of inner and outer ring,
and those by which the balls have rolled.
A ball's attitude does not enter its equations of motion; it is advanced beside them (`attitude`).
The kernels find these places by `_state_kernels`.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

Vector = tuple[float, float, float]

# rows of `normal` and, times the number of balls, first places in `impact_speeds`
INNER, OUTER, POCKET, LAND = range(4)
CAGE_LOAD = 2  # row of `loads` after INNER and OUTER
# columns of `normal`: the elastic force, the damping of impacts, and that of contacts that last:
# of a film, which fades below a load, and in proportion to the stiffness
STIFFNESS, EXPONENT, DAMPING, FILM_RATE, FILM_LOAD, LOSS = range(6)
# damping of a film from FILM_LOAD to a heavier load, linear over its logarithm, and that load
HEAVY_LOAD, HEAVY_RATE = range(6, 8)
# stiffness over ln(approach) at even knots, in place of STIFFNESS: the first, their step, 0: none
KNOT_FIRST, KNOT_STEP, KNOTS = range(8, 11)
KNOT_COUNT = 24
NORMAL_COLUMNS = KNOTS + KNOT_COUNT
# `friction_kind`; FILM: a traction table whose films separate the bodies
FRICTIONLESS, COEFFICIENT, TABLE, FILM = range(4)
GUIDED_BY_BALLS, GUIDED_BY_INNER_RING, GUIDED_BY_OUTER_RING = range(3)  # as `inputs.Guidance`

# first columns of the two vectors in `loads` and `forces`
FORCE = 0
MOMENT = 3
LOAD_COLUMNS = 6

# columns of `schedule` and `prescribed`
INNER_SPEED = 0
OUTER_SPEED = 1
PRESCRIBED_FORCE = 2
PRESCRIBED_MOMENT = 5
PRESCRIBED_DISPLACEMENT = (
    7  # of the inner ring where it is held: x, y, z [m], tilt y, tilt z [rad]
)
PRESCRIBED_RATE = 12  # its rate [m/s], [rad/s]
OIL_VISCOSITY = 17  # of pockets and lands, over `Constants.film_viscosity` [-]
GUIDE_SPEED = 18  # of balls that keep their places in a cage that turns as prescribed [rad/s]
ROLL_SPEED = 19  # of these balls about their own axes, against the cage [rad/s]
FORM_SHARE = 20  # part of the form of the surfaces that has grown [-]
PRESCRIBED_COLUMNS = 21

# columns of `friction`, as the kernels of `oilfilm.ehl.traction` write them
FORCE_X, FORCE_Y, SPIN_MOMENT, ROLL_MOMENT = range(4)
RACE_FILM = 5
FILM_DAMPING = 7
FRICTION_COLUMNS = 8

STEP_LOAD, STEP_FILM = range(2)  # columns of `films` [N], [m]
KINETIC, ELASTIC, POTENTIAL = range(3)  # columns of the stored energies [J]

POCKET_COLUMNS = 3

OF_RACES = ("race_out", "films", "linear")  # fields of a ball with a row for each race

RING = 5  # coordinates of the ring; also the place of the cage's first
CAGE = 6
SEAT = RING + CAGE  # place of the outer ring's first coordinate
SENSOR = SEAT + 3
BODIES = SENSOR + 1  # place of the balls' first coordinate
# places among the coordinates of the ring, and of the cage
RING_TILT = 3
CAGE_ROTATION = 3
CAGE_TILT = 4
FREE_TURN = BODIES + 3  # in `EquationData.free`, after the positions of a ball


class ContactColumns(NamedTuple):
    """Columns of `race_out`, the first three also of `pocket_out` and `land_out`."""

    load: int  # [N]
    # approach of the elastic bodies, over the film if the contact is lubricated [m]; negative: gap
    approach: int
    approach_speed: int  # [m/s]
    contact_angle: int  # [rad]
    entrainment_speed: int  # [m/s]
    slide_x: int  # ball less race along the entrainment [m/s]
    slide_y: int  # [m/s]
    spin: int  # [rad/s]
    friction_x: int  # on the ball [N]
    friction_y: int  # [N]
    # central film of a traction table [m]; 0: without a table, or in the record of an open one
    film: int


class LinearColumns(NamedTuple):
    """First columns of `linear`, see `_race_kernels`."""

    load: int  # [N]; 0: no slopes
    motion: int  # slide_x, slide_y [m/s], spin [rad/s]
    x_axis: int  # three [-]
    friction: int  # FRICTION_COLUMNS
    slopes: int  # of four forces and moments over three motions [N s/m], [N s], [N m s]
    rate: int  # of the decay of sliding by them [1/s]
    interval: int  # steps between calls of the law [-]
    size: int  # number of columns


class WorkColumns(NamedTuple):
    """Accumulators: work put in, energy dissipated, energy that films take up, negative what they
    give in lifting balls [J].
    """

    drive_inner: int
    drive_outer: int
    drive_cage: int  # of a prescribed cage, which turns the balls
    loads: int
    friction_inner: int
    friction_outer: int
    race_damping: int
    pocket_damping: int
    pocket_friction: int
    pocket_film: int
    land_friction: int
    churning: int
    support: int
    films: int


RACE_COLUMNS = len(ContactColumns._fields)
ACCUMULATORS = len(WorkColumns._fields)
CONTACT = ContactColumns(*range(RACE_COLUMNS))
LINEAR = LinearColumns(
    0, 1, 4, 7, 7 + FRICTION_COLUMNS, *range(19 + FRICTION_COLUMNS, 22 + FRICTION_COLUMNS)
)
WORK = WorkColumns(*range(ACCUMULATORS))


class Body(NamedTuple):
    """Motion of inner ring, outer ring or cage."""

    centre: Vector  # [m]
    axis: Vector  # [-]
    velocity: Vector  # of the centre [m/s]
    turn: Vector  # angular velocity [rad/s]


class RaceMotion(NamedTuple):
    """Motion of a ball on a race."""

    normal: Vector  # into the race [-]
    x_axis: Vector  # along the entrainment [-]
    y_axis: Vector  # [-]
    point: Vector  # of contact [m]
    slide_x: float  # [m/s]
    slide_y: float  # [m/s]
    spin: float  # [rad/s]
    roll: float  # relative turn about the y axis [rad/s]
    entrainment: float  # [m/s]
    approach_speed: float  # [m/s]
    angle: float  # of contact [rad]
    approach: float  # of the bodies as if rigid [m]


class CoefficientData(NamedTuple):
    """A coefficient of friction over the contact ellipse, as `oilfilm.ehl.traction` takes it."""

    disc: Array  # quadrature over the ellipse, shape (3, n) [-]
    law: Array
    shape: Array


class TableData(NamedTuple):
    """A traction table, as `oilfilm.ehl.traction` takes it."""

    axes: Array
    constants: Array
    scalars: Array
    values: NDArray[np.int16]


class FrictionData(NamedTuple):
    """Friction of one race: a coefficient, a table, or neither.

    Kernels are compiled for the types of their arguments: without a table nothing is compiled
    that looks one up.
    """

    coefficient: CoefficientData | None
    table: TableData | None


class Constants(NamedTuple):
    """Numbers of one bearing, SI."""

    balls: int  # those whose motion is solved
    symmetric_copies: int  # balls that each of them stands for
    mirrored: int  # 1: the plane across the axis is a mirror, balls have no spin on the races
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
    rotating_force: float  # that goes round on the inner ring [N]
    rotating_speed: float  # [rad/s]
    rotating_phase: float  # from +y at time zero [rad]
    cage_mass: float  # [kg]; 0: no cage
    cage_transverse: float  # inertia [kg m^2]
    cage_polar: float
    pocket_play: float  # radial, of the tightest pocket [m]
    cage_drag: float  # torque on the cage over the square of its speed [N m s^2]
    cage_unbalance: float  # towards the first pocket [kg m]
    ball_friction: float  # mu of ball on ball, without a cage [-]
    # radius of the centres of spherical pockets [m]; 0: cylindrical ones, along the radius
    pocket_circle: float
    pocket_friction: float  # mu [-]
    friction_ramp: float  # of pockets and lands [m/s]
    pocket_height: float  # of its wall along the radius [m]; 0: without a film
    film_viscosity: float  # of the oil in pockets and lands, where OIL_VISCOSITY is one [Pa s]
    film_least: float  # [m]
    guide: int  # GUIDED_BY_BALLS, ...
    land_radius: float  # [m]
    land_clearance: float
    land_width: float  # of one
    land_offset: float  # of each from the middle
    land_friction: float  # mu [-]
    drag: float  # of a ball over the square of its speed [N s^2/m^2]
    gravity: Vector  # [m/s^2]
    floor: float  # least speed that counts as that of an impact [m/s]
    guided: int  # 1: balls go round at GUIDE_SPEED, whatever pushes them
    outer_mass: float  # of the outer ring and what moves with it [kg]
    outer_load: Vector  # on it, which the inner ring's load at the start balances [N]
    seat_stiffness: Vector  # along x, y, z [N/m]
    seat_damping: float  # [N s/m]
    sensor_mass: float  # on the outer ring [kg]; 0: none
    sensor_axis: int  # along which it moves
    sensor_stiffness: float  # [N/m]
    sensor_damping: float  # [N s/m]
    form_gain: float  # rate at which the form of the surfaces grows from nothing [1/s]; 0: all
    settling_rate: float  # damping of all bodies over their masses before time zero [1/s]
    settling_start: float  # time at which the form begins to grow [s]
    settling_end: float  # and up to which bodies are damped [s]


def _constant_type(kind: Any) -> Any:
    """Type of a field of a structured array for a field of `Constants`."""
    return {int: np.int64, float: np.float64}.get(kind, (np.float64, (3,)))


CONSTANTS = np.dtype(
    [(name, _constant_type(kind)) for name, kind in Constants.__annotations__.items()], align=True
)
# record of the bearing, and of each ball: fields of `EquationData`
BEARING = np.dtype(
    [
        ("constants", CONSTANTS),
        ("normal", np.float64, (4, NORMAL_COLUMNS)),
        ("friction_kind", np.int64),
        ("mechanical", np.int64),
        ("free", np.float64, (FREE_TURN + 3,)),
        ("constrained", np.float64, (5,)),
        ("prescribed", np.float64, (PRESCRIBED_COLUMNS,)),
        ("friction", np.float64, (FRICTION_COLUMNS,)),
        ("land_out", np.float64, (2, POCKET_COLUMNS)),
        ("predicted_friction", np.float64, (4,)),
        ("implicit_step", np.float64, (1,)),
        ("system", np.float64, (6, 7)),
        ("power", np.float64, (ACCUMULATORS,)),
        ("loads", np.float64, (3, LOAD_COLUMNS)),
    ],
    align=True,
)
BALL = np.dtype(
    [
        ("pocket_angle", np.float64),
        ("pocket_direction", np.float64, (2,)),
        ("pocket_play", np.float64),
        ("excess", np.float64),
        ("forces", np.float64, (LOAD_COLUMNS,)),
        ("race_out", np.float64, (2, RACE_COLUMNS)),
        ("pocket_out", np.float64, (POCKET_COLUMNS,)),
        ("films", np.float64, (2, 2)),
        ("linear", np.float64, (2, LINEAR.size)),
        ("pocket_films", np.float64, (38,)),
        ("turns", np.float64, (3,)),
    ],
    align=True,
)


class KernelData(NamedTuple):
    """One bearing as the compiled equations take it; see `EquationData` for the fields."""

    bearing: Any  # record of BEARING
    balls: Any  # records of BALL, shape (Z,)
    friction_inner: FrictionData
    friction_outer: FrictionData
    times: Array
    schedule: Array
    impact_speeds: Array
    solved: NDArray[np.int64]
    full_state: Array
    rates: Array
    inner_form: Array
    outer_form: Array
    ball_form: Array


class EquationData(NamedTuple):
    """One bearing with its cage in numbers [SI]."""

    constants: Constants
    # stiffness [N/m^exponent], exponent [-], damping factor [-]; of contacts that last: film's
    # damping [N s/m], load below which it fades [N], damping over stiffness [s]; shape (4, ...)
    normal: Array
    friction_kind: int
    friction_inner: FrictionData
    friction_outer: FrictionData
    # 1 or 0 for the 5 coordinates of the ring, 6 of the cage, 3 of the outer ring, 1 of the
    # sensor, 6 of a ball
    free: Array
    constrained: Array  # 1 for coordinates of the ring with a prescribed place, else 0, shape (5,)
    pocket_angle: Array  # of each pocket in the cage, shape (Z,) [rad]
    pocket_direction: Array  # direction (y, z) of each pocket in the cage, shape (Z, 2) [-]
    pocket_play: Array  # radial, of each pocket, shape (Z,) [m]
    excess: Array  # radius of each ball over the nominal one, shape (Z,) [m]
    # heights of the surfaces over a turn: of the rings, shape (n,), of the balls at inner and
    # outer race, shape (2, 1 or Z, n); two zeros where a surface is even [m]
    inner_form: Array
    outer_form: Array
    ball_form: Array
    times: Array  # of the rows of the schedule, shape (n,) [s]
    # speeds of inner and outer ring [rad/s], force [N], moment [N m], place of the ring where it
    # is held [m], [rad], its rate, viscosity [-]; shape (n, PRESCRIBED_COLUMNS)
    schedule: Array
    # speed of the impact that began each contact [m/s]: inner, outer, pocket of each ball, lands
    impact_speeds: Array
    prescribed: Array  # scratch: the schedule at a time, shape (PRESCRIBED_COLUMNS,)
    friction: Array  # scratch: friction of one ball on a race, shape (FRICTION_COLUMNS,)
    forces: Array  # scratch: force and moment on each ball, shape (Z, 6) [N], [N m]
    race_out: Array  # state of the races' contacts, shape (2, Z, RACE_COLUMNS)
    pocket_out: Array  # of the pockets, shape (Z, POCKET_COLUMNS)
    land_out: Array  # of the two lands, shape (2, POCKET_COLUMNS)
    films: Array  # load and film of the races' contacts after the last step, shape (2, Z, 2)
    # friction of the races linearised, shape (2, Z, LINEAR.size); no slopes where the law counts
    linear: Array
    pocket_films: Array  # of the pockets as matrices, shape (Z, 38); `_cage_kernels`
    predicted_friction: Array  # scratch: forces and moments by slopes, shape (4,)
    implicit_step: Array  # step that friction is implicit over, shape (1,); 0: not [s]
    system: Array  # scratch: equations of a ball's acceleration, shape (6, 7)
    power: Array  # into and out of the accumulators [W], shape (ACCUMULATORS,)
    loads: Array  # of the contacts on inner ring, outer ring and cage, shape (3, 6) [N], [N m]
    # places in the state vector of what is solved: coordinates, speeds, then all that follows them
    solved: NDArray[np.int64]
    mechanical: int  # of them under error control, the coordinates and speeds
    full_state: Array  # scratch: state vector, the coordinates that are not solved at rest [SI]
    rates: Array  # scratch: its rates
    turns: Array  # scratch: angular velocities of the balls before a step, shape (Z, 3) [rad/s]
    kernel: KernelData  # all of it, as the kernels take it


def equation_data(**fields: Any) -> EquationData:
    """`EquationData` of fields: those of fixed size are copied into two structured arrays, zero
    where absent; the others are the arrays themselves.

    Parameters
    ----------
    **fields : Any
        the fields of `EquationData` but `kernel`; those of `BEARING` and `BALL` may be absent

    Returns
    -------
    EquationData
        the data
    """
    bearing = np.zeros(1, BEARING)
    balls = np.zeros(len(fields["pocket_angle"]), BALL)
    views: dict[str, Any] = {}
    for name in BEARING.names or ():
        if name in fields:
            bearing[name] = fields[name]
        if bearing[name].ndim > 1:
            views[name] = bearing[name][0]
    for name in BALL.names or ():
        views[name] = balls[name].swapaxes(0, 1) if name in OF_RACES else balls[name]
        if name in fields:
            views[name][...] = fields[name]
    arrays = {name: fields[name] for name in KernelData._fields[2:]}
    kernel = KernelData(bearing=bearing[0], balls=balls, **arrays)
    return EquationData(**fields | views | {"kernel": kernel})


def changed_data(data: EquationData, **fields: Any) -> EquationData:
    """`EquationData` with other values of some fields, in structured arrays of its own.

    Parameters
    ----------
    data : EquationData
        data of a simulation
    **fields : Any
        fields of `EquationData` that change

    Returns
    -------
    EquationData
        the changed data
    """
    return equation_data(**data._asdict() | fields)


class Layout:
    """Slices of the state vector of a bearing with Z balls."""

    def __init__(self, balls: int) -> None:
        self.balls = balls
        self.positions = BODIES + 3 * balls  # number of positions [-]
        # number of positions and velocities, the part under error control [-]
        self.mechanical = self.positions + BODIES + 6 * balls
        self.size = self.mechanical + 2 + balls + ACCUMULATORS  # of the state vector [-]
        # positions of ring (5), cage (6), outer ring (3), balls (3 Z), and their velocities
        self.ring = slice(0, RING)
        self.cage = slice(RING, SEAT)
        self.ball = slice(BODIES, self.positions)
        self.seat = slice(SEAT, SENSOR)  # outer ring
        self.ring_speed = slice(self.positions, self.positions + RING)
        self.cage_speed = slice(self.positions + RING, self.positions + SEAT)
        self.ball_speed = slice(self.positions + BODIES, 2 * self.positions)
        self.ball_turn = slice(2 * self.positions, self.mechanical)  # angular velocities, 3 Z
        self.ring_angle = self.mechanical  # place of the rotation of the inner ring
        self.outer_angle = self.mechanical + 1
        self.roll = slice(self.mechanical + 2, self.mechanical + 2 + balls)  # angles, Z
        self.energy = slice(self.size - ACCUMULATORS, self.size)  # work and dissipation
