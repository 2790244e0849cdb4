"""The short verification of an installation: closed forms, and contacts solved by other methods.

The references are numbers: closed forms of Hertz (1882) and Kapitza (1955), and films by finite
elements (docs/validation/verification.md, which `python tools/verification/run.py` computes).
"""

from collections.abc import Iterator
from concurrent.futures import as_completed
from dataclasses import dataclass
from math import cbrt, log2, pi, sqrt

import numpy as np
from scipy.special import ellipe, ellipk

from oilfilm.ehl import (
    ContactConditions,
    ContactSolution,
    DensityLaw,
    Lubricant,
    MoesConditions,
    SolverOptions,
    ViscosityLaw,
    solve_contact,
)
from oilfilm.ehl.closed_form.hertz import ellipse_ratio, hertz_coefficients, hertz_contact
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.multigrid.threads import cores, film_threads
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solid.deformation import deflect, deflection_kernel

OIL = Lubricant(viscosity=0.05, pressure_viscosity=22e-9, roelands_z=0.68)
ISOVISCOUS = Lubricant(
    viscosity=0.05,
    pressure_viscosity=20e-9,
    viscosity_law=ViscosityLaw.ISOVISCOUS,
    density_law=DensityLaw.INCOMPRESSIBLE,
)
REMAINDER = 1e-3  # of a film, beyond the error bars of both methods [-]
# central film with Reynolds' condition over that of half of Kapitza's pressure at R_x = R_y, by
# finite volumes [-]; M and the relative tolerance on a coarse and on a fine grid
RIGID = 1.2501
RIGID_LOAD = 0.25
RIGID_TOLERANCE = {True: 0.02, False: 0.005}
POINTS = {True: 129, False: 513}  # of the contacts, quick and not
RIGID_POINTS = {True: 257, False: 1025}


@dataclass(frozen=True, slots=True)
class Check:
    """A statement, its computed number and the bounds that it must keep [-]."""

    name: str
    value: float
    least: float
    most: float

    @property
    def passed(self) -> bool:
        """Tell if the number lies within its bounds; not a number does not."""
        return self.least <= self.value <= self.most


@dataclass(frozen=True, slots=True, kw_only=True)
class Reference:
    """A contact, and its films by finite elements with their error bars [a^2/R_x]."""

    name: str
    conditions: ContactConditions | MoesConditions
    central: tuple[float, float]
    minimum: tuple[float, float]
    domain: tuple[float, float, float] | None = None  # [Hertz half-extents]


CONTACTS = (
    Reference(
        name="M 20, L 10",
        conditions=MoesConditions(load_parameter=20.0, lubricant_parameter=10.0, lubricant=OIL),
        domain=(-4.5, 1.5, 3.0),
        central=(0.43085, 0.00015),
        minimum=(0.29267, 0.00019),
    ),
    Reference(
        name="M 20, L 5, R_x/R_y 0.4, entrainment at 0.6 rad",
        conditions=MoesConditions(
            load_parameter=20.0,
            lubricant_parameter=5.0,
            radius_ratio=0.4,
            entrainment_angle=0.6,
            lubricant=OIL,
        ),
        central=(0.5120, 0.0007),
        minimum=(0.3771, 0.0019),
    ),
    Reference(
        name="6208 inner race, 300 N",
        conditions=ContactConditions(
            load=300.0,
            radius_x=1.0 / (1.0 / 6e-3 + 1.0 / 24e-3),
            radius_y=1.0 / (1.0 / 6e-3 - 1.0 / 6.17e-3),
            reduced_modulus=310e9 / (1.0 - 0.26**2),
            entrainment_speed=15.0796,
            lubricant=Lubricant(viscosity=0.0261, pressure_viscosity=18e-9),
        ),
        central=(0.5674, 0.0005),
        minimum=(0.5096, 0.0018),
    ),
)


