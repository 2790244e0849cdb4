"""Contributions to the equations of motion (`dynamics`) from what makes a bearing vibrate: heights
of the surfaces as they enter the contacts, and laws of ball and race (Hertz, solved films, linear
springs).

Fraction of a waviness that moves the bodies.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import pi, sqrt

import numpy as np
import scipy
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import contact_stiffness
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.options import SolverOptions
from oilfilm.ehl.traction.linear_response import (
    NormalResponse,
    highest_frequency,
    normal_response,
    wave_transmission,
)

from ..contacts.contact import BearingContact
from ..dynamics.arrays import HEAVY_LOAD, KNOT_COUNT, NORMAL_COLUMNS
from ..dynamics.bodies import outer_ring_mass, ring_body
from ..dynamics.inputs import Surfaces
from ..dynamics.support import Support
from ..films.asperities import Asperities
from ..films.operating_film import supplied_films
from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from ..quasistatic.solution import QuasistaticSolution
from ..supply.inlet_oil import OilAtInlets
from .form import FormBody, SurfaceForm, heights, hollow, rolled
from .inputs import ContactLaw, VibrationModel, WaveFilter

STEP = 0.8  # of k a at most, between waves that are solved; splines between them
LEAST = 3  # waves that are solved at least
KEPT = 64  # films of which response and waves are kept: records of one state are many
FASTEST = 4.0  # k a beyond which the dry part counts: less than a quarter of a wave is left there


@dataclass(frozen=True, slots=True, kw_only=True)
class Transmission:
    """Part of waves that enters the bearing, complex, over k a; without samples the dry one."""

    semi_axis: float  # a, along the rolling direction [m]
    numbers: Array  # k a, from zero [-]
    parts: NDArray[np.complex128]  # [-]

    def of(self, orders: Array, radius: float) -> NDArray[np.complex128]:
        """Transmission of orders around a track.

        Parameters
        ----------
        orders : Array
            waves over a turn, shape (n,) [-]
        radius : float
            radius of the track [m]

        Returns
        -------
        NDArray[np.complex128]
            transmitted fraction, complex, shape (n,) [-]
        """
        number = orders * self.semi_axis / radius
        dry: NDArray[np.complex128] = np.sinc(number / np.pi).astype(np.complex128)
        if self.numbers.size < 2:
            return dry
        spline = scipy.interpolate.CubicSpline(self.numbers, self.parts)
        last = self.numbers[-1]
        inside = number <= last
        result = dry.copy()
        result[inside] = spline(number[inside])
        return result


def dry_transmission(semi_axis: float) -> Transmission:
    """Transmission of Hertz' contact.

    Parameters
    ----------
    semi_axis : float
        semi-axis along the rolling direction [m]

    Returns
    -------
    Transmission
        transmission without samples
    """
    return Transmission(
        semi_axis=semi_axis, numbers=np.zeros(0), parts=np.zeros(0, dtype=np.complex128)
    )


@lru_cache(maxsize=KEPT)
def film_transmission(
    conditions: ContactConditions, semi_axis: float, largest: float, options: SolverOptions
) -> Transmission:
    """Transmission of a lubricated contact, solved on the points of the options.

    Parameters
    ----------
    conditions : ContactConditions
        conditions of the film
    semi_axis : float
        semi-axis along the rolling direction [m]
    largest : float
        k a of the shortest wave [-]
    options : SolverOptions
        mesh of the film

    Returns
    -------
    Transmission
        transmission with samples over k a
    """
    top = min(max(largest, STEP), FASTEST)
    numbers = np.linspace(0.0, top, max(int(np.ceil(top / STEP)), LEAST) + 1)
    parts = wave_transmission(conditions, options, numbers[1:].tolist())
    return Transmission(
        semi_axis=semi_axis, numbers=numbers, parts=np.concatenate([[1.0 + 0.0j], parts])
    )


def filtered(profile: Array, transmission: Transmission, radius: float) -> Array:
    """Heights over a turn that enter the bearing, order by order.

    Parameters
    ----------
    profile : Array
        heights, shape (n,) [m]
    transmission : Transmission
        transmission of the contact
    radius : float
        radius of the track [m]

    Returns
    -------
    Array
        heights, shape (n,) [m]
    """
    spectrum = np.fft.rfft(profile)
    orders = np.arange(spectrum.size, dtype=np.float64)
    return np.asarray(np.fft.irfft(spectrum * transmission.of(orders, radius), profile.size))


HERTZ = 1.5  # exponent of the force
# loads over the largest of a race, at which films are solved; stiffness over that of Hertz and
# damping change by some per cent between them
SOLVED_LOADS = (0.2, 1.0)
POINTS = 129  # and half of them; damping of the 6208 within 1.5 % of that from 257
STARVED_POINTS = 257  # behind a layer, where the damping is small and feels the mesh

SPAN = (0.03, 30.0)  # of approaches with knots of their own, over that of the largest load [-]
PLAIN = (0.0,) * (NORMAL_COLUMNS - HEAVY_LOAD)  # end of a law without films
RACES = {Race.INNER: FormBody.INNER, Race.OUTER: FormBody.OUTER}


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
    contacts: Sequence[BearingContact], asperities: Asperities, oil: OilAtInlets | None
) -> dict[Race, float]:
    """Load that the film of the heaviest contact of each race carries, over its whole load.

    Parameters
    ----------
    contacts : sequence of BearingContact
        All contacts of the bearing.
    asperities : Asperities
        Roughness of the surfaces and the law by which asperities carry load.
    oil : OilAtInlets or None
        Oil that limits the films; None: flooded.

    Returns
    -------
    dict of Race to float
        Share of the film [-] of each race whose film a formula gives.
    """
    shares = {}
    for race in Race:
        contact = heaviest(contacts, race)
        (film,) = supplied_films([contact], [None], oil)
        if film is not None:
            shares[race] = 1.0 - asperities.load_fraction(contact, film.central.value)
    return shares


_response = lru_cache(maxsize=KEPT)(normal_response)


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
        responses.append((lighter.load, at, _response(lighter, grid, (at,))))
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


def film_law(factor: float, films: SolvedFilms) -> tuple[float, ...]:
    """Law with the stiffness dQ/dd and the damping of solved films over the load.

    Both are linear over the logarithm of the load between the two films; beyond them the stiffness
    over that of Hertz stays, and the damping of lighter contacts fades with the load.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    films : SolvedFilms
        solved films of the race

    Returns
    -------
    tuple[float, ...]
        row of `EquationData.normal`
    """
    light, heavy = films.loads
    loads = heavy * np.geomspace(SPAN[0] ** HERTZ, SPAN[1] ** HERTZ, 100 * KNOT_COUNT)
    ratio = np.interp(np.log(loads), np.log(films.loads), films.stiffness_ratio)
    # d = integral of dQ/k, with the ratio constant between two loads
    hertz = (loads / factor) ** (2.0 / 3.0)
    steps = np.diff(hertz) * 0.5 * (1.0 / ratio[1:] + 1.0 / ratio[:-1])
    approach = hertz[0] / ratio[0] + np.concatenate([[0.0], np.cumsum(steps)])
    knots = np.linspace(np.log(approach[0]), np.log(approach[-1]), KNOT_COUNT)
    stiffness = np.exp(np.interp(knots, np.log(approach), np.log(loads)) - HERTZ * knots)
    # damping negative at the one frequency is positive at those of balls: none, over time
    rates = films.film_share * np.maximum(films.damping, 0.0)
    first = factor, HERTZ, 0.0, rates[0], light, 0.0, heavy, rates[1]
    return (*first, knots[0], knots[1] - knots[0], *stiffness.tolist())


def dry_law(factor: float, loss_time: float) -> tuple[float, ...]:
    """Hertz' law with a damping in proportion to its stiffness.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    loss_time : float
        damping over stiffness [s]

    Returns
    -------
    tuple[float, ...]
        row of `EquationData.normal`
    """
    return factor, HERTZ, 0.0, 0.0, 1.0, loss_time, *PLAIN


def linear_law(factor: float, mean: float, loss_time: float) -> tuple[float, ...]:
    """Spring k d with Hertz' stiffness k at the mean load of the loaded contacts.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    mean : float
        mean load [N]
    loss_time : float
        damping over stiffness [s]

    Returns
    -------
    tuple[float, ...]
        row of `EquationData.normal`
    """
    stiffness = HERTZ * factor ** (2.0 / 3.0) * float(np.cbrt(mean))
    return stiffness, 1.0, 0.0, 0.0, 1.0, loss_time, *PLAIN


@dataclass(frozen=True, slots=True, kw_only=True)
class Assembled:
    """Numbers of the equations, and what was solved for them."""

    laws: Array  # of inner and outer race, rows of `EquationData.normal`
    surfaces: Surfaces
    speeds: Array  # of inner ring, outer ring, cage, ball against the cage, at the end [rad/s]
    films: dict[Race, SolvedFilms]  # none with other laws
    transmissions: dict[Race, Transmission]  # none without a filter
    stiffness: dict[Race, float]  # of the heaviest contacts, after Hertz [N/m]

    @property
    def cage_speed(self) -> float:
        """Speed of the cage [rad/s]."""
        return float(self.speeds[2])


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
    laws: dict[Race, tuple[float, ...]] = {}
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
    operation = solution.operation
    heights = [_ring_heights(solution, model, race, transmissions) for race in RACES]
    excess = np.zeros(solution.bearing.balls)
    if model.form.ball_diameters:
        excess = 0.5 * np.array(model.form.ball_diameters)
    return Assembled(
        laws=np.array([laws[race] for race in Race]),
        surfaces=Surfaces(
            inner=heights[0],
            outer=heights[1],
            balls=_ball_heights(solution, model, transmissions),
            excess=excess,
            even=_even(model.form),
        ),
        speeds=np.array([operation.inner_speed, operation.outer_speed, cage, ball]),
        films=films,
        transmissions=transmissions,
        stiffness=stiffness,
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
    bearing = solution.bearing
    if support.inner_ring_fixed:
        mass = outer_ring_mass(bearing, support)
    else:
        mass = ring_body(bearing).mass + support.shaft_mass
    return sqrt(float(solution.stiffness[1, 1]) / mass) / (2.0 * pi)


def _check(solution: QuasistaticSolution, model: VibrationModel) -> None:
    if len(solution.rows) > 1:
        raise ValueError("rows: vibration takes one row of balls")
    operation = solution.operation
    if operation.shaft_speed == 0.0:
        raise ValueError("inner_speed: nothing turns, so nothing vibrates")
    fixed = model.support.inner_ring_fixed or not any(x is not None for x in operation.loads)
    if fixed and not model.support.outer_moves:
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
) -> tuple[float, ...]:
    if model.options.law is ContactLaw.DRY:
        return dry_law(factor, model.options.loss_time)
    return linear_law(factor, _mean_load(solution, race), model.options.loss_time)


def _mean_load(solution: QuasistaticSolution, race: Race) -> float:
    """Mean load of the loaded contacts of a race [N]."""
    load = solution.inner_load if race is Race.INNER else solution.outer_load
    return float(load[load > 0.0].mean())


def _even(form: SurfaceForm) -> bool:
    """All surfaces are circles, of equal balls."""
    return all(form.is_even(place) for place in FormBody) and not any(form.ball_diameters)


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
    profile = form.profiles.get(FormBody.BALL)
    equal &= profile is None or profile.ndim == 1
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
