"""Arrays of the compiled equations of motion from bearing, operation and model, and the numbers of
the model in closed form: normal contact, drag of a ball, speed of the cage.
"""

from math import pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.film import film_nijenbanning_central
from oilfilm.ehl.closed_form.hertz import contact_stiffness, hertz_contact
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.traction.friction_coefficients import RampedCoulomb

from ..films.unsolved_films import film_lag
from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from ..material import reduced_modulus
from ..operation import Operation
from ..quasistatic.kinematics import ball_mass
from ..quasistatic.solution import kinematic_cage_speed
from .arrays import (
    BODIES,
    CAGE,
    CAGE_ROTATION,
    EXPONENT,
    FILM,
    FILM_LOAD,
    FILM_RATE,
    INNER_SPEED,
    NORMAL_COLUMNS,
    OUTER,
    OUTER_SPEED,
    POCKET_COLUMNS,
    PRESCRIBED_FORCE,
    PRESCRIBED_MOMENT,
    RING,
    RING_TILT,
    SEAT,
    STIFFNESS,
    TABLE,
    Constants,
    EquationData,
    FrictionData,
    Layout,
    changed_data,
    equation_data,
)
from .bodies import SENSOR_AXIS, free_coordinates, free_support, outer_ring_mass
from .choices import Guidance, LoadType, NormalLaw, RaceStiffness
from .friction import check_film
from .initial import StartingPoint
from .inputs import CageBody, DynamicsModel, Guide, Settling, Surfaces
from .reduction import solved_indices
from .support import Support

HERTZ_EXPONENT = 1.5
REFERENCE_LOAD = 10.0  # least load that sets the scale of errors [N]
RAMP_SHARE = 0.01  # of the ramp of the friction that an error of speed may make up [-]
# fraction of the entrainment that it may make up, over the tolerance: a bearing at 1 r/min closed
# its energies to 0.1 of the work without it, to 3e-4 with it [-]
ROLLING_SHARE = 3.0
# friction that follows the entrainment reverses, in a bearing that comes to rest, over at least
# this part of its fastest entrainment, up to the speed of Coulomb's ramp: at rest it would jump
REST_SHARE = 1.0e-2  # [-]
REST_BAND = RampedCoulomb.slide_full  # [m/s]
NO_CAGE = CageBody(
    mass=1.0, polar_inertia=1.0, transverse_inertia=1.0, pocket_clearance=1.0, pocket_stiffness=1.0
)


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


def vibration_frequency(
    stiffness: float, load: float, mass: float, exponent: float = HERTZ_EXPONENT
) -> float:
    """Angular frequency of a ball between two races, sqrt(2 k/m) with k = n K^(1/n) Q^(1 - 1/n).

    Parameters
    ----------
    stiffness : float
        K [N/m^n]
    load : float
        Q [N]
    mass : float
        m of the ball [kg]
    exponent : float, optional
        n [-]

    Returns
    -------
    float
        angular frequency [rad/s]
    """
    slope = exponent * load / (load / stiffness) ** (1.0 / exponent)
    return sqrt(2.0 * slope / mass)


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


