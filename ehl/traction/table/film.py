"""The film that a table shears: Newtonian, without sliding, with heat where the table has it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...generalized.solver import solve_generalized
from ...oil.rheology import Rheology
from ...options import SolverOptions
from ...solution import ContactSolution
from ...solver import solve_contact
from ..film_quadrature import FilmQuadrature, film_quadrature, sliding_forces
from ..heated.film import HeatedFilm, heated_film, heated_forces
from .table import TableContact

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class TableFilm:
    """A solved film and its quadrature, ready to shear."""

    solution: ContactSolution
    quadrature: FilmQuadrature | HeatedFilm

    @property
    def central(self) -> float:
        """Central film [m]: extrapolated; with heat that of the finest grid, as on the others heat
        is not in equilibrium.
        """
        film = self.solution.film_central_dimensionless
        scale = self.solution.film_scale
        assert scale is not None  # of conditions with dimensions
        return scale * (film.finest if isinstance(self.quadrature, HeatedFilm) else film.value)

    def forces(self, slide: tuple[Array, Array, Array], rolling: Array, curvature: float) -> Array:
        """F_x, F_y [N] and M_n, M_y [N m] on body 1 by sliding, as `sliding_forces`."""
        if isinstance(self.quadrature, HeatedFilm):
            return heated_forces(self.quadrature, slide, rolling, curvature)
        return sliding_forces(self.quadrature, slide, rolling, curvature)


def table_film(
    contact: TableContact, load: float, speed: float, largest_slide: float, options: SolverOptions
) -> TableFilm:
    """Solve the film of a table's contact.

    Parameters
    ----------
    contact : TableContact
    load, speed : float
        [N], of entrainment [m/s].
    largest_slide : float
        Sliding speed [m/s] at which the friction of each node is weighed.
    options : SolverOptions

    Raises
    ------
    ValueError
        If the film cannot be used: the message names load and speed.
    """
    conditions = contact.conditions(load, speed)
    rheology = contact.rheology
    temperature = contact.temperature
    solids = contact.solids
    if solids is None:
        solution = solve_contact(conditions, options)
        _require_film(solution, load, speed)
        plain = film_quadrature(solution, rheology, largest_slide, temperature=temperature)
        return TableFilm(solution=solution, quadrature=plain)
    thermal = solve_generalized(
        conditions, Rheology(), solids=solids, oil_temperature=temperature, options=options
    )
    _require_film(thermal.contact, load, speed)
    return TableFilm(
        solution=thermal.contact, quadrature=heated_film(thermal, solids, rheology, largest_slide)
    )


def _require_film(solution: ContactSolution, load: float, speed: float) -> None:
    if (
        solution.film_central is None
        or not solution.film_central > 0.0
        or solution.x is None
        or solution.y is None
    ):
        raise ValueError(
            f"no film at a load of {load:.4g} N and {speed:.4g} m/s: {solution.message}"
        )
