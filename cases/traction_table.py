"""Run `oilfilm table`: equilibrium of the bearing, then the traction tables of both races."""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING

from .case import Case
from .problems import CaseError
from .run import Progress, cores
from .version import version

if TYPE_CHECKING:
    from postprocess.traction_results import TractionResults


def run_table(
    case: Case, points: int = 257, workers: int | None = None, progress: Progress | None = None
) -> TractionResults:
    """Traction tables of a case, films on `points` nodes along x, `workers` at a time; times in [s]."""
    from bearing.quasistatic import solve_quasistatic
    from bearing.traction_tables import build_race_tables
    from ehl import SolverOptions
    from ehl.traction.sampling import TableOptions
    from postprocess.traction_results import TractionResults

    try:
        SolverOptions(points=points)
    except ValueError as problem:
        raise CaseError([f"--points: {problem}"]) from None
    assert case.rheology is not None  # of every bearing case
    start = perf_counter()
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    if not state.converged:
        raise CaseError([f"no table without an equilibrium of the bearing: {state.message}"])
    options = TableOptions(points=points, workers=workers or cores())
    try:
        tables = build_race_tables(state, case.lubricant, case.rheology, options, progress)
    except ValueError as problem:
        raise CaseError([f"no table: {problem}"]) from None
    return TractionResults(
        version=version(),
        case=case.document,
        tables=tables,
        messages=case.warnings,
        timing={"total": perf_counter() - start},
    )
