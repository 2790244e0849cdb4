"""Laws of ball and race in the equations of motion: Hertz, solved films, linear springs."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ehl.arrays import Array
from ehl.closed_form.hertz import contact_stiffness
from ehl.conditions import ContactConditions
from ehl.options import SolverOptions
from ehl.traction.linear_response import NormalResponse, highest_frequency, normal_response

from ..contacts.contact import BearingContact
from ..films.asperities import Asperities
from ..films.operating import OilAtInlets, supplied_films
from ..geometry import Race, contact_modulus, reduced_radii
from ..quasistatic.solution import QuasistaticSolution
from ..supply.supply import AMPLE, InletFilm, Supply
from .arrays import ContactLawTable

NODES = 600  # of a law, over the logarithm of the approach
SPAN = (1e-4, 30.0)  # of approaches, over that of the largest load [-]
HERTZ = 1.5  # exponent of the force
# loads over the largest of a race, at which films are solved; stiffness over that of Hertz and
# damping change by some per cent between them
SOLVED_LOADS = (0.2, 1.0)
POINTS = 129  # and half of them; damping of the 6208 within 1.5 % of that from 257
STARVED_POINTS = 257  # behind a layer, where the damping is small and feels the mesh


class FilmsNotSolvedError(RuntimeError):
    """A film whose stiffness and damping could not be solved; the message says which."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedFilms:
    """Stiffness and damping of the contacts with one race, solved at some loads."""

    loads: Array  # [N]
    stiffness_ratio: Array  # over that of Hertz [-]
    damping: Array  # [N s/m]
    damping_uncertainty: Array  # [N s/m]
    frequency: float  # [Hz]
    film_share: float = 1.0  # of the load; the rest is on asperities, which damp nothing [-]


def mean_angle(solution: QuasistaticSolution, race: Race) -> float:
    """Contact angle of a race, mean over the balls by their loads.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway

    Returns
    -------
    float
        mean angle [rad]
    """
    inner = race is Race.INNER
    load = solution.inner_load if inner else solution.outer_load
    angle = solution.inner_contact_angle if inner else solution.outer_contact_angle
    return float(np.average(angle, weights=load)) if load.sum() > 0.0 else float(np.mean(angle))


def stiffness_factor(solution: QuasistaticSolution, race: Race) -> float:
    """K of Hertz' law Q = K d^1.5 at the load-weighted mean contact angle.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway

    Returns
    -------
    float
        K [N/m^1.5]
    """
    bearing = solution.bearing
    radii = reduced_radii(bearing, race, mean_angle(solution, race))
    return contact_stiffness(*radii, contact_modulus(bearing, race))


def heaviest(contacts: Sequence[BearingContact], race: Race) -> BearingContact:
    """The contact of a race with the largest load.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        contacts of the equilibrium
    race : Race
        raceway

    Returns
    -------
    BearingContact
        its most heavily loaded contact

    Raises
    ------
    ValueError
        if none is loaded
    """
    worst = max((c for c in contacts if c.race is race), key=lambda contact: contact.load)
    if not worst.load > 0.0:
        raise ValueError(f"no ball is loaded at the {race.value} race: nothing to vibrate on")
    return worst


def film_load_fractions(
    contacts: Sequence[BearingContact],
    asperities: Asperities,
    supply: Supply | InletFilm | None,
    balls: int,
) -> dict[Race, float]:
    """Load that the film of the heaviest contact of each race carries, over its whole load.

    Parameters
    ----------
    contacts : sequence of BearingContact
        All contacts of the bearing.
    asperities : Asperities
        Roughness of the surfaces and the law by which asperities carry load.
    supply : Supply or InletFilm or None
        Supply of oil that limits the films; None: flooded.
    balls : int
        Number of balls [-].

    Returns
    -------
    dict of Race to float
        Share of the film [-] of each race whose film a formula gives.
    """
    shares = {}
    for race in Race:
        contact = heaviest(contacts, race)
        oil = OilAtInlets(oil=supply or AMPLE, balls=balls)
        (film,) = supplied_films([contact], [None], oil)
        if film is not None:
            shares[race] = 1.0 - asperities.share(contact, film.central.value)
    return shares


def solved_films(
    contact: BearingContact, factor: float, frequency: float, options: SolverOptions | None = None
) -> SolvedFilms:
    """Response of a contact and of lighter ones at a frequency, or at the highest that a mesh
    carries.

    Parameters
    ----------
    contact : BearingContact
        contact of the equilibrium
    factor : float
        K of Hertz [N/m^1.5]
    frequency : float
        frequency of the response [Hz]
    options : SolverOptions | None, optional
        mesh of the films

    Returns
    -------
    SolvedFilms
        stiffness and damping at some loads

    Raises
    ------
    FilmsNotSolvedError
        if a film or its response is not solved
    """
    conditions = contact.conditions
    if conditions is None:
        raise FilmsNotSolvedError(f"{contact.race.value} race: {contact.note}")
    grid = options or SolverOptions(
        points=POINTS if conditions.inlet_layer is None else STARVED_POINTS
    )
    responses: list[tuple[float, float, NormalResponse]] = []
    for fraction in SOLVED_LOADS:
        lighter: ContactConditions = replace(conditions, load=fraction * conditions.load)
        at = min(frequency, highest_frequency(lighter))
        responses.append((lighter.load, at, normal_response(lighter, grid, (at,))))
        response = responses[-1][2]
        if not response.converged:
            where = f"film at the {contact.race.value} race under {lighter.load:.4g} N"
            raise FilmsNotSolvedError(f"{where}: {response.message}")
    loads = np.array([load for load, _, _ in responses])
    hertz = HERTZ * factor ** (2.0 / 3.0) * np.cbrt(loads)
    stiffness = np.array([response.stiffnesses[0].value for _, _, response in responses])
    # behind a layer it may be negative: bodies that close in feed the meniscus
    damping = np.array([response.dampings[0].value for _, _, response in responses])
    bars = np.array([response.dampings[0].uncertainty for _, _, response in responses])
    return SolvedFilms(
        loads=loads,
        stiffness_ratio=stiffness / hertz,
        damping=damping,
        damping_uncertainty=bars,
        frequency=min(at for _, at, _ in responses),
    )


