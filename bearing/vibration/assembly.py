"""Numbers of the equations of motion from a bearing in equilibrium and what makes it vibrate:
arrays of the compiled equations, indices in the state, and laws of ball and race (Hertz, solved
films, linear springs).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi, sqrt
from typing import NamedTuple

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import contact_stiffness
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.options import SolverOptions
from oilfilm.ehl.traction.linear_response import NormalResponse, highest_frequency, normal_response

from ..contacts.contact import BearingContact
from ..dynamics.bodies import ring_body
from ..films.asperities import Asperities
from ..films.operating_film import OilAtInlets, supplied_films
from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from ..quasistatic.kinematics import ball_mass
from ..quasistatic.solution import QuasistaticSolution
from ..supply.supply import AMPLE, PrescribedInlet, Supply
from .form import FormBody, heights, hollow, rolled
from .inputs import ContactLaw, Direction, Sensor, Support, VibrationModel, WaveFilter
from .transmission import Transmission, dry_transmission, film_transmission, filtered

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

NODES = 600  # of a law, over the logarithm of the approach
SPAN = (1e-4, 30.0)  # of approaches, over that of the largest load [-]
HERTZ = 1.5  # exponent of the force
# loads over the largest of a race, at which films are solved; stiffness over that of Hertz and
# damping change by some per cent between them
SOLVED_LOADS = (0.2, 1.0)
POINTS = 129  # and half of them; damping of the 6208 within 1.5 % of that from 257
STARVED_POINTS = 257  # behind a layer, where the damping is small and feels the mesh

RACES = {Race.INNER: FormBody.INNER, Race.OUTER: FormBody.OUTER}
AXES = {Direction.X: 0, Direction.Y: 1, Direction.Z: 2}


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


class FilmsNotSolvedError(RuntimeError):
    """A film whose stiffness and damping could not be solved; the message says which."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedFilms:
    """Stiffness and damping of the contacts with one race, solved at some loads."""

    loads: Array  # [N]
    stiffness_ratio: Array  # over that of Hertz [-]
    damping: Array  # [N s/m]
    damping_uncertainty: Array  # [N s/m]
    frequency: float  # [Hz]
    film_share: float = 1.0  # of the load; the rest is on asperities, which damp nothing [-]


def mean_angle(solution: QuasistaticSolution, race: Race) -> float:
    """Contact angle of a race, mean over the balls by their loads.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway

    Returns
    -------
    float
        mean angle [rad]
    """
    inner = race is Race.INNER
    load = solution.inner_load if inner else solution.outer_load
    angle = solution.inner_contact_angle if inner else solution.outer_contact_angle
    return float(np.average(angle, weights=load)) if load.sum() > 0.0 else float(np.mean(angle))


def stiffness_factor(solution: QuasistaticSolution, race: Race) -> float:
    """K of Hertz' law Q = K d^1.5 at the load-weighted mean contact angle.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway

    Returns
    -------
    float
        K [N/m^1.5]
    """
    bearing = solution.bearing
    radii = reduced_radii(bearing, race, mean_angle(solution, race))
    return contact_stiffness(*radii, contact_modulus(bearing, race))


def heaviest(contacts: Sequence[BearingContact], race: Race) -> BearingContact:
    """The contact of a race with the largest load.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        contacts of the equilibrium
    race : Race
        raceway

    Returns
    -------
    BearingContact
        its most heavily loaded contact

    Raises
    ------
    ValueError
        if none is loaded
    """
    worst = max((c for c in contacts if c.race is race), key=lambda contact: contact.load)
    if not worst.load > 0.0:
        raise ValueError(f"no ball is loaded at the {race.value} race: nothing to vibrate on")
    return worst


