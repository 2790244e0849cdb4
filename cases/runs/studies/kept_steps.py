"""Steps of a contact over time on disk while it runs, so that an interrupted run goes on."""

import io
import zipfile
from contextlib import suppress
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np

from bearing.files import write_bytes
from ehl.transient.record import Frame, StepRecord
from ehl.transient.run import TransientRun
from ehl.transient.step import Past

STATE_FILE = "state.npz"
EVERY = 5.0  # between two states on disk [s]


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
            state = _read(self.folder / STATE_FILE)
            if str(state["key"]) != self.key:
                return 0
            frames = [_frame(_read(self._file(number))) for number in state["frames"]]
            _restore(run, state, frames)
        except (OSError, KeyError, ValueError, zipfile.BadZipFile, EOFError):
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
            _write(self._file(frame.step), fields)
            self._written += 1
        _write(self.folder / STATE_FILE, _state(run, self.key))
        self._last = monotonic()

    def forget(self) -> None:
        """Remove the steps of a run that is complete, and the folder if nothing else is there."""
        for file in [*self.folder.glob("frame*.npz"), self.folder / STATE_FILE]:
            file.unlink(missing_ok=True)
        with suppress(OSError):
            self.folder.rmdir()

    def _file(self, step: Any) -> Path:
        return self.folder / f"frame{int(step):07d}.npz"


def _read(path: Path) -> dict[str, Any]:
    with np.load(path, allow_pickle=False) as data:
        return {name: data[name] for name in data.files}


def _write(path: Path, arrays: dict[str, Any]) -> None:
    content = io.BytesIO()
    np.savez(content, **arrays)
    write_bytes(path, content.getvalue())


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