def film_law(factor: float, films: SolvedFilms) -> ContactLawTable:
    """Law with the stiffness dQ/dd and the damping of solved films over the load.

    The damping of lighter contacts fades with the load.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    films : SolvedFilms
        solved films of the race

    Returns
    -------
    ContactLawTable
        law over the logarithm of the approach
    """
    largest = films.loads[-1]
    dry = (largest / factor) ** (2.0 / 3.0)
    loads = largest * np.geomspace(SPAN[0] ** HERTZ, SPAN[1] ** HERTZ, 4 * NODES)
    ratio = np.interp(np.log(loads), np.log(films.loads), films.stiffness_ratio)
    # d = integral of dQ/k, with the ratio constant between two loads
    hertz = (loads / factor) ** (2.0 / 3.0)
    steps = np.diff(hertz) * 0.5 * (1.0 / ratio[1:] + 1.0 / ratio[:-1])
    approach = hertz[0] / ratio[0] + np.concatenate([[0.0], np.cumsum(steps)])
    grid = np.geomspace(SPAN[0] * dry, SPAN[1] * dry, NODES)
    load = np.exp(np.interp(np.log(grid), np.log(approach), np.log(loads)))
    # damping negative at the one frequency is positive at those of balls: none, over time
    solved = np.maximum(films.damping, 0.0)
    damping = films.film_share * np.interp(np.log(load), np.log(films.loads), solved)
    damping *= np.minimum(load / films.loads[0], 1.0)
    return law_table(grid, load / grid**HERTZ, damping, HERTZ)


def dry_law(factor: float, largest: float, loss_time: float) -> ContactLawTable:
    """Hertz' law with a damping in proportion to its stiffness.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    largest : float
        largest load of the race [N]
    loss_time : float
        damping over stiffness [s]

    Returns
    -------
    ContactLawTable
        law over the logarithm of the approach
    """
    dry = (largest / factor) ** (2.0 / 3.0)
    grid = np.geomspace(SPAN[0] * dry, SPAN[1] * dry, NODES)
    damping = loss_time * HERTZ * factor * np.sqrt(grid)
    return law_table(grid, np.full(NODES, factor), damping, HERTZ)


def linear_law(factor: float, mean: float, largest: float, loss_time: float) -> ContactLawTable:
    """Spring k d with Hertz' stiffness k at the mean load of the loaded contacts.

    Parameters
    ----------
    factor : float
        K of Hertz [N/m^1.5]
    mean : float
        mean load [N]
    largest : float
        largest load of the race [N]
    loss_time : float
        damping over stiffness [s]

    Returns
    -------
    ContactLawTable
        law over the logarithm of the approach
    """
    stiffness = HERTZ * factor ** (2.0 / 3.0) * mean ** (1.0 / 3.0)
    grid = np.geomspace(SPAN[0], SPAN[1], NODES) * largest / stiffness
    damping = np.full(NODES, loss_time * stiffness)
    return law_table(grid, np.full(NODES, stiffness), damping, 1.0)


def law_table(approach: Array, factor: Array, damping: Array, exponent: float) -> ContactLawTable:
    """Law from its factor and damping at approaches even in their logarithm.

    The energy is the force's integral.

    Parameters
    ----------
    approach : Array
        approaches, shape (n,) [m]
    factor : Array
        elastic force over approach^n, shape (n,) [N/m^n]
    damping : Array
        shape (n,) [N s/m]
    exponent : float
        n [-]

    Returns
    -------
    ContactLawTable
        law for the kernels
    """
    logs = np.log(approach)
    power = exponent + 1.0
    slope = np.diff(factor) / np.diff(logs)
    edges = approach**power
    # integral of (f + s (u - u_0)) e^(p u) du = [(f/p - s/p^2) e^(p u)]
    upper = (factor[1:] / power - slope / power**2) * edges[1:]
    lower = (factor[:-1] / power - slope / power**2) * edges[:-1]
    energy = factor[0] / power * edges[0] + np.concatenate([[0.0], np.cumsum(upper - lower)])
    return ContactLawTable(
        first=float(logs[0]),
        step=float(logs[1] - logs[0]),
        table=np.ascontiguousarray(np.stack([factor, damping, energy / edges], axis=1)),
        exponent=exponent,
    )
