"""The film that a table shears: Newtonian, without sliding, with its heat where the table has it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...generalized.solver import solve_generalized
from ...oil.rheology import Rheology
from ...options import SolverOptions
from ...solution import ContactSolution
from ...solver import solve_contact
from ..heated.lines import WarmNodes, warm_forces, warm_nodes
from ..quadrature import FilmNodes, film_nodes, sliding_forces
from .table import TableContact

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class TableFilm:
    """A solved film and its nodes, ready to shear."""

    solution: ContactSolution
    nodes: FilmNodes | WarmNodes

    @property
    def central(self) -> float:
        """Central film [m]: extrapolated; with heat that of the finest grid, as on the others heat
        is not at rest.
        """
        found = self.solution.film_central_dimensionless
        scale = self.solution.film_scale
        assert scale is not None  # of conditions with dimensions
        return scale * (found.finest if isinstance(self.nodes, WarmNodes) else found.value)

    def forces(self, slide: tuple[Array, Array, Array], rolling: Array, curvature: float) -> Array:
        """F_x, F_y [N] and M_n, M_y [N m] on body 1 by sliding, as `quadrature.sliding_forces`."""
        if isinstance(self.nodes, WarmNodes):
            return warm_forces(self.nodes, slide, rolling, curvature)
        return sliding_forces(self.nodes, slide, rolling, curvature)


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
        If the film has no usable answer: the message names load and speed.
    """
    conditions = contact.conditions(load, speed)
    if contact.solids is None:
        solution = solve_contact(conditions, options)
        _require_film(solution, load, speed)
        nodes = film_nodes(
            solution, contact.rheology, largest_slide, temperature=contact.temperature
        )
        return TableFilm(solution=solution, nodes=nodes)
    warm = solve_generalized(
        conditions,
        Rheology(),
        solids=contact.solids,
        oil_temperature=contact.temperature,
        options=options,
    )
    _require_film(warm.contact, load, speed)
    return TableFilm(
        solution=warm.contact,
        nodes=warm_nodes(warm, contact.solids, contact.rheology, largest_slide),
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