def assemble(
    bearing: Bearing, operation: Operation, model: DynamicsModel, point: StartingPoint
) -> EquationData:
    """The problem in numbers; stiffnesses are taken at the contact angles of the start.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds and loads
    model : DynamicsModel
        cage, contact laws, schedule and options
    point : StartingPoint
        equations, contact angles and equilibrium of the start

    Returns
    -------
    EquationData
        arrays of the compiled equations, SI
    """
    cage = model.cage
    n = bearing.balls
    free = free_array(point.kind, operation, model)
    indices = solved_indices(free, n)
    azimuth = bearing.first_ball_azimuth + 2.0 * pi / n * np.arange(n)
    numbers = constants(bearing, model)
    schedule = schedule_array(operation, model)
    laws = normal_laws(bearing, model, point.angles)
    if model.race_laws is not None:
        laws[: OUTER + 1] = model.race_laws
    elif model.oil is not None and model.normal.law is not NormalLaw.HERTZ:
        for race, angle, law in zip(Race, point.angles, laws, strict=False):
            load = reference_load(schedule, numbers, n)
            law[FILM_RATE : FILM_LOAD + 1] = film_damping(
                bearing, race, angle, load, model.oil, schedule
            )
    races = _race_frictions(bearing, model, schedule)
    if cage is not None and cage.guidance is Guidance.BALLS:  # else nothing would centre it
        numbers = numbers._replace(pocket_circle=0.5 * bearing.pitch_diameter)
    if model.support.outer_moves and point.equilibrium is not None:
        balanced = -point.equilibrium.ring_force
        numbers = numbers._replace(outer_load=tuple(balanced.tolist()))
    none = np.zeros(2)
    surfaces = model.surfaces or Surfaces(
        inner=none, outer=none, balls=np.zeros((2, 1, 2)), excess=np.zeros(n), even=True
    )
    return equation_data(
        constants=numbers,
        normal=laws,
        friction_kind=friction_kind(model, races, laws),
        friction_inner=races[0],
        friction_outer=races[1],
        free=free,
        constrained=np.array([load is None for load in operation.loads], dtype=np.float64),
        pocket_angle=np.asarray(azimuth),
        pocket_direction=np.stack((np.cos(azimuth), np.sin(azimuth)), axis=1),
        pocket_play=0.5 * np.array((cage or NO_CAGE).clearances(n)),
        excess=surfaces.excess,
        inner_form=surfaces.inner,
        outer_form=surfaces.outer,
        ball_form=surfaces.balls,
        times=np.array(model.times, dtype=np.float64),
        schedule=schedule,
        impact_speeds=np.full(3 * n + 2, model.normal.impact_floor),
        land_out=np.full((2, POCKET_COLUMNS), -1.0),
        solved=indices,
        mechanical=_mechanical(indices, n),
        full_state=np.zeros(Layout(n).size),
        rates=np.zeros(Layout(n).size),
    )


def _race_frictions(bearing: Bearing, model: DynamicsModel, schedule: Array) -> list[FrictionData]:
    rest = rest_band(schedule, 0.5 * bearing.pitch_diameter)
    return [model.friction.data(race, rest) for race in Race]


def schedule_array(operation: Operation, model: DynamicsModel) -> Array:
    """`EquationData.schedule`: a row for each time of the model.

    Parameters
    ----------
    operation : Operation
        speeds and loads without a schedule
    model : DynamicsModel
        model with its schedule

    Returns
    -------
    Array
        rows, shape (n, PRESCRIBED_COLUMNS) [SI]
    """
    displacements = model.places(operation)
    rates = np.zeros_like(displacements)
    if model.schedule is not None and model.schedule.rates is not None:
        rates = np.array(model.schedule.rates)
    rows = np.array(model.rows(operation))
    guide = model.guide or Guide(speed=0.0, roll=0.0)
    turning = rows[:, INNER_SPEED] - rows[:, OUTER_SPEED]
    others = [
        model.viscosities,
        rows[:, OUTER_SPEED] + guide.speed * turning,
        guide.roll * turning,
        np.ones(len(rows)),
    ]
    return np.hstack([rows, displacements, rates, np.stack(others, axis=1)])


def entrainment_speeds(schedule: Array, pitch_radius: float) -> Array:
    """Entrainment speeds of rolling balls at the times of a schedule, signed.

    Half of the speed of the rings against each other on the pitch circle.

    Parameters
    ----------
    schedule : Array
        `EquationData.schedule` [SI]
    pitch_radius : float
        radius of the pitch circle [m]

    Returns
    -------
    Array
        speeds, shape (n,) [m/s]
    """
    speeds: Array = 0.5 * pitch_radius * (schedule[:, INNER_SPEED] - schedule[:, OUTER_SPEED])
    return speeds


def rest_band(schedule: Array, pitch_radius: float) -> float:
    """Least sliding speed over which friction reverses, if the rings stop against each other.

    Parameters
    ----------
    schedule : Array
        `EquationData.schedule` [SI]
    pitch_radius : float
        radius of the pitch circle [m]

    Returns
    -------
    float
        speed; zero if the rings never stop against each other [m/s]
    """
    speeds = entrainment_speeds(schedule, pitch_radius)
    fastest = float(np.abs(speeds).max())
    if fastest == 0.0:
        return REST_BAND
    at_rest = speeds.min() <= REST_SHARE * fastest and speeds.max() >= -REST_SHARE * fastest
    return min(REST_BAND, REST_SHARE * fastest) if at_rest else 0.0


