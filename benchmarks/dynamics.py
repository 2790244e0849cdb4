"""Time of three simulations on one core: `python benchmarks/dynamics.py`.

7008 with 18 balls and cage, 0.1 s, four-constant friction over the ellipse (or the traction tables
of `oilfilm table 7008_axial -o FILE`, given as an argument); the same from rest, 30 ms, which starts too
stiff for explicit steps; 6304 in its plane, 1 s.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from time import perf_counter, process_time

from bearing.dynamics.simulation import simulation
from cases import Case, load_case
from cases.runs.dynamics import build_model


def timed(case: Case, tables: Path | None) -> str:
    """Steps, evaluations and time of a case, with the kernels compiled."""
    model = build_model(case, tables, lambda done, total, state: None)
    short = replace(model, options=replace(model.options, end_time=1e-4, sample_interval=1e-5))
    for _ in simulation(case.bearing, case.operation, short).pieces():
        pass
    timed_run = simulation(case.bearing, case.operation, model)
    began = perf_counter()
    used = process_time()
    for _ in timed_run.pieces():
        pass
    steps, evaluations = int(timed_run.state.counters[0]), int(timed_run.state.counters[4])
    wall, cpu = perf_counter() - began, process_time() - used
    each = 1e6 * cpu / max(evaluations, 1)
    time = f"{timed_run.state.time:g} s in {wall:.1f} s, {cpu:.1f} s of CPU"
    return f"{time}: {steps} steps, {evaluations} evaluations of {each:.1f} us"


def main() -> None:
    """All simulations."""
    tables = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    axial = load_case("7008_axial")
    assert isinstance(axial, Case)
    print("7008, four constants:", timed(axial, None))
    assert axial.dynamics is not None
    ramp = ((0.0, 0.0), (0.01, axial.operation.inner_speed))
    started = replace(axial.dynamics, start="rest", speed_table=ramp, end_time=0.03, sample_interval=1.5e-5)
    print("7008 from rest:", timed(replace(axial, dynamics=started), None))
    if tables is not None:
        tabled = replace(axial, dynamics=replace(axial.dynamics, friction="table"))
        print("7008, traction tables:", timed(tabled, tables))
    planar = load_case("6304_planar")
    assert isinstance(planar, Case)
    print("6304, planar:", timed(planar, None))


if __name__ == "__main__":
    main()
