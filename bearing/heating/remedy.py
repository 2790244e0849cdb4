"""The least cooling with which a bearing that is heated too much would stay below a limit."""

from collections.abc import Callable
from dataclasses import replace

from .conductances import Conductance
from .heat_state import HeatState
from .network import AMBIENT, OIL_SUPPLY, HeatPath

MOST = 1.0e5  # W/K up to which a conductance is sought
TOLERANCE = 1.0e-3  # of it [-]


def least_heat_transfer(state: HeatState) -> float | None:
    """Conductance of shaft and housing together to the surroundings at which the film temperature
    is that of the state under its friction [W/K]; None where no conductance is enough, for the
    heat does not get so far.
    """
    own = [path for path in state.network.paths if _to_ambient(path)]
    total = sum(path.conductance.value for path in own)
    if total <= 0.0:
        return None

    def with_total(wanted: float) -> tuple[HeatPath, ...]:
        return tuple(
            replace(path, conductance=path.conductance.times(wanted / total))
            if _to_ambient(path)
            else path
            for path in state.network.paths
        )

    return _least(state, with_total, total)


def least_oil_flow(state: HeatState) -> float | None:
    """Likewise rho c V of oil that passes through [W/K]."""
    others = tuple(path for path in state.network.paths if path.second != OIL_SUPPLY)

    def with_flow(wanted: float) -> tuple[HeatPath, ...]:
        flow = HeatPath(
            first="oil",
            second=OIL_SUPPLY,
            conductance=Conductance.exactly(wanted),
            what="oil that passes through, rho c V",
        )
        return (*others, flow)

    return _least(state, with_flow, 1e-3)


def _to_ambient(path: HeatPath) -> bool:
    return path.second == AMBIENT and path.first != "oil"


def _least(
    state: HeatState, paths: Callable[[float], tuple[HeatPath, ...]], low: float
) -> float | None:
    """The conductance by bisection of its logarithm [W/K]."""

    def too_hot(wanted: float) -> bool:
        network = replace(state.network, paths=paths(wanted))
        found = state.weights @ network.temperatures(state.sources)
        return bool(found > state.film_temperature)

    high = MOST
    if too_hot(high):
        return None
    while high > (1.0 + TOLERANCE) * low:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if too_hot(middle) else (low, middle)
    return high
