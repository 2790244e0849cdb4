"""Least cooling with which a bearing that is heated too much would stay below a limit."""

from collections.abc import Callable
from dataclasses import replace

from .conductances import Conductance
from .heat_state import HeatState
from .network import AMBIENT, OIL_SUPPLY, HeatPath

LARGEST_CONDUCTANCE = 1.0e5  # end of the search [W/K]
SMALLEST_FLOW = 1.0e-3  # its beginning for oil that passes through [W/K]
TOLERANCE = 1.0e-3  # of a conductance [-]


def required_heat_transfer(state: HeatState) -> float | None:
    """Conductance of shaft and housing together to the surroundings that the friction needs.

    The film temperature is then that of the state.

    Parameters
    ----------
    state : HeatState
        Friction and network at the highest permissible film temperature.

    Returns
    -------
    float | None
        Conductance [W/K]; None if no conductance is enough, because the heat does not get so far.
    """
    total = sum(path.conductance.value for path in state.network.paths if _is_surface(path))
    if total <= 0.0:
        return None

    def with_total(conductance: float) -> tuple[HeatPath, ...]:
        factor = conductance / total
        return tuple(
            replace(path, conductance=path.conductance.times(factor))
            if _is_surface(path)
            else path
            for path in state.network.paths
        )

    return _required(state, with_total, total)


def required_oil_flow(state: HeatState) -> float | None:
    """Heat capacity flow rho c V of oil through the bearing that the friction needs.

    Parameters
    ----------
    state : HeatState
        Friction and network at the highest permissible film temperature.

    Returns
    -------
    float | None
        rho c V [W/K]; None if no flow is enough.
    """
    others = tuple(path for path in state.network.paths if path.second != OIL_SUPPLY)

    def with_flow(conductance: float) -> tuple[HeatPath, ...]:
        flow = HeatPath(
            first="oil",
            second=OIL_SUPPLY,
            conductance=Conductance.exactly(conductance),
            description="oil that passes through, rho c V",
        )
        return (*others, flow)

    return _required(state, with_flow, SMALLEST_FLOW)


def _is_surface(path: HeatPath) -> bool:
    """True for a path from shaft or housing to the surroundings."""
    return path.second == AMBIENT and path.first != "oil"


def _required(
    state: HeatState, paths: Callable[[float], tuple[HeatPath, ...]], low: float
) -> float | None:
    """Conductance by bisection of its logarithm, from `low` on [W/K]."""

    def too_hot(conductance: float) -> bool:
        network = replace(state.network, paths=paths(conductance))
        temperature = state.weights @ network.temperatures(state.sources)
        return bool(temperature > state.film_temperature)

    high = LARGEST_CONDUCTANCE
    if too_hot(high):
        return None
    while high > (1.0 + TOLERANCE) * low:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if too_hot(middle) else (low, middle)
    return high
