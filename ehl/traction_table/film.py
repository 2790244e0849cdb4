"""The film that a table shears: Newtonian, without sliding, with heat where the table has it; what
a table takes from it at a load and a speed.
"""

from dataclasses import dataclass
from math import exp

import numpy as np

from ..arrays import Array
from ..generalized.solver import solve_generalized
from ..oil.rheology import Rheology
from ..options import SolverOptions
from ..solution import ContactSolution
from ..traction.film_quadrature import FilmQuadrature, film_quadrature, sliding_forces
from ..traction.heated_film import HeatedFilm, heated_film, heated_forces
from ..traction.linear_response import NormalResponse, normal_response
from ..traction.rolling_moment import rolling_moment
from .table import TableContact, TableRange
from .vectorised_traction import vectorised_heated_forces, vectorised_sliding_forces

# scale over the motion where the traction has risen by half, along, across and of spin
SCALE_FRACTION = (0.004, 0.006, 0.16)
# motions over the largest ones, between which that one is interpolated
SCALE_SAMPLES = np.geomspace(1e-7, 1.0, 29)
RESPONSE_POINTS = 129  # of the films that stiffness and damping are taken from


@dataclass(frozen=True, slots=True, kw_only=True)
class TableFilm:
    """The quadrature of a film, ready to shear."""

    quadrature: FilmQuadrature | HeatedFilm  # nodes of the film
    central: float  # film [m]: extrapolated; with heat that of the finest grid
    converged: bool  # whether the film did

    def sliding_forces(
        self,
        slide: tuple[Array, Array, Array],
        rolling: Array,
        curvature: float,
        *,
        vectorised: bool = False,
    ) -> Array:
        """Sum the forces and moments of sliding on body 1 for many motions.

        Parameters
        ----------
        slide : tuple[Array, Array, Array]
            slide_x and slide_y [m/s], and spin [rad/s], each of shape (n,)
        rolling : Array
            relative rolling speed, shape (n,) [rad/s]
        curvature : float
            1/(2R) of the loaded surface across the entrainment [1/m]
        vectorised : bool, default False
            whether node clusters are used, faster for thousands of motions

        Returns
        -------
        Array
            F_x, F_y [N], M_n and M_y [N m], shape (n, 4)
        """
        if isinstance(self.quadrature, HeatedFilm):
            heated = vectorised_heated_forces if vectorised else heated_forces
            return heated(self.quadrature, slide, rolling, curvature)
        forces = vectorised_sliding_forces if vectorised else sliding_forces
        return forces(self.quadrature, slide, rolling, curvature)


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedFilm(TableFilm):
    """Quadrature of a film that was solved."""

    solution: ContactSolution  # of the contact