def film_load_fractions(
    contacts: Sequence[BearingContact],
    asperities: Asperities,
    supply: Supply | PrescribedInlet | None,
    balls: int,
) -> dict[Race, float]:
    """Load that the film of the heaviest contact of each race carries, over its whole load.

    Parameters
    ----------
    contacts : sequence of BearingContact
        All contacts of the bearing.
    asperities : Asperities
        Roughness of the surfaces and the law by which asperities carry load.
    supply : Supply or PrescribedInlet or None
        Supply of oil that limits the films; None: flooded.
    balls : int
        Number of balls [-].

    Returns
    -------
    dict of Race to float
        Share of the film [-] of each race whose film a formula gives.
    """
    shares = {}
    for race in Race:
        contact = heaviest(contacts, race)
        oil = OilAtInlets(oil=supply or AMPLE, balls=balls)
        (film,) = supplied_films([contact], [None], oil)
        if film is not None:
            shares[race] = 1.0 - asperities.load_fraction(contact, film.central.value)
    return shares


def solved_films(
    contact: BearingContact, factor: float, frequency: float, options: SolverOptions | None = None
) -> SolvedFilms:
    """Response of a contact and of lighter ones at a frequency, or at the highest that a mesh
    carries.

    Parameters
    ----------
    contact : BearingContact
        contact of the equilibrium
    factor : float
        K of Hertz [N/m^1.5]
    frequency : float
        frequency of the response [Hz]
    options : SolverOptions | None, optional
        mesh of the films

    Returns
    -------
    SolvedFilms
        stiffness and damping at some loads

    Raises
    ------
    FilmsNotSolvedError
        if a film or its response is not solved
    """
    conditions = contact.conditions
    if conditions is None:
        raise FilmsNotSolvedError(f"{contact.race.value} race: {contact.note}")
    grid = options or SolverOptions(
        points=POINTS if conditions.inlet_layer is None else STARVED_POINTS
    )
    responses: list[tuple[float, float, NormalResponse]] = []
    for fraction in SOLVED_LOADS:
        lighter: ContactConditions = replace(conditions, load=fraction * conditions.load)
        at = min(frequency, highest_frequency(lighter))
        responses.append((lighter.load, at, normal_response(lighter, grid, (at,))))
        response = responses[-1][2]
        if not response.converged:
            where = f"film at the {contact.race.value} race under {lighter.load:.4g} N"
            raise FilmsNotSolvedError(f"{where}: {response.message}")
    loads = np.array([load for load, _, _ in responses])
    hertz = HERTZ * factor ** (2.0 / 3.0) * np.cbrt(loads)
    stiffness = np.array([response.stiffnesses[0].value for _, _, response in responses])
    # behind a layer it may be negative: bodies that close in feed the meniscus
    damping = np.array([response.dampings[0].value for _, _, response in responses])
    bars = np.array([response.dampings[0].uncertainty for _, _, response in responses])
    return SolvedFilms(
        loads=loads,
        stiffness_ratio=stiffness / hertz,
        damping=damping,
        damping_uncertainty=bars,
        frequency=min(at for _, at, _ in responses),
    )


def film_law(factor: float, films: SolvedFilms) -> ContactLawTable:
    """Law with the stiffness dQ/dd and the damping of solved films over the load.

    The damping of lighter contacts fades with the load.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    films : SolvedFilms
        solved films of the race

    Returns
    -------
    ContactLawTable
        law over the logarithm of the approach
    """
    largest = films.loads[-1]
    dry = (largest / factor) ** (2.0 / 3.0)
    loads = largest * np.geomspace(SPAN[0] ** HERTZ, SPAN[1] ** HERTZ, 4 * NODES)
    ratio = np.interp(np.log(loads), np.log(films.loads), films.stiffness_ratio)
    # d = integral of dQ/k, with the ratio constant between two loads
    hertz = (loads / factor) ** (2.0 / 3.0)
    steps = np.diff(hertz) * 0.5 * (1.0 / ratio[1:] + 1.0 / ratio[:-1])
    approach = hertz[0] / ratio[0] + np.concatenate([[0.0], np.cumsum(steps)])
    grid = np.geomspace(SPAN[0] * dry, SPAN[1] * dry, NODES)
    load = np.exp(np.interp(np.log(grid), np.log(approach), np.log(loads)))
    # damping negative at the one frequency is positive at those of balls: none, over time
    solved = np.maximum(films.damping, 0.0)
    damping = films.film_share * np.interp(np.log(load), np.log(films.loads), solved)
    damping *= np.minimum(load / films.loads[0], 1.0)
    return law_table(grid, load / grid**HERTZ, damping, HERTZ)