def checks(*, quick: bool = False) -> Iterator[Check]:
    """Yield all checks, each as soon as its number is there.

    Parameters
    ----------
    quick : bool
        Coarse grids with wider error bars.

    Yields
    ------
    Check
    """
    yield from closed_forms()
    points = POINTS[quick]
    with film_threads(cores()) as pool:
        rigid = pool.submit(rigid_film, RIGID_POINTS[quick], RIGID_TOLERANCE[quick])
        jobs = {pool.submit(_solution, contact, points): contact for contact in CONTACTS}
        for job in as_completed(jobs):
            yield from film_checks(jobs[job], job.result())
        yield rigid.result()


def closed_forms() -> Iterator[Check]:
    """Dry contacts beside Hertz's circle, complete elliptic integrals, and his deflection."""
    load = 50.0
    radius = 0.01
    modulus = 226e9
    circle = cbrt(1.5 * load * radius / modulus)
    difference = abs(hertz_contact(load, radius, radius, modulus).semi_axis_x / circle - 1.0)
    yield Check("Hertz, circle, relative difference", difference, 0.0, 1e-12)
    ratio = 0.05
    k = ellipse_ratio(ratio)
    m = 1.0 - 1.0 / k**2
    radii = (k**2 * ellipe(m) - ellipk(m)) / (ellipk(m) - ellipe(m))  # R_y/R_x
    difference = abs(float(ratio * radii) - 1.0)
    yield Check("Hertz, ellipse, relative difference", difference, 0.0, 1e-9)
    coarse, fine = (_deflection_error(cells) for cells in (128, 256))
    yield Check("order of the deflection under Hertz' pressure", log2(coarse / fine), 1.4, 2.3)


def _deflection_error(cells: int) -> float:
    """Root-mean-square difference of the deformed gap from a constant inside the circle [-]."""
    f, g, d = hertz_coefficients(1.0)
    h = 4.0 / cells
    grid = Grid(x_in=-2.0, hx=h, hy=h, nx=cells + 1, ny=cells // 2 + 1, symmetric=True)
    square = grid.X[None, :] ** 2 + grid.Y[:, None] ** 2
    pressure = np.sqrt(np.maximum(1.0 - square, 0.0))
    gap = deflect(deflection_kernel(grid, 2.0 * g / (pi * f)), pressure) + 0.5 * square
    return float(np.sqrt(np.mean((gap[square < 1.0] - d / f**2) ** 2)))


def rigid_film(points: int, tolerance: float) -> Check:
    """Compare the film between rigid surfaces with `RIGID` times that of Kapitza [-].

    Parameters
    ----------
    points : int
        Nodes along the entrainment [-].
    tolerance : float
        Relative difference that is allowed [-].

    Returns
    -------
    Check
        The comparison.
    """
    conditions = MoesConditions(
        load_parameter=RIGID_LOAD, lubricant_parameter=0.0, lubricant=ISOVISCOUS
    )
    film = solve_contact(conditions, SolverOptions(points=points)).film_central_dimensionless
    contact = scale_contact(conditions)
    kapitza = (contact.speed * pi * sqrt(2.0) / (5.0 * contact.load)) ** 2
    value = film.value / (RIGID * kapitza)
    return Check(
        f"rigid film over Kapitza's with Reynolds' condition, M {RIGID_LOAD:g}",
        value,
        1.0 - tolerance,
        1.0 + tolerance,
    )


def _solution(contact: Reference, points: int) -> ContactSolution:
    return solve_contact(contact.conditions, SolverOptions(points=points, domain=contact.domain))


def film_checks(contact: Reference, solution: ContactSolution) -> Iterator[Check]:
    """Compare both films with the reference, within both error bars and 0.1 %.

    Parameters
    ----------
    contact : Reference
        The contact with its reference films.
    solution : ContactSolution
        The solved contact.

    Yields
    ------
    Iterator[Check]
        A comparison for the central and the minimum film.
    """
    films = (
        ("central", contact.central, solution.film_central_dimensionless),
        ("minimum", contact.minimum, solution.film_minimum_dimensionless),
    )
    for kind, (value, bar), film in films:
        allowed = bar + film.uncertainty + REMAINDER * value
        found = film.value if solution.converged and solution.resolved else np.nan
        yield Check(f"{kind} film, {contact.name}", float(found), value - allowed, value + allowed)