def free_array(kind: LoadType, operation: Operation, model: DynamicsModel) -> Array:
    """`EquationData.free` of a load type: 1 or 0 for the coordinates of ring, cage and a ball.

    Parameters
    ----------
    kind : LoadType
        equations of motion
    operation : Operation
        prescribed loads and displacements
    model : DynamicsModel
        model with or without a cage

    Returns
    -------
    Array
        free coordinates, shape (17,) [-]
    """
    ring, cage, ball = free_coordinates(kind, operation)
    if model.cage is None:
        cage = (0,) * CAGE
    if model.support.inner_ring_fixed:
        ring = (0,) * RING
    if model.guide is not None:
        ball = (*ball[:3], 0, 0, 0)
    outer = free_support(kind, model.support)
    return np.array([*ring, *cage, *outer, *ball], dtype=np.float64)


def with_equations(
    data: EquationData, kind: LoadType, operation: Operation, model: DynamicsModel
) -> EquationData:
    """The problem with the coordinates that another load type lets move.

    Parameters
    ----------
    data : EquationData
        problem in numbers
    kind : LoadType
        equations of motion
    operation : Operation
        prescribed loads and displacements
    model : DynamicsModel
        model of the simulation

    Returns
    -------
    EquationData
        changed problem, which shares its arrays with `data`
    """
    free = free_array(kind, operation, model)
    indices = solved_indices(free, data.constants.balls)
    mechanical = _mechanical(indices, data.constants.balls)
    return changed_data(data, free=free, solved=indices, mechanical=mechanical)


def _mechanical(indices: NDArray[np.int64], balls: int) -> int:
    """How many of the solved places are none of the accumulators [-]."""
    layout = Layout(balls)
    return int(indices.size - (layout.size - layout.mechanical))


def friction_kind(model: DynamicsModel, races: list[FrictionData], laws: Array) -> int:
    """Code of the friction for the kernels.

    Parameters
    ----------
    model : DynamicsModel
        model with its friction
    races : list[FrictionData]
        friction of inner and outer race
    laws : Array
        normal laws, shape (4, NORMAL_COLUMNS)

    Returns
    -------
    int
        FRICTIONLESS, COEFFICIENT, TABLE or FILM

    Raises
    ------
    ValueError
        if a lubricated contact has no table, or its load does not rise with the approach
        (`check_film`)
    """
    if model.normal.law is not NormalLaw.LUBRICATED:
        return model.friction.kind
    if model.friction.kind != TABLE:
        raise ValueError(
            "normal: a lubricated contact needs traction tables, which hold its film and damping"
        )
    for race, data, law in zip(Race, races, laws, strict=False):
        if data.table is not None:
            check_film(data.table, law, race.value)
    return FILM


def constants(bearing: Bearing, model: DynamicsModel) -> Constants:
    """Numbers of ball, ring, cage, lands, drag and weight.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    model : DynamicsModel
        ring, cage and options

    Returns
    -------
    Constants
        numbers [SI]
    """
    cage = model.cage or NO_CAGE
    ring = model.ring
    radius = 0.5 * bearing.ball_diameter
    mass = ball_mass(bearing.ball_diameter, bearing.ball_material.density)
    return Constants(
        balls=bearing.balls,
        symmetric_copies=1,
        mirrored=0,
        ball_mass=mass,
        ball_inertia=0.4 * mass * radius**2,
        ball_radius=radius,
        inner_centre=bearing.inner_centre_radius,
        outer_centre=bearing.outer_centre_radius,
        inner_groove=bearing.inner_groove_radius,
        outer_groove=bearing.outer_groove_radius,
        ring_mass=ring.mass + model.support.shaft_mass,
        ring_transverse=ring.transverse_inertia,
        ring_polar=ring.polar_inertia,
        ring_damping=ring.damping,
        unbalance=ring.unbalance,
        unbalance_phase=ring.unbalance_phase,
        **_rotating_numbers(model),
        **_cage_numbers(cage, bearing.balls),
        cage_mass=0.0 if model.cage is None else cage.mass,
        ball_friction=model.ball_friction,
        friction_ramp=model.friction_ramp,
        film_viscosity=model.film_viscosity,
        drag=model.options.drag,
        gravity=model.options.gravity,
        floor=model.normal.impact_floor,
        guided=0 if model.guide is None else 1,
        **_support_numbers(bearing, model.support),
        **_settling_numbers(model),
    )


