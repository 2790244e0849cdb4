"""What the films of a traction table leave out: their traction compared with full solves of
contacts that slide.

A table shears films that were solved Newtonian and without sliding. In a full solve the oil's
rheology, and heat where the table has it, act in film and flow, at the sliding of the contact
(`solve_generalized`). Both without spin and curvature slip. The limiting stress has no finite
tangent for the flow: the full solve leaves it out, and it is applied to the stress in the middle
of the film.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array
from ...generalized.solver import solve_generalized
from ...oil.rheology import limiting_stress
from ...options import SolverOptions
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
    """Traction of a table's films and of full solves at random places of its range.

    The places are a Latin hypercube in the logarithms of load, speed and slide-roll ratio.
    options: of both solves; progress: called with the solve begun, solves in all, and the kind of
    step. ValueError names missing properties that heat needs.
    """
    options = options or SolverOptions(points=POINTS)
    solves = []
    for number, place in enumerate(_places(limits, count)):
        if progress is not None:
            progress(number + 1, count, "full solves")
        solves.append(_both(contact, (float(place[0]), float(place[1]), float(place[2])), options))
    return tuple(solves)


def _places(limits: TableRange, count: int) -> Array:
    """Loads [N], speeds [m/s] and slide-roll ratios [-], shape (count, 3)."""
    ratios = (SLIDE_RATIOS[0], min(SLIDE_RATIOS[1], limits.slide_x))
    ends = np.log([limits.load, limits.speed, ratios])
    return np.exp(latin_hypercube(ends, count, np.random.default_rng(SEED))).T


def _both(
    contact: TableContact, place: tuple[float, float, float], options: SolverOptions
) -> FullSolve:
    """At a load [N], speed [m/s] and slide-roll ratio [-]."""
    load, speed, ratio = place
    film = table_film(contact, load, speed, ratio * speed, options)
    rolling = np.array([speed / contact.radius_x])
    none = np.zeros(1)
    by_film = abs(float(film.forces((np.array([ratio * speed]), none, none), rolling, 0.0)[0, 0]))

    full = solve_generalized(
        replace(contact.conditions(load, speed), slide_roll_ratio=ratio),
        contact.rheology.unlimited,
        solids=contact.solids,
        oil_temperature=None if contact.solids is None else contact.temperature,
        options=options,
    )
    if full.mid_stress is None:  # Newtonian without heat: the film of the table
        in_full = by_film
    else:
        x, y, p = full.contact.x, full.contact.y, full.contact.pressure
        assert x is not None and y is not None and p is not None  # of conditions with dimensions
        # columns without oil have none
        stress = np.where(np.isfinite(full.mid_stress[0]), full.mid_stress[0], 0.0)
        stress = _limited(stress, p, full.mean_temperature, contact)
        in_full = abs(float(np.trapezoid(np.trapezoid(stress, y, axis=1), x)))
    films = (
        full.contact.film_central_dimensionless.finest,
        film.solution.film_central_dimensionless.finest,
    )
    return FullSolve(
        load=load,
        speed=speed,
        slide_ratio=ratio,
        by_film=by_film / load,
        in_full=in_full / load,
        film_ratio=float(films[0] / films[1]),
        converged=bool(
            film.solution.converged
            and full.contact.converged
            and np.isfinite([in_full, *films]).all()
        ),
    )


def _limited(
    stress: Array, pressure: Array, temperature: Array | None, contact: TableContact
) -> Array:
    """A stress of the base law bounded by the limiting one, tau_L [1 - exp(-tau/tau_L)] [Pa]."""
    if contact.rheology.limiting_coefficient is None:
        return stress
    limit = limiting_stress(
        pressure, contact.rheology, contact.temperature if temperature is None else temperature
    )
    return np.asarray(
        -limit * np.expm1(-np.abs(stress) / limit) * np.sign(stress), dtype=np.float64
    )