def dry_law(factor: float, largest: float, loss_time: float) -> ContactLawTable:
    """Hertz' law with a damping in proportion to its stiffness.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    largest : float
        largest load of the race [N]
    loss_time : float
        damping over stiffness [s]

    Returns
    -------
    ContactLawTable
        law over the logarithm of the approach
    """
    dry = (largest / factor) ** (2.0 / 3.0)
    grid = np.geomspace(SPAN[0] * dry, SPAN[1] * dry, NODES)
    damping = loss_time * HERTZ * factor * np.sqrt(grid)
    return law_table(grid, np.full(NODES, factor), damping, HERTZ)


def linear_law(factor: float, mean: float, largest: float, loss_time: float) -> ContactLawTable:
    """Spring k d with Hertz' stiffness k at the mean load of the loaded contacts.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    mean : float
        mean load [N]
    largest : float
        largest load of the race [N]
    loss_time : float
        damping over stiffness [s]

    Returns
    -------
    ContactLawTable
        law over the logarithm of the approach
    """
    stiffness = HERTZ * factor ** (2.0 / 3.0) * mean ** (1.0 / 3.0)
    grid = np.geomspace(SPAN[0], SPAN[1], NODES) * largest / stiffness
    damping = np.full(NODES, loss_time * stiffness)
    return law_table(grid, np.full(NODES, stiffness), damping, 1.0)


def law_table(approach: Array, factor: Array, damping: Array, exponent: float) -> ContactLawTable:
    """Law from its factor and damping at approaches even in their logarithm.

    The energy is the force's integral.

    Parameters
    ----------
    approach : Array
        approaches, shape (n,) [m]
    factor : Array
        elastic force over approach^n, shape (n,) [N/m^n]
    damping : Array
        shape (n,) [N s/m]
    exponent : float
        n [-]

    Returns
    -------
    ContactLawTable
        law for the kernels
    """
    logs = np.log(approach)
    power = exponent + 1.0
    slope = np.diff(factor) / np.diff(logs)
    edges = approach**power
    # integral of (f + s (u - u_0)) e^(p u) du = [(f/p - s/p^2) e^(p u)]
    upper = (factor[1:] / power - slope / power**2) * edges[1:]
    lower = (factor[:-1] / power - slope / power**2) * edges[:-1]
    energy = factor[0] / power * edges[0] + np.concatenate([[0.0], np.cumsum(upper - lower)])
    return ContactLawTable(
        first=float(logs[0]),
        step=float(logs[1] - logs[0]),
        table=np.ascontiguousarray(np.stack([factor, damping, energy / edges], axis=1)),
        exponent=exponent,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Assembled:
    """Numbers of the equations, and what was solved for them."""

    arrays: VibrationArrays
    films: dict[Race, SolvedFilms]  # none with other laws
    transmissions: dict[Race, Transmission]  # none without a filter
    stiffness: dict[Race, float]  # of the heaviest contacts, after Hertz [N/m]
    cage_speed: float  # [rad/s]
    ball_speed: float  # of a ball about its axis against the cage [rad/s]


def track_radius(bearing: Bearing, race: Race, contact_angle: float) -> float:
    """Radius at which balls roll on a race, d_m/2 -+ D/2 cos(angle).

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    race : Race
        raceway
    contact_angle : float
        contact angle [rad]

    Returns
    -------
    float
        radius [m]
    """
    side = -1.0 if race is Race.INNER else 1.0
    return 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(contact_angle))


