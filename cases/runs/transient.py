"""Run of a contact over time, whose steps stay on disk while it runs, so that it can go on."""

import json
from contextlib import suppress
from functools import partial
from pathlib import Path
from time import monotonic, perf_counter
from typing import Any

import numpy as np

from oilfilm.bearing.files import write_bytes
from oilfilm.ehl.data_files import arrays_as_bytes, read_arrays
from oilfilm.ehl.foreign_files import DAMAGE
from oilfilm.ehl.transient.record import Frame, StepRecord
from oilfilm.ehl.transient.run import TransientRun, transient_run
from oilfilm.ehl.transient.step import Past
from oilfilm.ehl.transient.waves import wave_results
from oilfilm.postprocess.contact.transient_summary import TransientResults

from ..format.case import ContactCase
from ..format.rules import CaseError
from .films import Progress
from .interrupt import finish_first, interruptible

STATE_FILE = "state.npz"
EVERY = 5.0  # between two states on disk [s]

NOT_USED = "ehl.tolerance, ehl.certify: not used over time, where transient.tolerance counts"


class Checkpoints:
    """The folder of the steps of one run; frames as they come, the state now and then.

    OSError where the disk takes no more.
    """

    def __init__(self, folder: Path, key: str) -> None:
        self.folder = folder
        self.key = key
        self._written = 0  # frames on disk
        self._last = monotonic()

    def resume(self, run: TransientRun) -> int:
        """Continue from the checkpoint of the same case; a damaged one, or one of another case, is
        ignored.

        Parameters
        ----------
        run : TransientRun
            The run.

        Returns
        -------
        int
            Its step, 0 without a checkpoint [-].
        """
        try:
            state = read_arrays(self.folder / STATE_FILE)
            if str(state["key"]) != self.key:
                return 0
            frames = [_frame(read_arrays(self._file(number))) for number in state["frames"]]
            _restore(run, state, frames)
        except (OSError, *DAMAGE):
            return 0
        self._written = len(frames)
        return run.done

    def keep(self, run: TransientRun, *, now: bool = False) -> None:
        """Write the new steps, if the last time is some seconds ago.

        Parameters
        ----------
        run : TransientRun
            The run.
        now : bool, default False
            True: write in any case.
        """
        if not now and monotonic() - self._last < EVERY:
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        for frame in run.frames[self._written :]:
            fields = {name: getattr(frame, name) for name in Frame.__slots__}
            write_bytes(self._file(frame.step), arrays_as_bytes(fields))
            self._written += 1
        write_bytes(self.folder / STATE_FILE, arrays_as_bytes(_state(run, self.key)))
        self._last = monotonic()

    def forget(self) -> None:
        """Remove the steps of a run that is complete, and the folder if nothing else is there."""
        for file in [*self.folder.glob("frame*.npz"), self.folder / STATE_FILE]:
            file.unlink(missing_ok=True)
        with suppress(OSError):
            self.folder.rmdir()

    def _file(self, step: Any) -> Path:
        return self.folder / f"frame{int(step):07d}.npz"


def _frame(data: dict[str, Any]) -> Frame:
    return Frame(
        step=int(data["step"]),
        time=float(data["time"]),
        pressure=data["pressure"],
        film=data["film"],
        filled=data["filled"],
    )


def _state(run: TransientRun, key: str) -> dict[str, Any]:
    """State from which a run continues."""
    past = run.past
    return {
        "key": key,
        "frames": [frame.step for frame in run.frames],
        "values": np.array([step.values for step in run.steps]),
        "film_lines": np.array([step.film_line for step in run.steps]),
        "pressure_lines": np.array([step.pressure_line for step in run.steps]),
        "content": np.array(past.content),
        "pressure": np.array(past.pressure),
        "approach": past.approach,
        "rate": past.rate,
        "step": past.step,
        "nodes": past.nodes,
        "exterior": run.exterior,
        "halvings": run.stepper.halvings,
    }


def _restore(run: TransientRun, state: dict[str, Any], frames: list[Frame]) -> None:
    """Put a run where a state stands; ValueError where it does not fit."""
    steps = [
        StepRecord(values=values, film_line=film, pressure_line=pressure)
        for values, film, pressure in zip(
            state["values"], state["film_lines"], state["pressure_lines"], strict=True
        )
    ]
    if state["content"].shape != (2, *run.stepper.level.P.shape) or len(steps) < 2:
        raise ValueError("of another grid")
    run.resume_from(
        Past(
            content=(state["content"][0], state["content"][1]),
            pressure=(state["pressure"][0], state["pressure"][1]),
            approach=(float(state["approach"][0]), float(state["approach"][1])),
            rate=(float(state["rate"][0]), float(state["rate"][1])),
            step=float(state["step"]),
            nodes=float(state["nodes"]),
        ),
        (float(state["exterior"]), int(state["halvings"])),
        (steps, frames),
    )


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
        case=case.document,
        solution=solution,
        waves=wave_results(solution),
        messages=(*case.warnings, *unused),
        resumed=resumed,
        wall=wall,
        timing={"total": wall},
    )