def _support_numbers(bearing: Bearing, support: Support) -> dict[str, Any]:
    """Numbers of the outer ring on its seat, and of the sensor on it [SI]."""
    radial = support.seat_stiffness or 0.0
    axial = radial if support.seat_axial_stiffness is None else support.seat_axial_stiffness
    numbers = {
        "outer_mass": outer_ring_mass(bearing, support) if support.outer_moves else 1.0,
        "outer_load": (0.0, 0.0, 0.0),
        "seat_stiffness": (axial, radial, radial),
        "seat_damping": support.seat_damping,
        "sensor_mass": 0.0,
        "sensor_axis": SENSOR_AXIS,
        "sensor_stiffness": 0.0,
        "sensor_damping": 0.0,
    }
    if support.sensor is None:
        return numbers
    sensor = support.sensor
    omega = 2.0 * pi * sensor.frequency
    return numbers | {
        "sensor_mass": sensor.mass,
        "sensor_stiffness": sensor.mass * omega**2,
        "sensor_damping": 2.0 * sensor.damping_ratio * sensor.mass * omega,
    }


def _settling_numbers(model: DynamicsModel) -> dict[str, Any]:
    """Numbers of the time before zero [SI]."""
    s = model.settling or Settling(time=0.0, growth=0.0, damped=0.0, rate=0.0)
    return {
        "form_gain": 1.0 / s.growth if s.growth > 0.0 else 0.0,
        "settling_rate": s.rate,
        "settling_start": -s.time,
        "settling_end": s.damped - s.time,
    }


def _rotating_numbers(model: DynamicsModel) -> dict[str, Any]:
    """Numbers of the rotating load [SI]."""
    load = model.rotating
    numbers = (0.0, 0.0, 0.0) if load is None else (load.force, load.speed, load.phase)
    return dict(zip(("rotating_force", "rotating_speed", "rotating_phase"), numbers, strict=True))


def _cage_numbers(cage: CageBody, balls: int) -> dict[str, Any]:
    """Numbers of the cage, its pockets and lands [SI]."""
    return {
        "cage_transverse": cage.transverse_inertia,
        "cage_polar": cage.polar_inertia,
        "cage_drag": cage.drag,
        "cage_unbalance": cage.unbalance,
        "pocket_play": 0.5 * min(cage.clearances(balls)),
        "pocket_circle": 0.0,
        "pocket_friction": cage.pocket_friction,
        "pocket_height": cage.pocket_height,
        "film_least": cage.film_least,
        "guide": tuple(Guidance).index(cage.guidance),
        "land_radius": cage.land_radius,
        "land_clearance": cage.land_clearance,
        "land_width": cage.land_width,
        "land_offset": cage.land_offset,
        "land_friction": cage.land_friction,
    }


def normal_laws(bearing: Bearing, model: DynamicsModel, angles: tuple[float, float]) -> Array:
    """Stiffness, exponent and damping of races, pocket and land; without films.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    model : DynamicsModel
        contact laws and cage
    angles : tuple[float, float]
        mean contact angles, inner and outer [rad]

    Returns
    -------
    Array
        laws, shape (4, NORMAL_COLUMNS) [SI]
    """
    normal = model.normal
    cage = model.cage or NO_CAGE
    chi = damping_factor(normal.law, normal.restitution)
    rows = []
    prescribed = (normal.inner_stiffness, normal.outer_stiffness)
    for race, angle, stiffness in zip(Race, angles, prescribed, strict=True):
        radii = reduced_radii(bearing, race, angle)
        hertz = contact_stiffness(*radii, contact_modulus(bearing, race))
        rows.append((stiffness or hertz, HERTZ_EXPONENT, chi))
    # a lubricated race leaves pocket and land to Lankarani and Nikravesh's law
    other_law = NormalLaw.LANKARANI_NIKRAVESH if normal.law is NormalLaw.LUBRICATED else normal.law
    other = damping_factor(other_law, normal.restitution)
    pocket = (cage.pocket_stiffness, HERTZ_EXPONENT, other)
    if model.cage is None:  # balls meet each other
        material = bearing.ball_material
        radius = 0.25 * bearing.ball_diameter
        pair = contact_stiffness(radius, radius, reduced_modulus(material, material))
        pocket = (pair, HERTZ_EXPONENT, other)
    laws = np.zeros((len(rows) + 2, NORMAL_COLUMNS))
    laws[:, :FILM_RATE] = [*rows, pocket, (cage.land_stiffness, 1.0, other)]
    laws[:, FILM_LOAD] = 1.0
    return laws


