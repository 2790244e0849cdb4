"""What the films of a traction table leave out: their traction beside that of full solves of contacts that slide.

A table shears films that were solved isothermal, Newtonian and without sliding. In a full solve the oil's rheology, and
heat where asked for, act in film and flow, at the sliding of the contact (`solve_generalized`). Both without spin and
curvature slip. The limiting stress has no finite tangent for the flow: the full solve goes without, and it is put on
top of the stress in the middle of the film.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..options import SolverOptions
from ..rheology import limiting_stress
from ..thermal import SolidThermal
from .kinematics import ContactKinematics
from .shear import integrate_traction
from .table import TableContact, TableRange

Array = NDArray[np.float64]

SLIDE_RATIOS = (1.0e-3, 0.1)  # between which the slide-roll ratios of the samples lie [-]
SEED = 90731  # of the samples
POINTS = 129  # of the films
Progress = Callable[[int, int, str], None]  # done, in all, what


@dataclass(frozen=True, slots=True, kw_only=True)
class FullSolve:
    """One contact both ways.

    Attributes
    ----------
    load : float
        [N].
    speed : float
        Entrainment speed [m/s].
    slide_ratio : float
        Sliding over the entrainment speed [-].
    by_film, in_full : float
        Force of sliding over the load, sheared on the table's film and in the full solve [-]; not a number where the
        solve ran away.
    film_ratio : float
        Central film of the full solve over that of the table's film [-]; likewise.
    converged : bool
        Whether both solves did.
    """

    load: float
    speed: float
    slide_ratio: float
    by_film: float
    in_full: float
    film_ratio: float
    converged: bool


def full_solves(
    contact: TableContact,
    limits: TableRange,
    count: int,
    solids: tuple[SolidThermal, SolidThermal] | None = None,
    options: SolverOptions | None = None,
    progress: Progress | None = None,
) -> tuple[FullSolve, ...]:
    """The approximation of a table beside full solves at random places of its range.

    Parameters
    ----------
    contact : TableContact
    limits : TableRange
        Loads [N], speeds [m/s], motions [-].
    count : int
        Of the places: a Latin hypercube in the logarithms of load, speed and slide-roll ratio.
    solids : tuple of SolidThermal, optional
        Both bodies; None: the oil stays at its temperature.
    options : SolverOptions, optional
        Of both solves; 129 points unless told.
    progress : callable, optional
        Called with the solve begun, solves in all, and a word.

    Returns
    -------
    tuple of FullSolve

    Raises
    ------
    ValueError
        If properties that heat needs are missing; the message names them.
    """
    options, found = options or SolverOptions(points=POINTS), []
    for number, (load, speed, ratio) in enumerate(_places(limits, count)):
        if progress is not None:
            progress(number + 1, count, "full solves")
        found.append(_both(contact, (float(load), float(speed), float(ratio)), solids, options))
    return tuple(found)


def _places(limits: TableRange, count: int) -> Array:
    """Loads [N], speeds [m/s] and slide-roll ratios [-], shape (count, 3)."""
    rng = np.random.default_rng(SEED)
    ends = np.log([limits.load, limits.speed, (SLIDE_RATIOS[0], min(SLIDE_RATIOS[1], limits.slide_x))])
    shares = (np.stack([rng.permutation(count) for _ in range(3)]) + rng.random((3, count))) / count
    return np.asarray(np.exp(ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * shares).T, dtype=np.float64)


def _both(
    contact: TableContact,
    place: tuple[float, float, float],
    solids: tuple[SolidThermal, SolidThermal] | None,
    options: SolverOptions,
) -> FullSolve:
    from ..generalized_solver import solve_generalized
    from ..solver import solve_contact

    load, speed, ratio = place
    conditions = contact.conditions(load, speed)
    film = solve_contact(conditions, options)
    motion = ContactKinematics(entrainment_speed=speed, sliding_x=ratio * speed, rolling=speed / contact.radius_x)
    sheared = integrate_traction(film, motion, contact.rheology, temperature=contact.temperature)

    unlimited = replace(contact.rheology, limiting_coefficient=None)
    sliding = replace(conditions, slide_roll_ratio=ratio)
    full = solve_generalized(
        sliding, unlimited, solids=solids, oil_temperature=contact.temperature if solids else None, options=options
    )
    if full.mid_stress is None:  # Newtonian without heat: the film of the table
        force = integrate_traction(full.contact, motion, contact.rheology, temperature=contact.temperature)
        in_full = abs(force.sliding_force_x)
    else:
        x, y, p = full.contact.x, full.contact.y, full.contact.pressure
        assert x is not None and y is not None and p is not None  # of conditions with dimensions
        stress = np.where(np.isfinite(full.mid_stress[0]), full.mid_stress[0], 0.0)  # columns without oil have none
        stress = _limited(stress, p, contact)
        in_full = abs(float(np.trapezoid(np.trapezoid(stress, y, axis=1), x)))
    films = (full.contact.film_central_dimensionless.finest, film.film_central_dimensionless.finest)
    return FullSolve(
        load=load,
        speed=speed,
        slide_ratio=ratio,
        by_film=abs(sheared.sliding_force_x) / load,
        in_full=in_full / load,
        film_ratio=float(films[0] / films[1]),
        converged=bool(film.converged and full.contact.converged and np.isfinite([in_full, *films]).all()),
    )


def _limited(stress: Array, pressure: Array, contact: TableContact) -> Array:
    """A stress of the base law with the limiting one on top, tau_L [1 - exp(-tau/tau_L)] [Pa]."""
    if contact.rheology.limiting_coefficient is None:
        return stress
    limit = limiting_stress(pressure, contact.rheology, contact.temperature)
    return np.asarray(-limit * np.expm1(-np.abs(stress) / limit) * np.sign(stress), dtype=np.float64)
