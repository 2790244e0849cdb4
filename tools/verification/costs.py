"""Cost of the contact solve: time in deflections, cycles and memory, 65 to 2049 points."""

import time
import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from oilfilm.ehl import ContactSolution, SolverOptions, solve_contact
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.solid.deformation import deflect, deflection_kernel
from oilfilm.postprocess.bearing.results import BearingResults

from .contacts import CIRCULAR_20_10, CIRCULAR_200_10, Named, race_6208
from .page import Check, Picture, Section, Table, columns, text
from .plots import ScalingCurve, draw_scaling

POINTS = (65, 129, 257, 513, 1025, 2049)
FEW_POINTS = (65, 129, 257)
CONTACTS = (CIRCULAR_20_10, CIRCULAR_200_10, Named("6208 outer race, 1612 N", race_6208(1611.8, outer=True)))
# cost per unknown may grow by this factor from here to the finest grid
GROWTH_FROM = 257
GROWTH = 2.2
REPEATS = {65: 5, 129: 5, 257: 5, 513: 3, 1025: 2, 2049: 2}  # of each solve; the best counts
BEARING = "6208_full_ceramic"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cost:
    """What one contact took on one grid."""

    contact: str
    nx: int
    ny: int
    seconds: float
    deflection: float  # of the same grid [s]
    cycles: int  # on the finest level
    ffts: float
    memory: float  # peak of the arrays [bytes]

    @property
    def unknowns(self) -> int:
        """Nodes of the half or whole box that are solved for."""
        return self.nx * self.ny

    @property
    def per_unknown(self) -> float:
        """Time over nodes [s]."""
        return self.seconds / self.unknowns

    @property
    def deflections(self) -> float:
        """Time in deflections of the same grid [-]."""
        return self.seconds / self.deflection


def deflection_time(solution: ContactSolution, repeats: int = 11) -> float:
    """Time of one deflection on the half grid of a solution [s], best of several."""
    x = solution.X
    y = solution.Y
    grid = Grid(
        x_in=float(x[0]), hx=float(x[1] - x[0]), hy=float(y[1] - y[0]), nx=x.size, ny=(y.size + 1) // 2, symmetric=True
    )
    kernel = deflection_kernel(grid, 1.0)
    pressure = np.random.default_rng(17).random((grid.ny, grid.nx))
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        deflect(kernel, pressure)
        times.append(time.perf_counter() - began)
    return min(times)


def measure(contact: Named, points: int) -> Cost:
    """Time, cycles and memory of one contact on one grid."""
    options = SolverOptions(points=points, domain=contact.box)
    runs = [solve_contact(contact.conditions, options) for _ in range(REPEATS.get(points, 1))]
    best = min(runs, key=lambda run: run.record.wall_time)
    deflection = deflection_time(best)
    del runs
    tracemalloc.start()
    solve_contact(contact.conditions, options)
    memory = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return Cost(
        contact=contact.name,
        nx=best.X.size,
        ny=(best.Y.size + 1) // 2,
        seconds=best.record.wall_time,
        deflection=deflection,
        cycles=best.record.cycles,
        ffts=best.record.fft_equivalents,
        memory=float(memory),
    )


def costs(quick: bool = False, run_bearing: Callable[[], BearingResults] | None = None) -> Section:
    """Scaling of the solve, and the time of all contacts of a bearing that is run."""
    solve_contact(CIRCULAR_20_10.conditions, SolverOptions(points=65))  # compile
    points, contacts = (FEW_POINTS, CONTACTS[:1]) if quick else (POINTS, CONTACTS)
    measured = {contact.name: [measure(contact, n) for n in points] for contact in contacts}
    rows = tuple(_row(cost, costs) for costs in measured.values() for cost in costs)
    head = columns(
        "contact | grid of the half | cycles | FFTs | time, s | time/deflection"
        " | µs per unknown | over 257 | bytes per unknown"
    )
    tables = [Table("Cost of a solve:", head, rows, slice(5, None, 6))]
    if run_bearing is not None and not quick:
        tables.append(_bearing_table(run_bearing))
    curves = [
        ScalingCurve(
            label=name,
            unknowns=tuple(c.unknowns for c in costs),
            time=tuple(1e6 * c.per_unknown for c in costs),
            deflection=tuple(1e6 * c.deflection / c.unknowns for c in costs),
            cycles=tuple(c.cycles for c in costs),
            memory=tuple(c.memory / c.unknowns for c in costs),
        )
        for name, costs in measured.items()
    ]
    caption = "Time per unknown (deflection alone dashed), cycles on the finest grid and memory per unknown"
    return Section(
        title="Cost",
        text=text("costs"),
        checks=tuple(check for name, costs in measured.items() for check in _checks(name, costs)),
        tables=tuple(tables),
        pictures=(Picture("verification_cost", caption, partial(draw_scaling, curves=curves)),),
    )


def _row(cost: Cost, costs: Sequence[Cost]) -> tuple[str, ...]:
    base = next(c for c in costs if c.nx == GROWTH_FROM)
    return (
        cost.contact,
        f"{cost.nx} × {cost.ny}",
        str(cost.cycles),
        f"{cost.ffts:.1f}",
        f"{cost.seconds:.3f}",
        f"{cost.deflections:.0f}",
        f"{1e6 * cost.per_unknown:.2f}",
        f"{cost.per_unknown / base.per_unknown:.2f}",
        f"{cost.memory / cost.unknowns:.0f}",
    )


def _checks(name: str, costs: Sequence[Cost]) -> list[Check]:
    base = next(c for c in costs if c.nx == GROWTH_FROM)
    last = costs[-1]
    grids = f"{name}: {last.nx} points"
    memory = last.memory / last.unknowns * base.unknowns / base.memory
    checks = [
        Check(f"cycles, {grids} less {base.nx}", last.cycles - base.cycles, most=0.0),
        Check(f"memory per unknown, {grids} over {base.nx}", memory, most=1.1),
    ]
    if last.nx > base.nx:
        growth = last.per_unknown / base.per_unknown
        checks.append(Check(f"time per unknown, {grids} over {base.nx}", growth, most=GROWTH))
    return checks


def _bearing_table(run_bearing: Callable[[], BearingResults]) -> Table:
    """All contacts of a bearing, kernels compiled."""
    runs = [run_bearing() for _ in range(3)][1:]
    best = min(runs, key=lambda run: run.timing["contacts"])
    solved = [s for s in best.solutions if s is not None]
    distinct = {id(s): s for s in solved}.values()
    converged = sum(s.converged for s in solved)
    seconds = best.timing["contacts"]
    alone = sum(deflection_time(s, 5) for s in distinct)
    contacts = f"{len(solved)}, {len(distinct)} distinct"
    times = (f"{seconds:.2f}", f"{seconds / alone:.0f}")
    row = (BEARING, str(best.case["ehl"]["points"]), contacts, str(converged), *times)
    return Table(
        "All contacts of the bearing, in as many threads as there are cores, equal ones solved once:",
        ("case", "points", "contacts", "converged", "time, s", "time/sum of one deflection each"),
        (row,),
    )
