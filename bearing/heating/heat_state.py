"""One state of a bearing that warms itself: heat at a film temperature and a clearance, with films
of formulas and the balls in balance, the conduction of heat through the films, and the
temperatures of all parts that follow.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np

from oilfilm.ehl.arrays import Array, unique_rows
from oilfilm.ehl.closed_form.hertz import HertzContact
from oilfilm.ehl.oil.assumed_heat import heat_of, with_heat
from oilfilm.ehl.oil.lubricant import Lubricant, heat_properties
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.film_conductance import (
    history_rate,
    marched_conductance,
    marched_flux,
    moving_speed,
)
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.shear import dimensional_conditions, dimensional_grid

from ..contacts.contact import BearingContact
from ..contacts.contacts import contact_conditions, with_oil
from ..films.between_races import equilibrium_with_films
from ..films.film import CONTACT_PRESSURE, ContactFilm, Films, FilmThickness, first_same
from ..films.unsolved_films import formula_films
from ..fits.clearance import Fit, TemperatureRise, clearance_budget
from ..friction.balance import BalancedFriction
from ..friction.film_friction import film_balance
from ..geometry import SINGLE, Bearing, Race, Row
from ..operation import Operation, QuasistaticModel
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic
from ..torque.inputs import FrictionInput
from ..torque.integrated import bearing_films, no_balance_message
from ..torque.skf import InletFactors
from .friction_heat import (
    FrictionHeat,
    UndrivenBallsError,
    effusivity_shares,
    loaded_half,
    solid_thermal,
)
from .limits import HIGHEST_TEMPERATURE
from .network import NODES, HeatNetwork, HeatPath
from .paths import Surroundings, solid_paths, state_paths

POINTS = 129  # of a solved film along rolling, at most, that a contact is marched on [-]
# conductivity of oil at 1 GPa over that at ambient pressure where the oil has no law of its own:
# up to twice, as mineral oils and polyalphaolefins (Larsson and Andersson, 2000) [-]
PRESSED = 2.0

ELLIPSE_POINTS = 33  # along and across the ellipse [-]; 129 conduct 0.9 % more in a 6306

Ends = tuple[float, float, float]  # value, low and high end [W/K]


OUTER = ("outer_ring_loaded", "outer_ring_unloaded")


def film_conductances(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    *,
    ends: bool = True,
) -> Array:
    """Conductances of heat through the films of all contacts.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of a bearing whose materials have heat properties.
    contacts : sequence of BearingContact
        Its contacts.
    films : sequence of ContactFilm or None
        Operating films of the contacts.
    ends : bool
        Whether both ends are wanted; else they are the value of films without a field.

    Returns
    -------
    ndarray, shape (3, balls, 2)
        Value, low and high end [W/K]; zero where there is no film.
    """
    bearing = solution.bearing
    temperature = solution.operation.temperature
    ball = solid_thermal(bearing.ball_material)
    rings = {
        Race.INNER: (ball, solid_thermal(bearing.inner_ring_material)),
        Race.OUTER: (ball, solid_thermal(bearing.outer_ring_material)),
    }
    rows = np.zeros((len(contacts), 3))
    existing: dict[tuple[int, float, float | None, Race], Ends] = {}
    fields = first_same([None if film is None else film.sheared_field for film in films])
    flat: dict[Race, list[int]] = {race: [] for race in rings}
    for number, (contact, film) in enumerate(zip(contacts, films, strict=True)):
        if film is None or contact.hertz is None:
            continue
        if film.sheared_field is None:
            flat[contact.race].append(number)
            continue
        key = (fields[number], *film.values, contact.race)
        if key not in existing:
            existing[key] = _of_solved(contact.hertz, film, rings[contact.race], temperature)
        rows[number] = existing[key]
    for race, numbers in flat.items():
        if numbers:
            chosen = [film for n in numbers if (film := films[n]) is not None]
            rows[numbers] = _of_flat(chosen, rings[race], temperature, 3 if ends else 1)
    return rows.T.reshape(3, -1, 2)


def _oil_ends(oil: Lubricant, pressure: Array, temperature: float) -> tuple[Array, Array, Array]:
    """Conductivity of the oil at pressures [Pa]: value, as at ambient pressure, and as pressed
    [W/(m K)].
    """
    pressed = heat_properties(pressure, with_heat(oil), temperature)[0]
    heat = heat_of(oil)
    still = heat.conductivity
    law = heat.under_pressure is not None
    return pressed, np.full_like(pressed, still), pressed if law else PRESSED * pressed


def _of_solved(
    hertz: HertzContact,
    film: ContactFilm,
    pair: tuple[SolidThermal, SolidThermal],
    temperature: float,
) -> Ends:
    """Value, low and high end of one contact [W/K]: the film of its solution within Hertz'
    ellipse, as of a flat film, its error, and oil that conducts as at ambient pressure or as
    pressed.
    """
    field = film.operating_field
    assert field is not None
    solution = field.thinned(POINTS)
    x, y, gap = dimensional_grid(solution)
    conditions = dimensional_conditions(solution)
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    speed = moving_speed(conditions.entrainment_speed, axes, *pair)
    inside = (x[:, None] / hertz.semi_axis_x) ** 2 + (y / hertz.semi_axis_y) ** 2 < 1.0
    oil = _oil_ends(conditions.lubricant, solution.pressure, temperature)
    value, low, high = (
        marched_conductance(
            speed, x, y, np.where(inside, k / (np.maximum(gap, 1e-12) * scale), 0.0), *pair
        )
        for k, scale in zip(oil, _scales(film.central), strict=True)
    )
    return value, low, high


def _scales(film: FilmThickness) -> Ends:
    """Factors of the film by its ends, value and both ends of the conductance [-]."""
    return 1.0, film.high / film.value, 1.0 / (1.0 + film.relative_error)


def _of_flat(
    films: Sequence[ContactFilm],
    pair: tuple[SolidThermal, SolidThermal],
    temperature: float,
    count_ends: int,
) -> Array:
    """Conductances of flat films of one race and one oil at once, equal ones once, shape
    (films, 3), or (films, 1) without ends.
    """
    numbers = [
        (
            *(*film.size, film.central.value, film.conditions.entrainment_speed),
            *_scales(film.central),
        )
        for film in films
    ]
    places = np.array(numbers)
    first, like = unique_rows(places / np.abs(places).max(axis=0))
    chosen = places[first]
    axes = [(along, across) for along, across, *_ in chosen.tolist()]
    speed = [
        moving_speed(u, pair_of, *pair)
        for u, pair_of in zip(chosen[:, 4].tolist(), axes, strict=True)
    ]
    # 1. half of the lines along rolling, the others are their images
    P, count = _hertz_pressures()
    step = 2.0 / (P.shape[0] - 1) * chosen[:, :2]
    largest, gap = chosen[:, 2, None, None], chosen[:, 3, None, None]
    oil = _oil_ends(films[0].conditions.lubricant, largest * P, temperature)[:count_ends]
    scales = chosen[:, 5 : 5 + count_ends].T[:, :, None, None]
    # 2. all of them marched together: nodes along x, then ends, contacts and lines
    film = np.where(P > CONTACT_PRESSURE, np.stack(oil) / (np.maximum(gap, 1e-12) * scales), 0.0)
    lines = np.moveaxis(film, 2, 0).reshape(P.shape[0], -1)
    rates = np.repeat(history_rate(np.array(speed), step[:, 0], *pair), P.shape[1])
    marched = marched_flux(lines, np.tile(rates, count_ends))
    flux = marched.reshape(count_ends, len(first), -1) @ count
    return np.asarray((flux * step.prod(axis=1)).T[like])


@cache
def _hertz_pressures() -> tuple[Array, Array]:
    """Pressure over Hertz' on `ELLIPSE_POINTS` = n lines over the ellipse along rolling, of them
    those with y >= 0, shape (n, n // 2 + 1), and how many each of these stands for [-].
    """
    steps = ELLIPSE_POINTS // 2
    places = np.arange(-steps, steps + 1)
    left = np.maximum(steps**2 - places[:, None] ** 2 - places[steps:] ** 2, 0)
    count = np.full(left.shape[1], 2.0)
    count[0] = 1.0
    return np.sqrt(left) / steps, count


@dataclass(frozen=True, slots=True, kw_only=True)
class OperatingState:
    """Results computed of one state of a bearing; None where they are not."""

    films: Films | None = None  # operating films of the contacts
    balance: BalancedFriction | None = None  # of the balls on these films
    conductances: Array | None = None  # through these films, (3, balls, 2) [W/K]


NOTHING_COMPUTED = OperatingState()


@dataclass(slots=True, kw_only=True)
class FilmsHeat:
    """Heat of one bearing in states that follow each other, each balance begun at the last."""

    friction: FrictionInput
    ends: bool = True  # whether the ends of conductances are wanted
    last: BalancedFriction | None = field(default=None)
    held: QuasistaticSolution | None = field(default=None)  # by the films of the last state
    # the last equilibrium, its oil and its heat
    last_heat: tuple[QuasistaticSolution, Lubricant, FrictionHeat] | None = field(default=None)

    def heat(
        self,
        solution: QuasistaticSolution,
        contacts: Sequence[BearingContact],
        oil: Lubricant,
        rheology: Rheology,
        inlet: InletFactors,
        computed: OperatingState = NOTHING_COMPUTED,
    ) -> FrictionHeat:
        """Heat of operating films of formulas, without seals.

        Parameters
        ----------
        solution : QuasistaticSolution
            Equilibrium of the bearing.
        contacts : sequence of BearingContact
            Its contacts.
        oil : Lubricant
            The oil.
        rheology : Rheology
            Of the oil.
        inlet : InletFactors
            What the inlets leave of the rolling moments [-].
        computed : OperatingState
            Films, balance and conductances of this state, where they are computed already.

        Returns
        -------
        FrictionHeat
            [N m], [W].

        Raises
        ------
        UndrivenBallsError
            If the balls find no balance.
        """
        if self.last_heat is not None:
            before, same, heat = self.last_heat
            # loads of one equilibrium at several temperatures are one array
            if before.inner_load is solution.inner_load and same == oil:
                return heat
        supply = self.friction.oil_at_inlets(inlet, solution.bearing.balls)
        self.held, contacts = equilibrium_with_films(solution, contacts, oil, supply, self.held)
        operating, balance = computed.films, computed.balance
        if operating is None:
            none = (None,) * len(contacts)
            operating = bearing_films(solution, contacts, none, self.friction, inlet)
        resistance = self.friction.resistance(
            solution.bearing, oil, solution.operation.shaft_speed
        )
        if balance is None:
            balance = film_balance(solution, contacts, operating, rheology, resistance, self.last)
        if not balance.converged:
            raise UndrivenBallsError(f"the torque of films: {no_balance_message(balance)}")
        self.last = balance
        pumped = np.array([0.0 if film is None else film.rolling_moment for film in operating])
        pumped = pumped.reshape(-1, 2) * np.abs(balance.kinematics[..., 3])
        resisted = balance.resisted
        speed = solution.operation.shaft_speed
        conductances = computed.conductances
        if conductances is None:
            conductances = film_conductances(solution, contacts, operating, ends=self.ends)
        found = FrictionHeat(
            torque=(float(balance.power.sum()) + resisted.heat) / speed,
            speed=speed,
            contact=balance.power - pumped,
            pumped=pumped,
            drag=resisted.drag,
            cage=resisted.pocket + resisted.land,
            conductance=conductances,
            loaded=loaded_half(solution),
        )
        self.last_heat = (solution, oil, found)
        return found


def formula_conductances(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> Array:
    """Conductances of heat through isothermal films of formulas.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.

    Returns
    -------
    ndarray, shape (3, balls, 2)
        Value, low and high end [W/K].
    """
    return film_conductances(solution, contacts, formula_films(contacts))


FrictionModel = Callable[[QuasistaticSolution, Sequence[BearingContact], Lubricant], FrictionHeat]


@dataclass(frozen=True, slots=True, kw_only=True)
class SelfHeatingProblem:
    """A bearing whose temperatures follow from its friction."""

    bearing: Bearing  # with its clearance at the reference temperature, before mounting
    operation: Operation  # its temperature counts where `enough` is given
    model: QuasistaticModel
    oil: Callable[[float], Lubricant]  # lubricant at a temperature [K]
    friction: FrictionModel  # heat of an equilibrium, its contacts and its oil
    around: Surroundings
    fit: Fit | None = None
    # temperature at which clearance and fits were measured; None: the clearance is the operating
    # one, and stays
    reference: float | None = 293.15  # [K]
    rows: tuple[Row, ...] = SINGLE  # of balls on the one inner ring
    oil_share: float | None = None  # of the cavity [-]
    start: QuasistaticSolution | None = None  # an equilibrium nearby, where that is known
    contacts: tuple[BearingContact, ...] = ()  # of `start`, where they are known
    hottest: float = HIGHEST_TEMPERATURE  # of the films, beyond which no balance counts [K]
    # step of the film temperature that is not taken any more, of who asks whether that of the
    # operation is one of a balance [K]
    enough: float = 0.0
    # film temperature of the balance of nearly the same problem, about which this one is looked
    # for [K]; None: all balances are looked for
    expected: float | None = None

    def clearance(self, temperatures: Array) -> float:
        """Diametral clearance at temperatures of the nodes; that of the outer ring is the mean of
        its halves.

        Parameters
        ----------
        temperatures : Array
            of the nodes, shape (nodes,) [K]

        Returns
        -------
        float
            clearance [m]
        """
        if self.reference is None:
            return self.bearing.diametral_clearance
        rise = dict(zip(NODES, (temperatures - self.reference).tolist(), strict=True))
        rises = TemperatureRise(
            inner_ring=rise["inner_ring"],
            shaft=rise["shaft"],
            outer_ring=0.5 * (rise[OUTER[0]] + rise[OUTER[1]]),
            housing=rise["housing"],
            ball=rise["balls"],
        )
        return clearance_budget(self.bearing, self.operation, self.fit, rises).operating

    def disagreement(self, state: "HeatState") -> Array:
        """T_f' - T_f and P_d' - P_d of a state: zero in a balance.

        Parameters
        ----------
        state : HeatState
            heat and temperatures at one film temperature and clearance

        Returns
        -------
        Array
            shape (2,) [K], [m]
        """
        return np.array(
            [
                state.resulting_temperature - state.film_temperature,
                self.clearance(state.temperatures) - state.clearance,
            ]
        )

    def fixed_paths(self) -> tuple[HeatPath, ...]:
        """Paths that friction leaves as they are."""
        speed = self.operation.shaft_speed
        return solid_paths(self.bearing, self.around, speed, len(self.rows))


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatState:
    """Heat at one film temperature and clearance, and the temperatures that follow."""

    film_temperature: float  # of oil and films [K]
    clearance: float  # on the diameter [m]
    viscosity: float  # of the oil there [Pa s]
    friction: FrictionHeat
    sources: Array  # heat into the nodes [W]
    network: HeatNetwork
    temperatures: Array  # of the nodes under these sources [K]
    solution: QuasistaticSolution
    contacts: tuple[BearingContact, ...]  # of the solution

    @property
    def weights(self) -> Array:
        """Weights of the nodes in the film temperature [-]: half the balls, a quarter each ring,
        the outer one by the loads in its halves.
        """
        halves = self.friction.loaded @ self.friction.contact[:, 1]
        total = float(self.friction.contact[:, 1].sum())
        loaded = float(halves) / total if total > 0.0 else 0.5
        values = {"balls": 0.5, "inner_ring": 0.25}
        values |= {OUTER[0]: 0.25 * loaded, OUTER[1]: 0.25 * (1.0 - loaded)}
        return np.array([values.get(name, 0.0) for name in NODES])

    @property
    def resulting_temperature(self) -> float:
        """Film temperature that follows [K]."""
        return float(self.weights @ self.temperatures)

    def surplus(self, temperatures: Array) -> Array:
        """Heat into each node less what leaves it.

        Parameters
        ----------
        temperatures : Array
            of the nodes, shape (nodes,) [K]

        Returns
        -------
        Array
            shape (nodes,) [W]
        """
        leaving, given = self.network.matrix()
        return np.asarray(self.sources + given - leaving @ temperatures)


def broyden(matrix: Array, step: Array, change: Array, scales: tuple[float, ...]) -> Array:
    """Matrix of derivatives after a step that changed the residual, lengths in the scales of the
    unknowns, Broyden (1965).

    Parameters
    ----------
    matrix : Array
        before the step, shape (n, n)
    step : Array
        of the unknowns, shape (n,)
    change : Array
        of the residual, shape (n,)
    scales : tuple[float, ...]
        of the unknowns, in their units

    Returns
    -------
    Array
        shape (n, n)
    """
    weighted = step * np.array(scales) ** -2.0
    return np.asarray(matrix + np.outer(change - matrix @ step, weighted) / (step @ weighted))


def heat_state(
    problem: SelfHeatingProblem,
    fixed: Sequence[HeatPath],
    film_temperature: float,
    clearance: float,
    initial_guess: tuple[QuasistaticSolution, tuple[BearingContact, ...]] | None = None,
) -> HeatState:
    """Equilibrium, friction and temperatures at a film temperature and a clearance.

    Parameters
    ----------
    problem : SelfHeatingProblem
        the bearing that warms itself
    fixed : Sequence[HeatPath]
        paths of heat that friction leaves as they are
    film_temperature : float
        of oil and films [K]
    clearance : float
        on the diameter [m]
    initial_guess : tuple[QuasistaticSolution, tuple[BearingContact, ...]] | None, optional
        an equilibrium nearby, and its contacts, empty where they are not computed

    Returns
    -------
    HeatState
        heat [W] and temperatures [K]

    Raises
    ------
    ValueError
        if there is no equilibrium or no friction there, or heat cannot leave
    """
    # 1. clearance, 2. equilibrium, 3. viscosity, 4. friction
    operation = replace(problem.operation, temperature=film_temperature)
    bearing = replace(problem.bearing, diametral_clearance=clearance)
    known, contacts = (None, ()) if initial_guess is None else initial_guess
    solution = _equilibrium(problem, bearing, operation, known)
    if not solution.converged:
        raise ValueError(f"no equilibrium at {film_temperature:.1f} K: {solution.message}")
    oil = problem.oil(film_temperature)
    if known is not None and contacts and known.inner_load is solution.inner_load:
        contacts = with_oil(solution, contacts, oil)
    else:
        contacts = contact_conditions(solution, oil)
    friction = problem.friction(solution, contacts, oil)
    # 5. heat into the nodes, and their temperatures
    around = problem.around
    sources = friction.sources(effusivity_shares(bearing), filled=around.filled)
    paths = state_paths(bearing, around, oil, friction, solution.cage_speed, len(problem.rows))
    network = HeatNetwork(paths=(*fixed, *paths), boundaries=around.boundaries)
    return HeatState(
        film_temperature=film_temperature,
        clearance=clearance,
        viscosity=oil.viscosity,
        friction=friction,
        sources=sources,
        network=network,
        temperatures=network.temperatures(sources),
        solution=solution,
        contacts=contacts,
    )


def _equilibrium(
    problem: SelfHeatingProblem,
    bearing: Bearing,
    operation: Operation,
    initial_guess: QuasistaticSolution | None,
) -> QuasistaticSolution:
    """Equilibrium of the bearing, SI: its loads do not depend on the oil, so that one at another
    temperature is the same.
    """
    if initial_guess is None or not initial_guess.converged:
        return solve_quasistatic(bearing, operation, problem.model, rows=problem.rows)
    known = (initial_guess.bearing, initial_guess.model, tuple(initial_guess.rows))
    at_once = replace(initial_guess.operation, temperature=operation.temperature) == operation
    if at_once and known == (bearing, problem.model, tuple(problem.rows)):
        return replace(initial_guess, operation=operation)
    guess = initial_guess if initial_guess.model == problem.model else None
    return solve_quasistatic(bearing, operation, problem.model, guess, problem.rows)
