"""Run the stiffness of a case over the speed of its inner ring."""

from time import perf_counter

from bearing.geometry import SINGLE
from bearing.studies.preload import stiffness_over_speed
from postprocess.stiffness.results import StiffnessResults

from ...format.case import Case
from ...format.problems import CaseError
from ...version import version
from ..equilibrium import equilibrium_solver
from ..films import Progress


def run_stiffness(
    case: Case,
    name: str,
    speeds: tuple[float, float] | None,
    points: int,
    damping: float,
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
    damping : float
        Damping for the rotor code [N s/m].
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
    )
    return StiffnessResults(
        version=version(),
        case=case.document,
        study=study,
        damping=damping,
        messages=case.warnings,
        timing={"total": perf_counter() - start},
    )
