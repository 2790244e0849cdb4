"""Temperatures of a shaft on bearings that warm themselves, and of each other.

Each bearing has the network of its own balance of heat. Sections of the shaft and the housing
conduct between the nodes of neighbours, and the shaft grows against the housing between located
bearings, which changes their loads. Wanted are film temperature, clearance and growth of every
bearing, T_f, P_d and g, at which those that follow are the same:

    equilibrium of the shaft at P_d, g -> friction at T_f -> temperatures of the one network
    -> T_f', P_d', g'

by Newton's method with differences as its first matrix and Broyden's updates, begun at the
balance of each bearing by itself. With one bearing it is that balance.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si

from ..heating.friction_heat import solid_thermal
from ..heating.heat_state import HeatState, SelfHeatingProblem, broyden, heat_state
from ..heating.limits import HeatBalance
from ..heating.network import NODES, Conductance, HeatNetwork, HeatPath
from ..heating.paths import HOUSING_DIAMETER, dimensions
from ..heating.self_heating import (
    CLEARANCE_STEP,
    CLEARANCE_TOLERANCE,
    LARGEST_STEP,
    NOT_CONVERGED,
    STEP,
    TOLERANCE,
    SelfHeatingSolution,
    solve_self_heating,
)
from ..operation import Operation
from ..quasistatic.solution import QuasistaticSolution
from .equilibrium import ShaftSolution, floats, solve_shaft
from .system import AxialLocation, ShaftSystem

# an estimate: the walls between bearings are those of no drawing
HOUSING_RANGE = (0.25, 4.0)  # [-]
MOST_STEPS = 30
HALVINGS = 5  # of a step to where a bearing has no state
SHAFT, HOUSING = NODES.index("shaft"), NODES.index("housing")


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatLink:
    """Path of heat between the same nodes of two bearings."""

    node: str
    bearings: tuple[int, int]  # their numbers, from 0
    conductance: Conductance  # [W/K]
    description: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftHeat:
    """Balance of heat of a shaft on its bearings."""

    shaft: ShaftSolution  # at these temperatures
    bearings: tuple[SelfHeatingSolution, ...]  # each among its neighbours
    links: tuple[HeatLink, ...]
    stable: bool
    # lowest and highest temperatures (2, bearings, nodes) of five balances: this one, and those of
    # the paths of the bearings and of the ones between them at either end of their ranges [K]
    node_range: Array
    film_range: Array  # likewise of the films (2, bearings) [K]

    @property
    def temperatures(self) -> Array:
        """Temperatures of the nodes of each bearing (bearings, nodes) [K]."""
        return np.array([one.state.temperatures for one in self.bearings if one.state])

    @property
    def flows(self) -> Array:
        """Heat from the first to the second bearing of each link [W]."""
        at = self.temperatures
        return np.array(
            [
                link.conductance.value
                * np.subtract(*at[list(link.bearings), NODES.index(link.node)])
                for link in self.links
            ]
        )


def heat_links(
    system: ShaftSystem, problems: Sequence[SelfHeatingProblem]
) -> tuple[HeatLink, ...]:
    """Paths along shaft and housing between the bearings that are neighbours.

    Parameters
    ----------
    system : ShaftSystem
        Shaft, bearings, conductance of the housing if it is known.
    problems : sequence of SelfHeatingProblem
        Heat of each bearing.

    Returns
    -------
    tuple of HeatLink
        Along the shaft 1/sum(l/(k A)) of its sections; the housing as given, or an estimate.
    """
    places = [support.position for support in system.supports]
    order = np.argsort(places, kind="stable").tolist()
    links = []
    for pair in zip(order[:-1], order[1:], strict=True):
        low, high = (places[k] for k in pair)
        if high == low:
            continue
        along = np.diff(system.thermal_resistance(np.array([low, high])))
        rods = HeatLink(
            node="shaft",
            bearings=pair,
            conductance=Conductance.exactly(float(1.0 / along[0])),
            description="sections of the shaft, k A/l in series",
        )
        links += [rods, _housing_link(system, problems, pair, high - low)]
    return tuple(links)


def _housing_link(
    system: ShaftSystem,
    problems: Sequence[SelfHeatingProblem],
    pair: tuple[int, int],
    length: float,
) -> HeatLink:
    """The housing between two bearings: as given, or a tube about both of them."""
    given = system.housing_conductance
    if given is not None:
        conductance = Conductance.exactly(given)
        words = "housing, as given"
    else:
        sizes = [dimensions(problems[k].bearing, problems[k].around) for k in pair]
        outside = sum(0.5 * size.outside for size in sizes)
        area = 0.25 * pi * (HOUSING_DIAMETER**2 - 1.0) * outside**2
        k = solid_thermal(problems[pair[0]].around.housing_material).conductivity
        value = k * area / length
        low, high = HOUSING_RANGE
        conductance = Conductance(value, low * value, high * value)
        words = "housing, a tube of 1.6 outside diameters: an estimate, a quarter to four times"
    return HeatLink(node="housing", bearings=pair, conductance=conductance, description=words)


@dataclass(frozen=True, slots=True)
class _Point:
    """Equilibrium and heat at one set of unknowns."""

    unknowns: Array  # film temperatures [K], clearances [m], growths [m] (3, bearings)
    shaft: ShaftSolution
    states: tuple[HeatState, ...]
    residual: Array  # what follows less the unknowns, likewise


class _Shaft:
    """Shaft and bearings of one balance of heat, states counted."""

    def __init__(self, system: ShaftSystem, problems: Sequence[SelfHeatingProblem]) -> None:
        self.system = system
        self.problems = problems
        self.links = heat_links(system, problems)
        self.count = 0

    def at(self, unknowns: Array, near: _Point | None) -> _Point:
        """The point at unknowns; states that they leave as they are are those of a point nearby.

        Raises
        ------
        ValueError
            If shaft or a bearing have no equilibrium there, or the balls are not driven.
        """
        film, clearance, growth = unknowns
        if near is not None and np.array_equal(unknowns[1:], near.unknowns[1:]):
            shaft = near.shaft
        else:
            shaft = solve_shaft(self._system(clearance, growth))
            if not shaft.converged:
                raise ValueError(shaft.message)
        states = []
        for k, bearing in enumerate(shaft.bearings):
            same = near is not None and shaft is near.shaft and film[k] == near.unknowns[0, k]
            states.append(
                near.states[k] if near is not None and same else self._state(k, bearing, film[k])
            )
        found = tuple(states)
        residual = self.following(found, self.temperatures(found)) - unknowns
        return _Point(unknowns, shaft, found, residual)

    def _system(self, clearance: Array, growth: Array) -> ShaftSystem:
        supports = tuple(
            replace(
                support,
                bearing=replace(support.bearing, diametral_clearance=float(clearance[k])),
                growth=float(growth[k]),
            )
            for k, support in enumerate(self.system.supports)
        )
        return replace(self.system, supports=supports)

    def _state(self, index: int, bearing: QuasistaticSolution, film: float) -> HeatState:
        self.count += 1
        problem = self.problems[index]
        known = replace(bearing, operation=held_operation(bearing))
        at = replace(problem, operation=known.operation)
        clearance = known.bearing.diametral_clearance
        return heat_state(at, at.fixed_paths(), float(film), clearance, (known, ()))

    def temperatures(
        self,
        states: Sequence[HeatState],
        ends: tuple[int, int] = (0, 0),
        heat: Array | float = 0.0,
    ) -> Array:
        """Temperatures of the nodes of all bearings in one network (bearings, nodes) [K], paths of
        the bearings and those between them at ends of their ranges: -1 low, 1 high; under their
        sources and more heat [W].
        """
        sources = np.concatenate([state.sources for state in states]) + heat
        network = self.network(states, against=ends[0] != ends[1])
        return network.temperatures(sources, ends[0]).reshape(len(states), -1)

    def network(self, states: Sequence[HeatState], *, against: bool) -> HeatNetwork:
        """The networks of the bearings as one, with the paths between them; these with the ends of
        their ranges in exchange where they go against the others.
        """
        paths = [
            replace(path, first=f"{path.first} {k}", second=f"{path.second} {k}")
            for k, state in enumerate(states)
            for path in state.network.paths
        ]
        paths += [
            HeatPath(
                f"{link.node} {link.bearings[0]}",
                f"{link.node} {link.bearings[1]}",
                link.conductance.exchanged() if against else link.conductance,
                link.description,
            )
            for link in self.links
        ]
        boundaries = {
            f"{name} {k}": temperature
            for k, state in enumerate(states)
            for name, temperature in state.network.boundaries.items()
        }
        nodes = tuple(f"{name} {k}" for k in range(len(states)) for name in NODES)
        return HeatNetwork(paths=tuple(paths), boundaries=boundaries, nodes=nodes)

    def following(self, states: Sequence[HeatState], temperatures: Array) -> Array:
        """Film temperatures, clearances and growths that follow from states and temperatures of
        the nodes (3, bearings).
        """
        pairs = list(zip(self.problems, states, temperatures, strict=True))
        growth = self.system.axial_growth(temperatures[:, SHAFT], temperatures[:, HOUSING])
        return np.array(
            [
                [state.weights @ at for _, state, at in pairs],
                [problem.clearance(at) for problem, _, at in pairs],
                growth - growth[0],  # all alike move the shaft only
            ]
        )

    def active(self) -> Array:
        """The unknowns that change heat or loads (3, bearings)."""
        located = [s.location is not AxialLocation.NONE for s in self.system.supports]
        grows = np.array(located) & (sum(located) > 1)
        grows[0] = False
        floating = [problem.reference is not None for problem in self.problems]
        return np.array([[True] * len(located), floating, grows])


def held_operation(state: QuasistaticSolution) -> Operation:
    """Operation of a bearing under the radial load of the shaft, its ring held along the axis,
    where it does not float, and tilted as the shaft has it.

    Parameters
    ----------
    state : QuasistaticSolution
        Bearing of a shaft's equilibrium.

    Returns
    -------
    Operation
        Loads [N] and displacements [m], [rad].
    """
    loose = floats(state)
    return replace(
        state.operation,
        force=(0.0 if loose else None, float(state.ring_force[1]), float(state.ring_force[2])),
        moment=(None, None),
        displacement=(None if loose else float(state.displacement[0]), None, None),
        tilt=(float(state.tilt[0]), float(state.tilt[1])),
    )


def solve_shaft_heat(
    system: ShaftSystem,
    problems: Sequence[SelfHeatingProblem],
    models: Sequence[str],
    start: ShaftHeat | None = None,
) -> ShaftHeat:
    """Temperatures at which the friction of all bearings equals what surroundings and oil remove.

    Parameters
    ----------
    system : ShaftSystem
        Shaft, bearings, loads.
    problems : sequence of SelfHeatingProblem
        Heat of each bearing, at the operation that it has by itself.
    models : sequence of str
        Of the friction torque of each, for the results.
    start : ShaftHeat, optional
        A balance nearby; left out, that of each bearing by itself.

    Returns
    -------
    ShaftHeat
        Temperatures [K], loads [N]; not converged where none was found.

    Raises
    ------
    ValueError
        If a bearing has no friction or no equilibrium, or heat cannot leave.
    """
    whole = _Shaft(system, problems)
    own = None if start is None else start.bearings
    if own is None:
        own = tuple(
            solve_self_heating(problem, model, judged=False)
            for problem, model in zip(problems, models, strict=True)
        )
    lost = [f"bearing {k}: {one.note}" for k, one in enumerate(own, 1) if one.balance is None]
    if lost:
        raise ValueError("; ".join(lost))
    film = [one.balance.temperature for one in own if one.balance]
    states = [one.state for one in own if one.state]
    unknowns = whole.following(states, whole.temperatures(states))
    unknowns[0] = film
    point, matrix, nearby, converged = _newton(whole, unknowns)
    node_range, film_range = _ranges(whole, point, nearby)
    return ShaftHeat(
        node_range=node_range,
        film_range=film_range,
        shaft=point.shaft,
        bearings=_among_neighbours(whole, point, models, converged=converged),
        links=whole.links,
        stable=_is_stable(matrix, len(problems)),
    )


def _newton(whole: _Shaft, unknowns: Array) -> tuple[_Point, Array, list[_Point], bool]:
    """The balance near unknowns, the derivatives of the residual by them, the first point with
    those that differ from it in one unknown each, and whether they are at rest.
    """
    count = unknowns.shape[1]
    tolerances = np.repeat([TOLERANCE, CLEARANCE_TOLERANCE, CLEARANCE_TOLERANCE], count)
    steps = np.repeat([STEP, CLEARANCE_STEP, CLEARANCE_STEP], count)
    hottest = np.array([problem.hottest for problem in whole.problems])
    unknowns[0] = np.minimum(unknowns[0], hottest)
    point = whole.at(unknowns, None)
    # an unknown that changes nothing but itself has the derivative -1
    matrix = -np.eye(unknowns.size)
    nearby = [point]
    for n in np.flatnonzero(whole.active()):
        shifted = (unknowns.ravel() + steps[n] * np.eye(unknowns.size)[n]).reshape(3, -1)
        nearby.append(whole.at(shifted, point))
        matrix[:, n] = (nearby[-1].residual - point.residual).ravel() / steps[n]
    for _ in range(MOST_STEPS):
        residual = point.residual.ravel()
        if (np.abs(residual) <= tolerances).all():
            return point, matrix, nearby, True
        step = np.asarray(-np.linalg.solve(matrix, residual)).reshape(3, -1)
        step *= min(1.0, LARGEST_STEP / max(float(np.abs(step[0]).max()), 1e-30))
        after = _stepped(whole, point, step, hottest)
        if after is None:
            break
        moved = (after.unknowns - point.unknowns).ravel()
        if not moved.any():
            break
        matrix = broyden(matrix, moved, after.residual.ravel() - residual, tuple(steps))
        point = after
    return point, matrix, nearby, False


def _ranges(whole: _Shaft, point: _Point, nearby: Sequence[_Point]) -> tuple[Array, Array]:
    """Lowest and highest temperatures of nodes and films at the ends of the paths' ranges, by one
    step of Newton's method from the balance with the derivatives there.
    """
    balance = whole.temperatures(point.states)
    nodes = [balance]
    films = [point.unknowns[0]]
    heat = [
        np.concatenate([one.surplus(at) for one, at in zip(near.states, balance, strict=True)])
        for near in nearby
    ]
    for ends in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
        # 1. temperatures of the nodes, and what follows from them, with the heat of each point
        found = [whole.temperatures(point.states, ends, one - heat[0]) for one in heat]
        follow = [whole.following(point.states, at).ravel() for at in found]
        # 2. their derivatives by the unknowns that differ
        moved = np.array([(one.unknowns - nearby[0].unknowns).ravel() for one in nearby[1:]])
        active = moved.any(axis=0)
        steps = moved[:, active].sum(axis=1)
        warming = np.array([(at - found[0]).ravel() for at in found[1:]]).T / steps
        slopes = (np.array(follow[1:]) - follow[0]).T / steps
        # 3. the step
        lacking = follow[0] - point.unknowns.ravel()
        step = np.linalg.solve(np.eye(steps.size) - slopes[active], lacking[active])
        nodes.append(found[0] + (warming @ step).reshape(found[0].shape))
        films.append(point.unknowns[0] + step[: found[0].shape[0]])
    low_and_high = (np.min, np.max)
    return (
        np.array([end(nodes, axis=0) for end in low_and_high]),
        np.array([end(films, axis=0) for end in low_and_high]),
    )


def _stepped(whole: _Shaft, point: _Point, step: Array, hottest: Array) -> _Point | None:
    """The point a step further, or a part of it where a bearing has no state there."""
    for halving in range(HALVINGS):
        unknowns = point.unknowns + 0.5**halving * step
        unknowns[0] = np.minimum(unknowns[0], hottest)
        try:
            return whole.at(unknowns, point)
        except ValueError:
            continue
    return None


def _is_stable(matrix: Array, count: int) -> bool:
    """Tell whether film temperatures return to the balance, clearance and growth following at
    once: the eigenvalues of d(T_f' - T_f)/dT_f are below zero.
    """
    warm, rest = matrix[:count], matrix[count:]
    slope = warm[:, :count] - warm[:, count:] @ np.linalg.solve(rest[:, count:], rest[:, :count])
    return bool((np.linalg.eigvals(slope).real < 0.0).all())


def _among_neighbours(
    whole: _Shaft, point: _Point, models: Sequence[str], *, converged: bool
) -> tuple[SelfHeatingSolution, ...]:
    """Each bearing with the paths to its neighbours and the temperatures of these."""
    temperatures = whole.temperatures(point.states)
    found = []
    for k, (problem, state, model) in enumerate(
        zip(whole.problems, point.states, models, strict=True)
    ):
        neighbours = []
        for link in whole.links:
            if k not in link.bearings:
                continue
            other = link.bearings[1 - link.bearings.index(k)]
            path = HeatPath(
                link.node,
                f"{link.node} of bearing {other + 1}",
                link.conductance,
                link.description,
            )
            neighbours.append((path, float(temperatures[other, NODES.index(link.node)])))
        around = replace(problem.around, neighbours=tuple(neighbours))
        network = HeatNetwork(
            paths=(*state.network.paths, *(path for path, _ in neighbours)),
            boundaries=around.boundaries,
        )
        at = replace(state, network=network, temperatures=temperatures[k])
        power = state.friction.power
        left = power - network.removed(temperatures[k])
        celsius = from_si("temperature_C", state.film_temperature)
        balance = HeatBalance(
            temperature=state.film_temperature,
            torque=state.friction.torque,
            power=power,
            evaluations=whole.count,
            residual=left / power if power > 0.0 else 0.0,
            converged=converged,
            message="converged"
            if converged
            else f"no balance of heat of shaft and bearings, last films at {celsius:.0f} C",
        )
        found.append(
            SelfHeatingSolution(
                model=model,
                around=around,
                balance=balance,
                state=at,
                note="" if converged else NOT_CONVERGED,
            )
        )
    return tuple(found)
