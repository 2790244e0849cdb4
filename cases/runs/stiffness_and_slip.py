"""Run the stiffness of a case over the speed of its inner ring, and its slip maps."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from multiprocessing import active_children
from time import perf_counter
from typing import Any

import numpy as np

from oilfilm.bearing.geometry import SINGLE
from oilfilm.bearing.operation import BallKinematics
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.bearing.studies.slip import (
    Mapper,
    SlipStudy,
    critical_curves,
    minimum_axial_load_skf,
    minimum_preloads,
    minimum_radial_load_skf,
    slip_surface,
)
from oilfilm.bearing.studies.stiffness import stiffness_over_speed
from oilfilm.ehl.multigrid.threads import cores
from oilfilm.postprocess.slip.results import MinimumLoads, SlipResults
from oilfilm.postprocess.stiffness.results import StiffnessResults

from ..format.case import Case
from ..format.operation import SlipTable
from ..format.rules import CaseError
from .equilibrium import equilibrium_solver
from .films import Progress
from .processes import end_workers, start_fork_server, worker_pool

# centrifugal force a source evidently used, over the true one [-]
PRINTED_FORCE = {"half centrifugal force": 0.5}


def run_slip(
    case: Case, name: str, workers: int | None = None, progress: Progress | None = None
) -> SlipResults:
    """Slip factors over speed and axial load, critical curves, and minimum preloads.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.
    workers : int | None, optional
        Processes [-]; None: as many as there are cores; 1: none is started.
    progress : Progress | None, optional
        Called with rows done, rows in all, and the stage.

    Returns
    -------
    SlipResults
        Maps and preloads.

    Raises
    ------
    CaseError
        If the case has no [slip], or prescribes a displacement where the maps vary the load.
    """
    start = perf_counter()
    study, table = _study(case, name)
    si = table.si()
    speeds = _range(si["speeds"], table.points)
    loads = _range(si["axial_loads"], table.points)
    radial = _range(si["critical_radial_loads"], table.critical_points)
    # here first: kernels that are not compiled yet are so once, not by every process
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    with _mapper(workers or cores(), progress or (lambda done, total, state: None)) as mapper:
        surface = slip_surface(study, speeds, loads, mapper("slip factors", table.points))
        timing = {"surface": perf_counter() - start}
        curves = tuple(
            critical_curves(study, speed, radial, mapper("critical curves", table.critical_points))
            for speed in si["critical_speeds"]
        )
        minimum = _minimum_loads(case, study, table, speeds, mapper)
    timing["total"] = perf_counter() - start
    return SlipResults(
        case=case.document,
        limit=table.limit,
        state=state,
        surface=surface,
        curves=curves,
        minimum=minimum,
        printed_force=PRINTED_FORCE[table.as_printed] if table.as_printed else None,
        messages=case.warnings,
        timing=timing,
    )


def _range(ends: tuple[float, float], points: int) -> list[float]:
    return [ends[0] + (ends[1] - ends[0]) * k / (points - 1) for k in range(points)]


def _study(case: Case, name: str) -> tuple[SlipStudy, SlipTable]:
    table = case.file.slip
    if table is None:
        needs = "it needs speeds_rpm and axial_loads_N, see docs/reference/cases.md"
        raise CaseError(f"{name}: has no table [slip]; {needs}")
    operation = case.operation
    if operation.force[0] is None or (table.critical_speeds_rpm and operation.force[1] is None):
        varied = "the axial load" if operation.force[0] is None else "the radial load"
        allowed = f"slip maps vary {varied}; allowed: a load there"
        raise CaseError(f"{name}: [operation] displacement_um: {allowed}")
    if case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        allowed = "slip maps take a hypothesis; allowed: one of the others"
        raise CaseError(f"{name}: [model] ball_kinematics: {allowed}")
    study = SlipStudy(
        bearing=case.bearing, operation=operation, model=case.model, limit=table.limit
    )
    return study, table


def _minimum_loads(
    case: Case,
    study: SlipStudy,
    table: SlipTable,
    speeds: list[float],
    mapper: Callable[[str, int], Mapper],
) -> MinimumLoads:
    """Preload by Hirano's criterion, also as printed if the case asks, and SKF's minimum loads."""
    oil = case.lubricant
    own = case.operation.inner_speed
    every = [*speeds, abs(own)] if own else speeds
    hirano = minimum_preloads(study, every, mapper("minimum preload", len(every)))
    printed = None
    if table.as_printed:
        as_printed = replace(study, limit=table.limit * PRINTED_FORCE[table.as_printed])
        printed = minimum_preloads(as_printed, every, mapper("as printed", len(every)))
    si = table.si()
    axial = si["minimum_axial_load_factor"]
    radial = si["minimum_radial_load_factor"]
    nu = oil.viscosity / oil.density
    pitch = case.bearing.pitch_diameter
    skf_axial = None
    skf_radial = None
    if axial is not None:
        skf_axial = np.array([minimum_axial_load_skf(axial, n) for n in every])
    if radial is not None:
        skf_radial = np.array([minimum_radial_load_skf(radial, n, nu, pitch) for n in every])
    return MinimumLoads(
        speeds=np.array(every),
        hirano=hirano,
        as_printed=printed,
        skf_axial=skf_axial,
        skf_radial=skf_radial,
        own=bool(own),
    )


@contextmanager
def _mapper(workers: int, notify: Progress) -> Iterator[Callable[[str, int], Mapper]]:
    """A `map` for each stage, over processes if there are several, with progress."""
    pool = None
    others = set(active_children())
    if workers > 1:
        start_fork_server([__name__])
        pool = worker_pool(workers)

    def stage(state: str, total: int) -> Mapper:
        def mapped(function: Callable[[Any], Any], items: Iterable[Any]) -> Iterator[Any]:
            notify(0, total, state)
            results = pool.map(function, items) if pool else map(function, items)
            for done, result in enumerate(results, 1):
                notify(done, total, state)
                yield result

        return mapped

    try:
        yield stage
    except KeyboardInterrupt:
        if pool is not None:
            pool.shutdown(wait=False, cancel_futures=True)
            end_workers(others)
        raise
    finally:
        if pool is not None:
            pool.shutdown(wait=True, cancel_futures=True)


def run_stiffness(
    case: Case,
    name: str,
    speeds: tuple[float, float] | None,
    points: int,
    damping: float | None = None,
    progress: Progress | None = None,
) -> StiffnessResults:
    """Stiffness at evenly spaced speeds.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.
    speeds : tuple[float, float] | None
        First and last [rad/s]; None: from rest to the speed of the case.
    points : int
        Number of speeds [-].
    damping : float, optional
        Damping for the rotor code [N s/m]; left out, that of the films.
    progress : Progress | None, optional
        Called with speeds done, speeds in all, and a text.

    Returns
    -------
    StiffnessResults
        Stiffness at each speed.

    Raises
    ------
    CaseError
        If the inner ring stands still.
    """
    first, last = speeds or (0.0, case.operation.inner_speed)
    if first == last:
        raise CaseError(f"{name}: the inner ring stands still; give --speeds FIRST LAST in r/min")
    start = perf_counter()
    steps = [first + (last - first) * k / (points - 1) for k in range(points)]
    notify = progress or (lambda done, total, state: None)
    notify(0, points, "stiffness at speeds")
    study = stiffness_over_speed(
        case.bearing,
        case.operation,
        steps,
        case.model,
        case.rows or SINGLE,
        equilibrium_solver(case),
        None if case.dry or case.frozen else case.lubricant,
    )
    return StiffnessResults(
        case=case.document,
        study=study,
        damping=damping,
        messages=case.warnings,
        timing={"total": perf_counter() - start},
    )