def reference_load(schedule: Array, numbers: Constants, balls: int) -> float:
    """Largest load over the number of balls, at least `REFERENCE_LOAD`.

    Parameters
    ----------
    schedule : Array
        `EquationData.schedule` [SI]
    numbers : Constants
        numbers of the bearing
    balls : int
        number of balls [-]

    Returns
    -------
    float
        load of a ball [N]
    """
    forces = schedule[:, PRESCRIBED_FORCE:PRESCRIBED_MOMENT]
    largest = float(np.linalg.norm(forces, axis=1).max()) + numbers.rotating_force
    return max(REFERENCE_LOAD, largest / balls)


def film_damping(
    bearing: Bearing, race: Race, angle: float, load: float, oil: Lubricant, schedule: Array
) -> tuple[float, float]:
    """Damping of the film of a rolling ball at slow movement, estimated (`film_lag`), and the
    load below which it fades.

    It changes little with the load, so one number stands for all; it fades in proportion to
    lighter loads, whose bodies give way by less than their film is thick.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    race : Race
        raceway
    angle : float
        contact angle [rad]
    load : float
        Q of a ball [N]
    oil : Lubricant
        oil at its temperature
    schedule : Array
        `EquationData.schedule`, whose fastest entrainment counts [SI]

    Returns
    -------
    damping
        c [N s/m]; zero where nothing turns
    least
        load [N]
    """
    gamma = bearing.ball_diameter / bearing.pitch_diameter * np.cos(angle)
    speeds = entrainment_speeds(schedule, 0.5 * bearing.pitch_diameter)
    speed = float(np.abs(speeds).max()) * (1.0 - gamma**2)
    radii = reduced_radii(bearing, race, angle)
    modulus = contact_modulus(bearing, race)
    if speed == 0.0:
        return 0.0, 1.0
    contact = ContactConditions(
        load=load,
        radius_x=radii[0],
        radius_y=radii[1],
        reduced_modulus=modulus,
        entrainment_speed=speed,
        lubricant=oil,
    )
    film = film_nijenbanning_central(contact)
    hertz = hertz_contact(load, *radii, modulus)
    stiffness = HERTZ_EXPONENT * load / hertz.approach
    damping = film_lag(contact, hertz) * stiffness**2
    return damping, load * (film / hertz.approach) ** HERTZ_EXPONENT


def scales(data: EquationData, load: float, model: DynamicsModel) -> Array:
    """Size of a coordinate's and a speed's error that counts as one.

    Lengths: a fraction of the approach of a ball on a race under a load; speeds: the same fraction
    of that of the vibration with this amplitude, but no more than a fraction of the ramp of the
    friction or, if friction follows the entrainment, of the fastest one; angles of bodies: over
    the pitch radius, of balls: over their radius.

    Parameters
    ----------
    data : EquationData
        problem in numbers
    load : float
        reference load [N]
    model : DynamicsModel
        tolerance and friction

    Returns
    -------
    Array
        sizes, shape (mechanical,) [m], [rad], [m/s], [rad/s]
    """
    tolerance = model.options.tolerance
    lengths = [
        (load / law[STIFFNESS]) ** (1.0 / law[EXPONENT]) for law in data.normal[: OUTER + 1]
    ]
    length = float(max(lengths))
    speed = length * np.sqrt(2.0 * HERTZ_EXPONENT * load / length / data.constants.ball_mass)
    pitch = 0.5 * (data.constants.inner_centre + data.constants.outer_centre)
    n = 3 * data.constants.balls
    ring = [1.0] * RING_TILT + [1.0 / pitch] * (RING - RING_TILT)
    cage = [1.0] * CAGE_ROTATION + [1.0 / pitch] * (CAGE - CAGE_ROTATION)
    positions = np.array([*ring, *cage, *[1.0] * (BODIES - SEAT), *[1.0] * n])
    turn = np.full(n, 1.0 / data.constants.ball_radius)
    speed = min(tolerance * speed, RAMP_SHARE * model.friction.ramp)
    fastest = float(np.abs(entrainment_speeds(data.schedule, pitch)).max())
    if model.friction.follows_entrainment and fastest > 0.0:
        speed = min(speed, ROLLING_SHARE * tolerance * fastest)
    return np.concatenate([tolerance * length * positions, speed * positions, speed * turn])