def assembled(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], model: VibrationModel
) -> Assembled:
    """The equations of a bearing, SI.

    The films of its contacts are solved if the model asks for them; with the oil at their inlet if
    their conditions have a layer, except for the transmission of waves.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        its contacts
    model : VibrationModel
        form of the surfaces, supports and options

    Returns
    -------
    Assembled
        numbers of the equations, and the films solved for them

    Raises
    ------
    ValueError
        if dimensions are missing, a wave is too short for the record, or nothing turns
    FilmsNotSolvedError
        if a film is not solved
    """
    _check(solution, model)
    films: dict[Race, SolvedFilms] = {}
    laws: dict[Race, ContactLawTable] = {}
    transmissions: dict[Race, Transmission] = {}
    stiffness: dict[Race, float] = {}
    frequency = resonance(solution, model.support)
    for race in RACES:
        factor = stiffness_factor(solution, race)
        contact = heaviest(contacts, race)
        stiffness[race] = 1.5 * factor ** (2.0 / 3.0) * contact.load ** (1.0 / 3.0)
        if model.options.law is ContactLaw.FILM:
            films[race] = solved_films(contact, factor, frequency)
            films[race] = replace(films[race], film_share=model.film_load_fractions.get(race, 1.0))
            laws[race] = film_law(factor, films[race])
        else:
            laws[race] = _other_law(solution, race, factor, model)
        if model.options.wave_filter is not WaveFilter.NONE:
            assert contact.hertz is not None  # it is loaded
            along = contact.hertz.semi_axis_x
            transmissions[race] = dry_transmission(along)
            uneven = not (model.form.is_even(RACES[race]) and model.form.is_even(FormBody.BALL))
            if model.options.wave_filter is WaveFilter.FILM and uneven:
                assert contact.conditions is not None  # its film was solved
                shortest = _largest_number(solution, model, race, along)
                grid = SolverOptions(points=POINTS, certify=False)
                flooded = replace(contact.conditions, inlet_layer=None)
                transmissions[race] = film_transmission(flooded, along, shortest, grid)
    cage = solution.cage_speed
    cage -= model.options.cage_slip * (cage - solution.operation.outer_speed)
    loaded = solution.inner_load > 0.0
    ball = float(np.mean(solution.spin_speed[loaded] if loaded.any() else solution.spin_speed))
    arrays = _arrays(solution, model, laws, transmissions, (cage, ball))
    return Assembled(
        arrays=arrays,
        films=films,
        transmissions=transmissions,
        stiffness=stiffness,
        cage_speed=cage,
        ball_speed=ball,
    )


def resonance(solution: QuasistaticSolution, support: Support) -> float:
    """Frequency of the inner ring on its balls in the radial direction of the load.

    That of the outer ring if the inner one is fixed.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    support : Support
        supports of the rings

    Returns
    -------
    float
        frequency [Hz]
    """
    mass = _masses(solution.bearing, support)[0 if not support.inner_ring_fixed else OUTER]
    return sqrt(float(solution.stiffness[1, 1]) / mass) / (2.0 * pi)


def _check(solution: QuasistaticSolution, model: VibrationModel) -> None:
    if len(solution.rows) > 1:
        raise ValueError("rows: vibration takes one row of balls")
    operation = solution.operation
    if operation.shaft_speed == 0.0:
        raise ValueError("inner_speed: nothing turns, so nothing vibrates")
    if not _free(solution, model.support).any():
        raise ValueError(
            "displacement: is given in all directions, and the outer ring stands still"
        )
    limit = 0.5 * model.options.sample_rate
    numbers = [wave.ball for wave in model.form.waves.get(FormBody.BALL, ())]
    numbers += [defect.ball for defect in model.form.defects_of(FormBody.BALL)]
    balls = solution.bearing.balls
    if max(numbers, default=0) > balls:
        raise ValueError(f"ball: {max(numbers)} is given a form, but there are {balls} balls")
    if len(model.form.ball_diameters) not in (0, balls):
        count = len(model.form.ball_diameters)
        raise ValueError(f"ball_diameters: {count} values for {balls} balls")
    _check_orders(solution, model, limit)


