"""The sweep over random contacts: solved untuned, checked with twice the points, resumable."""

import json
import threading
import time
from collections.abc import Iterable
from concurrent.futures import as_completed
from dataclasses import asdict, dataclass, fields
from math import isfinite
from pathlib import Path
from typing import Any

from oilfilm.ehl import ContactSolution, SolverOptions, solve_contact
from oilfilm.ehl.multigrid.threads import cores, film_threads
from oilfilm.ehl.scaling import scale_contact

from .draws import Draw, draws
from .page import ForeignFileError, Progress

QUICK_OPTIONS = SolverOptions(points=65)
CHECK_POINTS = 1025  # most of the check: contacts that need them have none
CHECKED = 8  # every eighth draw has a check, which costs four times the solve
RESOLVABLE = 10.0  # Hmin/(S hx^2) at the most points from which a contact counts as resolvable
OUTSIDE = "outside the model"  # how the message of a film begins that no mesh makes one of it
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
    points: int  # along x
    converged: bool
    resolved: bool
    fineness: float | None  # Hmin/(S hx^2); None: no film
    measures: tuple[str, ...]  # taken on the last mesh, without repetitions
    residual: float | None  # sum |R| / sum |div(rho u H)|
    seconds: float  # of the processor, without the check
    message: str
    # central film and error bar, minimum film and error bar, H0 and error bar [a^2/Rx], the last
    # two not in files of before; the same with twice the points, of a contact that is converged
    # and resolved
    films: tuple[float, ...] | None
    check: tuple[float, ...] | None

    @property
    def outcome(self) -> str:
        """Converged and resolved, converged but unresolved, or failed."""
        if self.converged:
            return "converged and resolved" if self.resolved else "converged, unresolved"
        return "failed"

    @property
    def resolvable(self) -> bool:
        """Whether the most points resolve it: resolved, enough meshes in the film, or unknown; not
        where the film is outside the model on any of them.
        """
        if self.message.startswith(OUTSIDE):
            return False
        return (self.converged and self.resolved) or self.fineness is None or self.fineness >= RESOLVABLE

    @property
    def errors(self) -> tuple[tuple[float, float], ...]:
        """Distance to the check and error bar of both films, over the film [-]; none without."""
        if self.films is None or self.check is None:
            return ()
        pairs = ((self.films[k], self.films[k + 1], self.check[k]) for k in (0, 2))
        return tuple((abs(film - truth) / truth, bar / truth) for film, bar, truth in pairs)

    @property
    def approach_errors(self) -> tuple[tuple[float, float], ...]:
        """Distance to the check and error bar of H0 [a^2/Rx]; none without."""
        if self.films is None or self.check is None or len(self.films) < 6 or len(self.check) < 6:
            return ()
        return ((abs(self.films[4] - self.check[4]), self.films[5]),)

    @property
    def strongest(self) -> str:
        """The last measure that was taken, none if the contact went through plainly."""
        return strongest(self.measures)


def strongest(measures: Iterable[str]) -> str:
    """The last of the measures: a further attempt, before a cycle that was repeated."""
    taken = list(measures)
    attempts = [name for name in taken if not name.startswith("cycle")]
    return attempts[-1] if attempts else DAMPED if taken else "none"


def solve_draw(draw: Draw, options: SolverOptions) -> Finished:
    """Solve as the program does untold, and again with twice the points for a check."""
    start = time.thread_time()
    solution = solve_contact(draw.conditions, options)
    seconds = time.thread_time() - start
    record = solution.record
    sound = solution.converged and solution.resolved
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
        measures=tuple(dict.fromkeys(record.fallbacks)),
        residual=record.residual[-1] if record.residual else None,
        seconds=round(seconds, 3),
        message=solution.message,
        films=_films(solution) if sound else None,
        check=_check(draw, solution) if sound and draw.number % CHECKED == 0 else None,
    )


def _check(draw: Draw, solution: ContactSolution) -> tuple[float, ...] | None:
    """Films with twice the points; None where those are too many, or do not converge."""
    points = 2 * solution.X.size - 1
    if points > CHECK_POINTS:
        return None
    check = solve_contact(draw.conditions, SolverOptions(points=points))
    return _films(check) if check.converged and check.resolved else None


def _films(solution: ContactSolution) -> tuple[float, ...]:
    values = (solution.film_central_dimensionless, solution.film_minimum_dimensionless, solution.approach_dimensionless)
    return tuple(float(x) for value in values for x in (value.value, value.uncertainty))


def _fineness(solution: ContactSolution) -> float | None:
    """Hmin/(S hx^2) [-] of the finest grid; None if not positive."""
    curvature = scale_contact(solution.conditions).curvature_x
    film = solution.film_minimum_dimensionless
    value = film.finest / (curvature * float(solution.X[1] - solution.X[0]) ** 2)
    return float(value) if isfinite(value) and value > 0.0 else None


def sweep(
    count: int, seed: int, file: Path, progress: Progress, options: SolverOptions | None = None
) -> list[Finished]:
    """Solve the draws that `file` does not hold yet, on all cores; each is appended to it as soon
    as it is done. Without options they are solved as the program does untold.

    Raises
    ------
    ForeignFileError
        If the file holds another sweep.
    KeyboardInterrupt
        With the finished draws in the file.
    """
    options = options or SolverOptions()
    head = {"seed": seed, "points": options.points}
    done = {finished.number: finished for finished in _take_over(file, head)}
    # draws before it were begun when the sweep was stopped: the longest, taken last
    last = max(done, default=-1)
    waiting = sorted((d for d in draws(count, seed) if d.number not in done), key=lambda d: (d.number < last, d.number))
    lock = threading.Lock()
    progress(len(done), count, "random contacts")
    with film_threads(cores()) as pool:
        jobs = [pool.submit(solve_draw, draw, options) for draw in waiting]
        for job in as_completed(jobs):
            finished = job.result()
            done[finished.number] = finished
            with lock, file.open("a", encoding="utf-8") as lines:
                lines.write(json.dumps(asdict(finished), ensure_ascii=False, allow_nan=False) + "\n")
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
        raise ForeignFileError(f"{file}: is no sweep of random contacts; move it away, or choose another -o") from None
    if head is not None and own != head:
        raise ForeignFileError(
            f"{file}: holds the sweep with {own}, wanted is {head}; choose another -o, or --seed {own['seed']}"
        )
    names = ("measures", "films", "check")
    return [Finished(**(line | {name: _tuple(line[name]) for name in names})) for line in lines]


def _tuple(values: list[Any] | None) -> tuple[Any, ...] | None:
    return None if values is None else tuple(values)


def seed_of(file: Path) -> int | None:
    """Seed of the sweep that a file holds; None if there is no file.

    Raises
    ------
    ForeignFileError
        If the file is none of a sweep.
    """
    if not file.exists():
        return None
    read_finished(file)
    return int(json.loads(file.read_text(encoding="utf-8").splitlines()[0])["seed"])
