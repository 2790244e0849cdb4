"""Gross slip of balls after Hirano: slip factors, critical loads, minimum preload, and catalogue
minimum loads.

Hirano (1965) found that the balls of angular contact bearings slip as a whole where the axial part
of the inner contact load falls below about ten times the centrifugal force, SF = Qi |sin ai|/Fc <
10. The axial balance of the inner ring holds the mean of the factors of Z balls at Fa/(Z Fc) or
below, so no preload below 10 Z Fc can be enough. The source of 1965 was not at hand; the criterion
is that quoted by Wang et al. (2024), Eqs. (17) to (20).
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import isfinite, nan
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.options import require_positive
from oilfilm.ehl.units import MILLIMETRE, RPM

from ..geometry import Bearing
from ..operation import Operation, QuasistaticModel
from ..quasistatic.balls import ball_problem
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic

HIRANO_LIMIT = 10.0  # slip factor below which a ball slips, Hirano (1965) [-]
# wherever it is printed; measured at 3000 to 12 000 r/min, docs/validation/validation_000.md
HIRANO_CAVEAT = (
    "Hirano's criterion is cautious: simulations of a 7008 skid at a fourth to a fifth of the "
    "load that it asks for"
)
SIMULATED_SLIP = 0.25  # of Hirano's limit, below which simulations skid, likewise [-]
LOAD_RTOL = 1.0e-7  # of critical loads [-]
# search for a preload: first trial over the least possible one, growth, trials [-]. The first
# must lie below 1; the balls share the load unevenly, so the last lies 700 times above. Loads of
# the shipped 7000C at 10 000 to 60 000 r/min and 0 to 200 N are the same to 1e-7, `LOAD_RTOL`,
# with half the first trial, growth 1.1 or 1.4, and half or twice the number of trials.
FIRST_TRIAL = 0.6
TRIAL_GROWTH = 1.2
TRIALS = 40
# lightest axial load of the search for critical loads, over the least possible preload [-]; half
# or twice of it changes none of the same loads
LIGHTEST_TRIAL = 0.02
EQUALITY_DIGITS = 9  # of the factors of two balls that count as one

# map, or the map of a pool
Mapper = Callable[[Callable[[Any], Any], Iterable[Any]], Iterable[Any]]


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipStudy:
    """A bearing whose axial load and speed vary; other loads and tilt as in `operation`."""

    bearing: Bearing
    operation: Operation  # its axial direction must be loaded, not displaced
    model: QuasistaticModel
    limit: float = HIRANO_LIMIT  # slip factor below which a ball slips [-]

    def __post_init__(self) -> None:
        if self.operation.force[0] is None:
            raise ValueError(
                "operation: slip maps vary the axial load, so x must have a force, not a "
                "displacement"
            )
        require_positive(self, "limit")

    def solve(
        self, speed: float, axial_load: float, initial_guess: QuasistaticSolution | None = None
    ) -> QuasistaticSolution | None:
        """Equilibrium at an inner speed and axial load.

        Parameters
        ----------
        speed : float
            speed of the inner ring [rad/s]
        axial_load : float
            load along x [N]
        initial_guess : QuasistaticSolution | None, optional
            converged solution of a similar state

        Returns
        -------
        QuasistaticSolution | None
            equilibrium; None if there is none
        """
        operation = replace(
            self.operation, inner_speed=speed, force=(axial_load, *self.operation.force[1:])
        )
        solution = solve_quasistatic(self.bearing, operation, self.model, initial_guess)
        return solution if solution.converged else None

    def least_preload(self, speed: float) -> float:
        """Axial load limit Z Fc below which a ball must slip.

        Parameters
        ----------
        speed : float
            speed of the inner ring [rad/s]

        Returns
        -------
        float
            load [N]
        """
        problem = ball_problem(self.bearing, speed, self.operation.outer_speed, self.model)
        return self.limit * self.bearing.balls * problem.nominal_force


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipSurface:
    """Slip factors (n, F, Z) [-] over speeds [rad/s] and axial_loads [N], NaN unsolved."""

    speeds: Array
    axial_loads: Array
    factors: Array

    @property
    def minimum(self) -> Array:
        """Factor of the worst ball [-], shape (n, F)."""
        return np.asarray(self.factors.min(axis=2))

    @property
    def unsolved(self) -> int:
        """Number of points without an equilibrium [-]."""
        return int(np.isnan(self.minimum).sum())


@dataclass(frozen=True, slots=True, kw_only=True)
class CriticalCurves:
    """Axial load [N], shape (R, Z), at which each ball just slips, over radial_loads [N]."""

    speed: float
    radial_loads: Array
    axial_loads: Array


def slip_factors(solution: QuasistaticSolution) -> Array:
    """SF = Qi |sin ai|/Fc of every ball, Hirano (1965); infinite at rest.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    Array
        factors, shape (Z,) [-]
    """
    axial = solution.inner_load * np.abs(np.sin(solution.inner_contact_angle))
    force = solution.centrifugal_force
    factors: Array = np.where(force > 0.0, axial / np.where(force > 0.0, force, 1.0), np.inf)
    return factors


def slip_row(study: SlipStudy, axial_loads: Sequence[float], speed: float) -> Array:
    """Slip factors over axial loads at one speed, each solution the start of the next.

    Parameters
    ----------
    study : SlipStudy
        bearing and its other loads
    axial_loads : Sequence[float]
        loads along x, shape (F,) [N]
    speed : float
        speed of the inner ring [rad/s]

    Returns
    -------
    Array
        factors, NaN without an equilibrium, shape (F, Z) [-]
    """
    factors = np.full((len(axial_loads), study.bearing.balls), nan)
    last = None
    # from the heaviest load, which converges most easily
    for index in np.argsort(axial_loads)[::-1]:
        solution = study.solve(speed, float(axial_loads[index]), last)
        if solution is not None:
            factors[index] = slip_factors(solution)
            last = solution
    return factors


def slip_surface(
    study: SlipStudy, speeds: Sequence[float], axial_loads: Sequence[float], mapper: Mapper = map
) -> SlipSurface:
    """Slip factors of every ball over speeds of the inner ring and axial loads.

    Parameters
    ----------
    study : SlipStudy
        bearing and its other loads
    speeds : Sequence[float]
        speeds of the inner ring, shape (n,) [rad/s]
    axial_loads : Sequence[float]
        loads along x, shape (F,) [N]
    mapper : Mapper, default map
        `map`, or the map of a pool that distributes the rows

    Returns
    -------
    SlipSurface
        factors over both
    """
    rows = mapper(partial(slip_row, study, tuple(axial_loads)), [float(n) for n in speeds])
    return SlipSurface(
        speeds=np.array(speeds), axial_loads=np.array(axial_loads), factors=np.array(list(rows))
    )


def minimum_preload(study: SlipStudy, speed: float) -> float:
    """Least axial load with which no ball slips.

    Parameters
    ----------
    study : SlipStudy
        bearing and its other loads
    speed : float
        speed of the inner ring [rad/s]

    Returns
    -------
    float
        load; 0 without centrifugal force; NaN if it exceeds 700 times the least possible one [N]
    """
    if study.least_preload(speed) == 0.0:
        return 0.0
    ascent = _ascend(study, speed)
    if ascent.solution is None or not ascent.no_slip:
        return nan
    return _root(study, speed, (ascent.before, ascent.load), np.min, ascent.solution)


def minimum_preloads(study: SlipStudy, speeds: Sequence[float], mapper: Mapper = map) -> Array:
    """`minimum_preload` over speeds.

    Parameters
    ----------
    study : SlipStudy
        bearing and its other loads
    speeds : Sequence[float]
        speeds of the inner ring, shape (n,) [rad/s]
    mapper : Mapper, default map
        `map`, or the map of a pool

    Returns
    -------
    Array
        loads, shape (n,) [N]
    """
    return np.array(list(mapper(partial(minimum_preload, study), [float(n) for n in speeds])))


def critical_loads(study: SlipStudy, speed: float, radial_load: float) -> Array:
    """Axial load at which the factor of each ball passes the limit.

    The heaviest if there are several, NaN if there is none.

    Parameters
    ----------
    study : SlipStudy
        bearing; its radial load is replaced
    speed : float
        speed of the inner ring [rad/s]
    radial_load : float
        load along +y [N]

    Returns
    -------
    Array
        loads, shape (Z,) [N]

    Raises
    ------
    ValueError
        if the study prescribes a displacement along y
    """
    if study.operation.force[1] is None:
        raise ValueError(
            "operation: critical curves vary the radial load, so y must have a force, not a "
            "displacement"
        )
    force = (study.operation.force[0], radial_load, study.operation.force[2])
    study = replace(study, operation=replace(study.operation, force=force))
    loads = np.full(study.bearing.balls, nan)
    roots: dict[tuple[float, ...], float] = {}
    above: tuple[float, QuasistaticSolution] | None = None
    # 1. down from a load at which no ball slips, step by step
    for load, solution in _descent(study, speed):
        if above is not None:
            before = slip_factors(above[1])
            after = slip_factors(solution)
            passed = (before >= study.limit) & (after < study.limit) & np.isnan(loads)
            # 2. the load at which a ball passed the limit; balls with equal factors share it
            for ball in np.flatnonzero(passed):
                pair = (before[ball], after[ball])
                key = (load, *(float(f"{factor:.{EQUALITY_DIGITS}g}") for factor in pair))
                if key not in roots:
                    bracket = (load, above[0])
                    roots[key] = _root(study, speed, bracket, itemgetter(ball), above[1])
                loads[ball] = roots[key]
        above = load, solution
    return loads


def critical_curves(
    study: SlipStudy, speed: float, radial_loads: Sequence[float], mapper: Mapper = map
) -> CriticalCurves:
    """`critical_loads` over radial loads at one speed.

    Parameters
    ----------
    study : SlipStudy
        bearing; its radial load is replaced
    speed : float
        speed of the inner ring [rad/s]
    radial_loads : Sequence[float]
        loads along +y, shape (R,) [N]
    mapper : Mapper, default map
        `map`, or the map of a pool

    Returns
    -------
    CriticalCurves
        critical axial loads over the radial ones [N]
    """
    rows = mapper(partial(critical_loads, study, speed), [float(load) for load in radial_loads])
    return CriticalCurves(
        speed=speed, radial_loads=np.array(radial_loads), axial_loads=np.array(list(rows))
    )


def minimum_axial_load_skf(factor: float, speed: float) -> float:
    """Catalogue minimum axial load F_am = A (n/1000)^2, SKF Rolling bearings catalogue; n in
    r/min.

    Parameters
    ----------
    factor : float
        A of the product table [N]
    speed : float
        speed of one ring against the other [rad/s]

    Returns
    -------
    float
        F_am [N]
    """
    return factor * (speed / RPM / 1000.0) ** 2


def minimum_radial_load_skf(
    factor: float, speed: float, kinematic_viscosity: float, pitch_diameter: float
) -> float:
    """Catalogue minimum radial load, SKF Rolling bearings catalogue.

    F_rm = k_r (nu n/1000)^(2/3) (d_m/100)^2; n in r/min, nu in mm^2/s, d_m in mm.

    Parameters
    ----------
    factor : float
        k_r of the product table [N]
    speed : float
        speed of one ring against the other [rad/s]
    kinematic_viscosity : float
        at operating temperature [m^2/s]
    pitch_diameter : float
        d_m [m]

    Returns
    -------
    float
        F_rm [N]
    """
    flow = kinematic_viscosity / MILLIMETRE**2 * abs(speed / RPM) / 1000.0
    return float(factor * flow ** (2.0 / 3.0) * (pitch_diameter / MILLIMETRE / 100.0) ** 2)


class _Ascent(NamedTuple):
    """End of the search upwards."""

    before: float  # trial before the last; NaN without an equilibrium there [N]
    load: float  # last trial [N]
    solution: QuasistaticSolution | None  # the last one
    no_slip: bool  # whether no ball slips there


def _ascend(study: SlipStudy, speed: float) -> _Ascent:
    """Trial loads from below the least possible preload up to the first at which no ball slips."""
    first = FIRST_TRIAL * study.least_preload(speed)
    last = None
    load = before = nan
    for step in range(TRIALS):
        load = first * TRIAL_GROWTH**step
        solution = study.solve(speed, load, last)
        last = solution or last
        if solution is not None and slip_factors(solution).min() >= study.limit:
            return _Ascent(before, load, last, no_slip=True)
        before = load if solution is not None else nan
    return _Ascent(before, load, last, no_slip=False)


def _descent(study: SlipStudy, speed: float) -> Iterator[tuple[float, QuasistaticSolution]]:
    """Axial loads and solutions, from no ball slipping down to all slipping or hardly a load."""
    _, load, last, _ = _ascend(study, speed)
    lightest = LIGHTEST_TRIAL * study.least_preload(speed)
    while last is not None and load > lightest:
        solution = study.solve(speed, load, last)
        if solution is None:
            return
        yield load, solution
        if slip_factors(solution).max() < study.limit:
            return
        last = solution
        load = load / TRIAL_GROWTH


def _root(
    study: SlipStudy,
    speed: float,
    bracket: tuple[float, float],
    of_factors: Callable[[Array], Any],
    initial_guess: QuasistaticSolution,
) -> float:
    """Axial load [N] in the bracket where a factor passes the limit; NaN: no equilibrium."""
    unsolved = False

    def excess(load: float) -> float:
        nonlocal unsolved
        solution = study.solve(speed, load, initial_guess)
        unsolved |= solution is None
        return 0.0 if solution is None else float(of_factors(slip_factors(solution))) - study.limit

    if not isfinite(bracket[0]):
        return nan
    load = scipy.optimize.brentq(excess, *bracket, rtol=LOAD_RTOL, xtol=LOAD_RTOL * bracket[0])
    return nan if unsolved else float(load)