def _check_orders(solution: QuasistaticSolution, model: VibrationModel, limit: float) -> None:
    """Every wave passes a contact at most at half the sample rate, the limit [Hz]."""
    operation = solution.operation
    cage = solution.cage_speed
    rates = {
        FormBody.INNER: abs(operation.inner_speed - cage),
        FormBody.OUTER: abs(cage - operation.outer_speed),
        FormBody.BALL: float(np.abs(solution.spin_speed).mean()),
    }
    for place, waves in model.form.waves.items():
        order = max((wave.order for wave in waves), default=0)
        passing = order * rates[place] / (2.0 * pi)
        if passing > limit:
            raise ValueError(
                f"order: {order} of the {place.value} passes at {passing:.5g} Hz, more than half "
                f"of the sample rate, {limit:.5g} Hz"
            )


def _other_law(
    solution: QuasistaticSolution, race: Race, factor: float, model: VibrationModel
) -> ContactLawTable:
    load = solution.inner_load if race is Race.INNER else solution.outer_load
    largest = float(load.max())
    if model.options.law is ContactLaw.DRY:
        return dry_law(factor, largest, model.options.loss_time)
    mean = float(load[load > 0.0].mean())
    return linear_law(factor, mean, largest, model.options.loss_time)


def _largest_number(
    solution: QuasistaticSolution, model: VibrationModel, race: Race, along: float
) -> float:
    """k a of the shortest wave that matters: given, or half the sample rate for profiles [-]."""
    radius = track_radius(solution.bearing, race, mean_angle(solution, race))
    ball_radius = 0.5 * solution.bearing.ball_diameter
    waves = model.form.waves.get(RACES[race], ())
    numbers = [wave.order * along / radius for wave in waves]
    numbers += [w.order * along / ball_radius for w in model.form.waves.get(FormBody.BALL, ())]
    if model.form.profiles or model.form.defects:
        conditions_speed = abs(solution.operation.shaft_speed) * radius
        numbers.append(pi * model.options.sample_rate * along / max(0.5 * conditions_speed, 1e-9))
    return max(numbers, default=0.0)


def _arrays(
    solution: QuasistaticSolution,
    model: VibrationModel,
    laws: dict[Race, ContactLawTable],
    transmissions: dict[Race, Transmission],
    speeds: tuple[float, float],
) -> VibrationArrays:
    bearing = solution.bearing
    operation = solution.operation
    cage, ball = speeds
    mass = ball_mass(bearing.ball_diameter, bearing.ball_material.density)
    support = model.support
    excess = np.zeros(bearing.balls)
    if model.form.ball_diameters:
        excess = 0.5 * np.array(model.form.ball_diameters)
    load = np.zeros(SENSOR)
    load[INNER:OUTER] = [*solution.ring_force, *solution.ring_moment]
    load[OUTER:SENSOR] = -solution.ring_force
    radial = support.seat_stiffness or 0.0
    axial = radial if support.seat_axial_stiffness is None else support.seat_axial_stiffness
    inertia = _masses(bearing, support)
    return VibrationArrays(
        balls=bearing.balls,
        azimuth=np.ascontiguousarray(solution.azimuth),
        speeds=np.array([operation.inner_speed, operation.outer_speed, cage, ball]),
        start_ratio=model.options.start_speed_ratio,
        duration=model.options.duration,
        inner_centre_radius=bearing.inner_centre_radius,
        outer_centre_radius=bearing.outer_centre_radius,
        inner_length=bearing.inner_groove_radius - 0.5 * bearing.ball_diameter,
        outer_length=bearing.outer_groove_radius - 0.5 * bearing.ball_diameter,
        ball_excess=excess,
        inner_law=laws[Race.INNER],
        outer_law=laws[Race.OUTER],
        inner_height=_ring_heights(solution, model, Race.INNER, transmissions),
        outer_height=_ring_heights(solution, model, Race.OUTER, transmissions),
        ball_height=_ball_heights(solution, model, transmissions),
        mass=inertia[:BALLS],
        free=_free(solution, support),
        polar_inertia=float(inertia[BALLS]),
        load=load,
        seat_stiffness=np.array([axial, radial, radial]),
        seat_damping=support.seat_damping,
        sensor=_sensor(support.sensor),
        ball_mass=mass,
        centrifugal_force=0.5 * mass * bearing.pitch_diameter * cage**2,
    )


