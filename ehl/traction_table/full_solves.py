"""Effects that the films of a traction table leave out: their traction compared with full solves
of contacts that slide.

A table shears films that were solved Newtonian and without sliding. In a full solve the oil's
rheology, and heat where the table has it, act in film and flow, at the sliding of the contact
(`solve_generalized`). Both without spin and curvature slip. The limiting stress has no finite
tangent for the flow: the full solve leaves it out, and it is applied to the stress in the middle
of the film.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..generalized.solver import solve_generalized
from ..oil.rheology import limiting_stress
from ..oil.shear_stress import limited
from ..options import SolverOptions
from ..traction.shear import dimensional_grid
from .film import table_film
from .table import FullSolve, TableContact, TableRange, latin_hypercube

SLIDE_RATIOS = (1.0e-3, 0.1)  # between which the slide-roll ratios of the samples lie [-]
SEED = 90731  # of the samples
POINTS = 129  # of the films
Progress = Callable[[int, int, str], None]  # done, in all, what


def full_solves(
    contact: TableContact,
    limits: TableRange,
    count: int,
    options: SolverOptions | None = None,
    progress: Progress | None = None,
) -> tuple[FullSolve, ...]:
    """Compare the traction of a table's films with full solves at random points of its range.

    The points are a Latin hypercube in the logarithms of load, speed and slide-roll ratio.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    count : int
        number of points [-]
    options : SolverOptions | None, optional
        options of both solves; None: 129 points
    progress : Progress | None, optional
        called with the solve begun, solves in all, and the kind of step

    Returns
    -------
    tuple[FullSolve, ...]
        traction and film of both, a point each

    Raises
    ------
    ValueError
        if properties are missing that heat needs
    """
    options = options or SolverOptions(points=POINTS)
    ratios = (SLIDE_RATIOS[0], min(SLIDE_RATIOS[1], limits.slide_x))
    ends = np.log([limits.load, limits.speed, ratios])
    positions = np.exp(latin_hypercube(ends, count, np.random.default_rng(SEED))).T
    solves = []
    for number, (load, speed, ratio) in enumerate(positions.tolist()):
        if progress is not None:
            progress(number + 1, count, "full solves")
        solves.append(_both(contact, load, speed, ratio, options))
    return tuple(solves)


def _both(
    contact: TableContact, load: float, speed: float, ratio: float, options: SolverOptions
) -> FullSolve:
    """At a load [N], speed [m/s] and slide-roll ratio [-]."""
    film = table_film(contact, load, speed, options)
    rolling = np.array([speed / contact.radius_x])
    none = np.zeros(1)
    by_film = abs(
        float(film.sliding_forces((np.array([ratio * speed]), none, none), rolling, 0.0)[0, 0])
    )

    full = solve_generalized(
        replace(contact.conditions(load, speed), slide_roll_ratio=ratio),
        contact.rheology.unlimited,
        solids=contact.solids,
        oil_temperature=contact.temperature,
        options=options,
    )
    if full.mid_stress is None:  # Newtonian without heat: the film of the table
        in_full = by_film
    else:
        x, y, _ = dimensional_grid(full.contact)
        # columns without oil have none
        stress = np.where(np.isfinite(full.mid_stress[0]), full.mid_stress[0], 0.0)
        if contact.rheology.limiting_coefficient is not None:
            mean = contact.temperature if full.mean_temperature is None else full.mean_temperature
            limit = limiting_stress(full.contact.pressure, contact.rheology, mean)
            stress = np.copysign(limited(np.abs(stress), limit, contact.rheology.law), stress)
        in_full = abs(float(np.trapezoid(np.trapezoid(stress, y, axis=1), x)))
    solutions = (full.contact, film.solution)
    films = [solution.film_central_dimensionless.finest for solution in solutions]
    return FullSolve(
        load=load,
        speed=speed,
        slide_ratio=ratio,
        by_film=by_film / load,
        in_full=in_full / load,
        film_ratio=float(films[0] / films[1]),
        converged=all(solution.converged for solution in solutions)
        and bool(np.isfinite([in_full, *films]).all()),
    )
