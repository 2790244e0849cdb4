"""The sweep over random contacts: solved untuned, kept draw by draw, resumable."""

import json
import threading
from collections.abc import Iterable
from concurrent.futures import as_completed
from dataclasses import asdict, dataclass, fields
from math import isfinite
from pathlib import Path
from typing import Any

from ehl import ContactSolution, SolverOptions, solve_contact
from ehl.multigrid.threads import cores
from ehl.scaling import scale_contact
from ehl.thread_pool import film_threads

from .draws import Draw, draws
from .page import ForeignFileError, Progress

POINTS = (257, 513, 1025)
QUICK_POINTS = (65,)
RESOLVABLE = 10.0  # Hmin/(S hx^2) at the most points from which a contact counts as resolvable
DAMPED = "damping halved in passing"


@dataclass(frozen=True, slots=True, kw_only=True)
class Finished:
    """What became of one draw; a line of the file."""

    number: int
    text: str
    kind: str  # of the entrainment
    moes_load: float
    moes_lubricant: float
    radius_ratio: float
    hertz_pressure: float  # [Pa]
    points: int  # of the last solve
    converged: bool
    resolved: bool
    # Hmin/(S hx^2) of the last solve; None: no film
    fineness: float | None
    measures: tuple[str, ...]  # taken in the last solve, without repetitions
    first_measures: tuple[str, ...]  # taken in the solve with the fewest points
    seconds: float  # of all its solves
    message: str

    @property
    def outcome(self) -> str:
        """Converged and resolved, converged but unresolved, or failed."""
        if self.converged:
            return "converged and resolved" if self.resolved else "converged, unresolved"
        return "failed"

    @property
    def resolvable(self) -> bool:
        """Whether the most points resolve it: resolved, enough meshes in the film, or unknown."""
        return (
            (self.converged and self.resolved)
            or self.fineness is None
            or self.fineness >= RESOLVABLE
        )

    @property
    def strongest(self) -> str:
        """The last measure that was taken in the last solve, none if it went through plainly."""
        return strongest(self.measures)


def strongest(measures: Iterable[str]) -> str:
    """The last of the measures: a further attempt, before a cycle that was repeated."""
    taken = list(measures)
    attempts = [name for name in taken if not name.startswith("cycle")]
    return attempts[-1] if attempts else DAMPED if taken else "none"


def solve_draw(draw: Draw, points: tuple[int, ...] = POINTS) -> Finished:
    """Solve with the fewest points, and with more while it is not converged and resolved."""
    seconds = 0.0
    first: tuple[str, ...] = ()
    solution: ContactSolution | None = None
    for n in points:
        solution = solve_contact(draw.conditions, SolverOptions(points=n))
        seconds += solution.record.wall_time
        if n == points[0]:
            first = tuple(dict.fromkeys(solution.record.fallbacks))
        if solution.converged and solution.resolved:
            break
    assert solution is not None
    return Finished(
        number=draw.number,
        text=draw.text,
        kind=draw.kind,
        moes_load=solution.moes_load,
        moes_lubricant=solution.moes_lubricant,
        radius_ratio=draw.groups.radius_ratio,
        hertz_pressure=solution.hertz_pressure,
        points=solution.X.size,
        converged=bool(solution.converged),
        resolved=bool(solution.resolved),
        fineness=_fineness(solution),
        measures=tuple(dict.fromkeys(solution.record.fallbacks)),
        first_measures=first,
        seconds=round(seconds, 3),
        message=solution.message,
    )


def _fineness(solution: ContactSolution) -> float | None:
    """Hmin/(S hx^2) [-] of the finest grid; None if not positive."""
    curvature = scale_contact(solution.conditions).curvature_x
    film = solution.film_minimum_dimensionless
    value = film.finest / (curvature * float(solution.X[1] - solution.X[0]) ** 2)
    return float(value) if isfinite(value) and value > 0.0 else None


def sweep(
    count: int, seed: int, file: Path, progress: Progress, points: tuple[int, ...] = POINTS
) -> list[Finished]:
    """Solve the draws that `file` does not hold yet, on all cores; each is appended to it as soon
    as it is done.

    Raises
    ------
    ForeignFileError
        If the file holds another sweep.
    KeyboardInterrupt
        With the finished draws in the file.
    """
    head = {"seed": seed, "points": list(points)}
    done = {finished.number: finished for finished in _take_over(file, head)}
    # draws before it were begun when the sweep was stopped: the longest, taken last
    last = max(done, default=-1)
    waiting = sorted(
        (d for d in draws(count, seed) if d.number not in done),
        key=lambda d: (d.number < last, d.number),
    )
    lock = threading.Lock()
    progress(len(done), count, "random contacts")
    with film_threads(cores()) as pool:
        jobs = [pool.submit(solve_draw, draw, points) for draw in waiting]
        for job in as_completed(jobs):
            finished = job.result()
            done[finished.number] = finished
            with lock, file.open("a", encoding="utf-8") as lines:
                lines.write(
                    json.dumps(asdict(finished), ensure_ascii=False, allow_nan=False) + "\n"
                )
            progress(len(done), count, "random contacts")
    return [done[number] for number in sorted(done) if number < count]


def _take_over(file: Path, head: dict[str, Any]) -> list[Finished]:
    """Finished draws of a file, begun if there is none; a truncated last line is removed."""
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(head) + "\n", encoding="utf-8")
        return []
    text = file.read_text(encoding="utf-8")
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        file.write_text(whole, encoding="utf-8")
    return read_finished(file, head)


def read_finished(file: Path, head: dict[str, Any] | None = None) -> list[Finished]:
    """The finished draws of a file; with `head` only if it holds that sweep.

    Raises
    ------
    ForeignFileError
        If the file is none of a sweep, or of another one.
    """
    try:
        own, *lines = (json.loads(line) for line in file.read_text(encoding="utf-8").splitlines())
        keys = {field.name for field in fields(Finished)}
        if "seed" not in own or any(set(line) != keys for line in lines):
            raise ValueError(file)
    except (OSError, ValueError, TypeError):
        raise ForeignFileError(
            f"{file}: is no sweep of random contacts; move it away, or choose another -o"
        ) from None
    if head is not None and own != head:
        raise ForeignFileError(
            f"{file}: holds the sweep with {own}, wanted is {head}; "
            f"choose another -o, or --seed {own['seed']}"
        )
    names = ("measures", "first_measures")
    return [Finished(**(line | {name: tuple(line[name]) for name in names})) for line in lines]