def _masses(bearing: Bearing, support: Support) -> Array:
    """Masses of the nine coordinates and the inner ring's polar inertia [kg], [kg m^2]."""
    masses = np.ones(BALLS + 1)
    if not support.inner_ring_fixed:
        ring = ring_body(bearing)
        masses[INNER:OUTER] = ring.mass + support.shaft_mass
        masses[INNER + 3 : OUTER] = ring.transverse_inertia
        masses[BALLS] = ring.polar_inertia
    if support.outer_moves:
        masses[OUTER:SENSOR] = _outer_mass(bearing, support) + support.housing_mass
    if support.sensor is not None:
        masses[SENSOR] = support.sensor.mass
    return masses


def _outer_mass(bearing: Bearing, support: Support) -> float:
    """Mass of the outer ring [kg]: prescribed, or that of a cylinder outside of its groove."""
    if support.outer_mass is not None:
        return support.outer_mass
    if bearing.outside_diameter is None or bearing.width is None:
        raise ValueError("outside_diameter and width are needed for the mass of the outer ring")
    inside = bearing.outer_centre_radius + bearing.outer_groove_radius
    section = pi * (0.25 * bearing.outside_diameter**2 - inside**2)
    if not section > 0.0:
        raise ValueError("outside_diameter leaves no outer ring around its groove")
    return bearing.outer_ring_material.density * section * bearing.width


def _free(solution: QuasistaticSolution, support: Support) -> Array:
    free = np.zeros(BALLS)
    if not support.inner_ring_fixed:
        loaded = [load is not None for load in solution.operation.loads]
        free[INNER:OUTER] = loaded
    if support.outer_moves:
        free[OUTER:SENSOR] = 1.0
    if support.sensor is not None:
        free[SENSOR] = 1.0
    return free


def _sensor(sensor: Sensor | None) -> Array:
    """Stiffness [N/m], damping [N s/m], axis."""
    if sensor is None:
        return np.array([0.0, 0.0, 1.0])
    omega = 2.0 * pi * sensor.frequency
    damping = 2.0 * sensor.damping_ratio * sensor.mass * omega
    return np.array([sensor.mass * omega**2, damping, float(AXES[Direction.Y])])


def _entering(profile: Array, transmission: Transmission | None, radius: float) -> Array:
    return profile if transmission is None else filtered(profile, transmission, radius)


def _ring_heights(
    solution: QuasistaticSolution,
    model: VibrationModel,
    race: Race,
    transmissions: dict[Race, Transmission],
) -> Array:
    """Form of a race as it enters the bearing [m]."""
    place = RACES[race]
    if model.form.is_even(place):
        return np.zeros(2)
    angle = mean_angle(solution, race)
    radius = track_radius(solution.bearing, race, angle)
    profile = heights(model.form, place)
    for defect in model.form.defects_of(place):
        profile = profile - hollow(defect, radius)
    along = reduced_radii(solution.bearing, race, angle)[0]
    return _entering(rolled(profile, radius, along), transmissions.get(race), radius)


def _ball_heights(
    solution: QuasistaticSolution, model: VibrationModel, transmissions: dict[Race, Transmission]
) -> Array:
    """Form of the balls as it enters at the inner and the outer race, shape (2, 1 or Z, n) [m];
    one of all balls where they are alike.
    """
    bearing = solution.bearing
    form = model.form
    if form.is_even(FormBody.BALL):
        return np.zeros((2, 1, 2))
    radius = 0.5 * bearing.ball_diameter
    equal = not form.defects_of(FormBody.BALL)
    equal &= all(wave.ball == 0 for wave in form.waves.get(FormBody.BALL, ()))
    rows = [
        heights(form, FormBody.BALL, ball + 1) for ball in range(1 if equal else bearing.balls)
    ]
    for defect in form.defects_of(FormBody.BALL):
        rows[defect.ball - 1] -= hollow(defect, radius)
    both = []
    for race in RACES:
        along = reduced_radii(bearing, race, mean_angle(solution, race))[0]
        transmission = transmissions.get(race)
        both.append([_entering(rolled(row, radius, along), transmission, radius) for row in rows])
    return np.array(both)