def table_film(
    contact: TableContact, load: float, speed: float, options: SolverOptions
) -> SolvedFilm:
    """Solve the film of a table's contact at a load and an entrainment speed.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    load : float
        load [N]
    speed : float
        entrainment speed [m/s]
    options : SolverOptions
        options of the solver

    Returns
    -------
    SolvedFilm
        film ready to shear

    Raises
    ------
    ValueError
        if the film cannot be used
    """
    conditions = contact.conditions(load, speed)
    rheology = contact.rheology
    temperature = contact.temperature
    solids = contact.solids
    thermal = solve_generalized(
        conditions, Rheology(), solids=solids, oil_temperature=temperature, options=options
    )
    solution = thermal.contact
    if solution.film_central is None or not solution.film_central > 0.0:
        place = f"a load of {load:.4g} N and {speed:.4g} m/s"
        raise ValueError(f"no film at {place}: {solution.message}")
    quadrature: FilmQuadrature | HeatedFilm
    if solids is None:
        quadrature = film_quadrature(solution, rheology, temperature=temperature)
    else:
        quadrature = heated_film(thermal, solids, rheology)
    film = solution.film_central_dimensionless
    scale = solution.film_scale
    assert scale is not None  # of conditions with dimensions
    return SolvedFilm(
        solution=solution,
        quadrature=quadrature,
        central=scale * (film.value if solids is None else film.finest),
        converged=solution.converged,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmSample:
    """A film of a table at a load and a speed, and what splines over both need of it."""

    place: tuple[float, float]  # ln(load), ln(speed) [-]
    film: TableFilm  # ready to shear
    scales: tuple[float, float, float]  # of slide_x/u, slide_y/u, spin R_x/u [-]
    moment: float  # hydrodynamic, of the oil up to its meniscus, positive [N m]
    response: NormalResponse | None  # stiffness and damping; None: not asked for
    # reason for solving a film that the atlas was to have, empty where it was not solved; None:
    # the atlas was not asked
    solved_because: str | None = None

    @property
    def load(self) -> float:
        """Load [N]."""
        return exp(self.place[0])

    @property
    def speed(self) -> float:
        """Entrainment speed [m/s]."""
        return exp(self.place[1])


def film_sample(
    contact: TableContact,
    limits: TableRange,
    place: tuple[float, float],
    points: int,
    response: bool = True,
) -> FilmSample:
    """Solve the film at a node of a table, and what splines over load and speed need of it.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    place : tuple[float, float]
        ln(load) and ln(speed), in [N] and [m/s]
    points : int
        nodes of the film along x [-]
    response : bool, default True
        whether stiffness and damping are solved

    Returns
    -------
    FilmSample
        film with its scales, moment and response

    Raises
    ------
    ValueError
        if the film cannot be used
    """
    load = exp(place[0])
    speed = exp(place[1])
    film = table_film(contact, load, speed, SolverOptions(points=points))
    solution = film.solution
    return FilmSample(
        place=place,
        film=film,
        scales=motion_scales(contact, limits, film, speed),
        moment=rolling_moment(solution).value,
        response=_response(contact, (load, speed), points) if response else None,
    )


def _response(contact: TableContact, place: tuple[float, float], points: int) -> NormalResponse:
    """Evaluate the response of the isothermal film at a load [N] and speed [m/s], on few points
    where that converges.
    """
    for count in sorted({min(points, RESPONSE_POINTS), points}):
        response = normal_response(contact.conditions(*place), SolverOptions(points=count))
        if response.converged:
            break
    return response


def motion_scales(
    contact: TableContact, limits: TableRange, film: TableFilm, speed: float
) -> tuple[float, float, float]:
    """Find the motions at a fraction of those where traction or spin moment is half.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    film : TableFilm
        film ready to shear
    speed : float
        entrainment speed [m/s]

    Returns
    -------
    slide_x
        scale of slide_x/u [-]
    slide_y
        scale of slide_y/u [-]
    spin
        scale of the spin R_x/u [-]
    """
    none = np.zeros(SCALE_SAMPLES.size)
    scales = []
    for axis, (limit, fraction) in enumerate(zip(limits.motions, SCALE_FRACTION, strict=True)):
        motion = limit * SCALE_SAMPLES
        motions = [motion if axis == k else none for k in range(3)]
        values = relative_forces(contact, film, speed, motions)[:, axis]
        start = relative_forces(contact, film, speed, [none[:1]] * 3)[0, axis]
        rise = np.abs(values - start) / np.abs(values - start).max()
        k = max(int(np.argmax(rise >= 0.5)), 1)
        between = (0.5 - rise[k - 1]) / (rise[k] - rise[k - 1])
        scales.append(fraction * float(motion[k - 1] + between * (motion[k] - motion[k - 1])))
    return scales[0], scales[1], scales[2]


def relative_forces(
    contact: TableContact,
    film: TableFilm,
    speed: float,
    motions: list[Array],
    *,
    vectorised: bool = False,
) -> Array:
    """Sum the forces and moments of sliding on body 1, by motions over the entrainment speed.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    film : TableFilm
        film ready to shear
    speed : float
        entrainment speed u [m/s]
    motions : list[Array]
        slide_x/u, slide_y/u and spin R_x/u, each of shape (n,) [-]
    vectorised : bool, default False
        whether node clusters are used, faster for thousands of motions

    Returns
    -------
    Array
        F_x, F_y [N], M_n and M_y [N m], shape (n, 4)
    """
    slide_x = motions[0] * speed
    slide = (slide_x, motions[1] * speed, motions[2] * speed / contact.radius_x)
    rolling = speed / contact.radius_x - 0.5 * contact.curvature_difference * slide_x
    return film.sliding_forces(
        slide, rolling, 0.5 / contact.curvature_radius, vectorised=vectorised
    )
