r"""Stability of a balance of heat, and how far its temperatures go with the ranges of its paths.

Near a balance the temperatures move as

.. math:: C \dot T = (Q' - G)\, \delta T

with G of the network and Q' = dQ/dT of the friction, which falls with the viscosity of warmer oil
and rises with the preload of a warmer inner ring. The largest eigenvalue of C^-1 (Q' - G) is the
rate at which the slowest disturbance dies out; where it is positive the bearing runs away. The
margin is that rate over the rate with friction that does not change: 1 where it does not matter,
above it where friction falls with the temperature, 0 at the limit.
"""

from dataclasses import dataclass

import numpy as np

from ehl.arrays import Array

from .heat_state import HeatState, SelfHeatingProblem
from .network import NODES

PROBE = 1.0  # of one node's temperature, for the slope of the clearance [K]


@dataclass(frozen=True, slots=True, kw_only=True)
class Slopes:
    """A state and its neighbours."""

    state: HeatState
    warmer: HeatState  # of a higher film temperature
    wider: HeatState | None  # of a larger clearance; None where the clearance stays


@dataclass(frozen=True, slots=True, kw_only=True)
class Stability:
    """How a disturbance of the temperatures dies out, and ends of the temperatures."""

    rate: float  # largest eigenvalue [1/s], negative: dies out
    constant_friction_rate: float  # the same with friction that does not change [1/s]
    # lowest and highest temperature of each node of three balances: this one, all paths at the
    # low ends of their ranges, and all at the high ends [K]
    coldest: Array
    hottest: Array
    time_constants: Array  # of the modes, longest first, of a stable balance [s]

    @property
    def longest_time(self) -> float | None:
        """Time constant of the slowest mode of a stable balance [s]; None for an unstable one."""
        return float(self.time_constants[0]) if self.rate < 0.0 else None

    @property
    def margin(self) -> float:
        """Margin against runaway, zero or below without one [-]."""
        return self.rate / self.constant_friction_rate


def stability(
    slopes: Slopes, problem: SelfHeatingProblem, capacities: Array, temperatures: Array
) -> Stability:
    """Stability of a balance of heat.

    Parameters
    ----------
    slopes : Slopes
        state at the balance and its neighbours
    problem : SelfHeatingProblem
        bearing, friction and surroundings
    capacities : Array
        heat capacities of the nodes, shape (nodes,) [J/K]
    temperatures : Array
        temperatures of the nodes in the balance, shape (nodes,) [K]

    Returns
    -------
    Stability
        rates of the modes, and ends of the temperatures
    """
    state = slopes.state
    response = _response(slopes, problem)
    leaving, _ = state.network.matrix()
    rates = np.linalg.eigvals((response - leaving) / capacities[:, None]).real
    constant = np.linalg.eigvals(-leaving / capacities[:, None]).real
    ends = [temperatures, state.temperatures]
    for end in (1, -1):
        other, from_outside = state.network.matrix(end)
        fixed = state.sources - response @ state.temperatures + from_outside
        ends.append(np.asarray(np.linalg.solve(other - response, fixed), dtype=np.float64))
    return Stability(
        rate=float(rates.max()),
        constant_friction_rate=float(constant.max()),
        coldest=np.asarray(np.min(ends, axis=0), dtype=np.float64),
        hottest=np.asarray(np.max(ends, axis=0), dtype=np.float64),
        time_constants=np.sort(-1.0 / rates[rates < 0.0])[::-1],
    )


def _response(slopes: Slopes, problem: SelfHeatingProblem) -> Array:
    """Heat into each node by the temperature of each, (nodes, nodes) [W/K]: by the films' own and
    by the clearance.
    """
    state = slopes.state
    at = state.temperatures
    surplus = state.surplus(at)
    step = slopes.warmer.film_temperature - state.film_temperature
    by_film = (slopes.warmer.surplus(at) - surplus) / step
    response = np.outer(by_film, state.weights)
    if slopes.wider is None:
        return response
    step = slopes.wider.clearance - state.clearance
    by_clearance = (slopes.wider.surplus(at) - surplus) / step
    clearance = problem.clearance(at)
    slope = [
        (problem.clearance(at + PROBE * unit) - clearance) / PROBE for unit in np.eye(len(NODES))
    ]
    return np.asarray(response + np.outer(by_clearance, slope))
