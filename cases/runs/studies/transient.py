"""Run of a contact over time."""

import json
from functools import partial
from pathlib import Path
from time import perf_counter

from ehl.transient.run import TransientRun, transient_run
from ehl.transient.waves import wave_results
from postprocess.contact.transient_summary import TransientResults

from ...format.case import ContactCase
from ...format.problems import CaseError
from ...version import version
from ..films import Progress
from ..interrupt import finish_first, interruptible
from .kept_steps import Checkpoints

NOT_USED = "ehl.tolerance, ehl.certify: not used over time, where transient.tolerance counts"


class Interrupted(KeyboardInterrupt):
    """A run stopped on the way, with what it has so far."""

    def __init__(self, results: TransientResults, kept: bool) -> None:
        super().__init__()
        self.results = results
        self.kept = kept


def run_transient(
    case: ContactCase, name: str, folder: Path | None = None, progress: Progress | None = None
) -> TransientResults:
    """Solve a contact over time; its steps are stored in a folder.

    Parameters
    ----------
    case : ContactCase
        The contact.
    name : str
        Name of the case in messages.
    folder : Path | None, optional
        Folder of the steps while it runs; steps of the same case in it are continued.
    progress : Progress | None, optional
        Called with steps done, steps in all, and the time left.

    Returns
    -------
    TransientResults
        Films over time.

    Raises
    ------
    CaseError
        If the case has no [transient].
    StartError
        If the steady film at its start does not converge.
    Interrupted
        With what there is so far, on Ctrl-C.
    """
    notify = progress or (lambda done, total, state: None)
    if case.transient is None:
        raise CaseError(
            f"{name}: has no table [transient]; it needs end_time_ms, see docs/reference/cases.md"
        )
    began = perf_counter()
    notify(0, 1, "steady film at the start")
    try:
        run = interruptible(partial(transient_run, *case.transient))
    except ValueError as problem:
        raise CaseError(f"{name}: transient: {problem}") from problem
    kept = (
        None if folder is None else Checkpoints(folder, json.dumps(case.document, sort_keys=True))
    )
    resumed = 0 if kept is None else kept.resume(run)
    _stream(case, run, kept, (resumed, began), notify)
    return _results(case, run, (resumed, began))


def _stream(
    case: ContactCase,
    run: TransientRun,
    kept: Checkpoints | None,
    start: tuple[int, float],
    notify: Progress,
) -> None:
    """Make the steps; on Ctrl-C what there is so far goes up with `Interrupted`."""
    resumed = start[0]
    began = perf_counter()
    try:
        while not run.finished:
            result = interruptible(run.advance)
            if result is None:
                break
            with finish_first("the step under way"):
                run.accept(result)
                if kept is not None:
                    kept.keep(run)
            left = (perf_counter() - began) * (run.planned - run.done) / (run.done - resumed)
            notify(run.done, run.planned, f"steps, {left:.0f} s left")
        if kept is not None and run.done > resumed:
            kept.keep(run, now=True)
    except KeyboardInterrupt:
        if kept is not None and run.done > 0:
            with finish_first("the steps so far"):
                kept.keep(run, now=True)
        raise Interrupted(_results(case, run, start), kept is not None and run.done > 0) from None


def _results(case: ContactCase, run: TransientRun, start: tuple[int, float]) -> TransientResults:
    resumed, began = start
    solution = run.solution()
    wall = perf_counter() - began
    given = case.document.get("ehl", {})
    unused = (NOT_USED,) if given.get("certify") or "tolerance" in given else ()
    return TransientResults(
        version=version(),
        case=case.document,
        solution=solution,
        waves=wave_results(solution),
        messages=(*case.warnings, *unused),
        resumed=resumed,
        wall=wall,
        timing={"total": wall},
    )
