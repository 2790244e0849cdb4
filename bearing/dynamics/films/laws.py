"""The lubricated contact in NumPy: film, load and stiffness of a ball on a race over the film of a
traction table.

The film of the table lifts the ball: as if rigid, ball and race approach by delta = w(Q) - h_c(Q,
u), with Hertz' w = (Q/K)^(1/n) and the central film h_c at the load Q and entrainment speed u. So
dQ/d delta = 1/(dw/dQ - dh_c/dQ), the stiffness of film and elastic bodies in series, and Q > 0
already where the bodies are less than the film apart.
"""

from math import exp, log

import numpy as np

from ehl.traction.table.splines import spline_weights
from ehl.traction.table.table import LOAD_POWER, load_place

from ..arrays import EXPONENT, STIFFNESS, Array, FrictionData

FILM = 3  # column of a table's scalars: logarithm of the central film
# places where a table is looked at before a simulation
LOADS = 120
SPEEDS = 13


def table_loads(data: FrictionData) -> tuple[float, float]:
    """Smallest and largest load of a table [N]."""
    first, density, nodes = data.axes[0]
    smallest, largest = (
        (-place) ** (1.0 / LOAD_POWER) for place in (first, first + (nodes - 1) / density)
    )
    return float(smallest), float(largest)


def table_speeds(data: FrictionData) -> tuple[float, float]:
    """Smallest and largest entrainment speed of a table [m/s]."""
    first, density, nodes = data.axes[1]
    return exp(first), exp(first + (nodes - 1) / density)


def film(data: FrictionData, load: float, speed: float) -> float:
    """Central film of a table [m]; beyond its ends that at the end, but in proportion to slower
    speeds.

    `data`: of a race with a table; `load`, `speed`: Q [N] and entrainment speed u [m/s].
    """
    slowest, fastest = table_speeds(data)
    places = (
        load_place(float(np.clip(load, *table_loads(data)))),
        log(min(max(speed, slowest), fastest)),
    )
    values: Array = data.scalars[..., FILM]
    for place, (first, density, nodes) in zip(places, data.axes[:2], strict=True):
        start, weights = spline_weights((place - first) * density, int(nodes))
        values = np.tensordot(weights, values[start : start + 4], axes=1)
    return exp(float(values)) * min(1.0, speed / slowest)


def check_film(data: FrictionData, law: Array, name: str) -> None:
    """See that the load rises with the approach over a whole table: no film thickens faster than
    the bodies give way.

    `data`: of a race with a table; `law`, shape (3,): K [N/m^n], n [-], chi [-]; `name`: of the
    race.

    Raises
    ------
    ValueError
        Where a film rises with the load so steeply.
    """
    loads = np.geomspace(*table_loads(data), LOADS)
    approach = (loads / law[STIFFNESS]) ** (1.0 / law[EXPONENT])
    for speed in np.geomspace(*table_speeds(data), SPEEDS):
        films = np.array([film(data, float(load), float(speed)) for load in loads])
        if np.any(np.diff(approach - films) <= 0.0):
            where = loads[int(np.argmin(np.diff(approach - films)))]
            raise ValueError(
                f"lubricated contact: the film of the {name} race's table rises near {where:.3g} "
                f"N and {speed:.3g} m/s faster than the bodies give way; make a finer table "
                "(oilfilm table --points)"
            )
