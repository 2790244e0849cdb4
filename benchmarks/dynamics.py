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

from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.cases import Case, load_case
from oilfilm.cases.runs.motion_model import build_model


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


def changed(case: Case, **keys: object) -> Case:
    """The case with other keys of [dynamics]."""
    assert case.file.dynamics is not None
    dynamics = case.file.dynamics.model_copy(update=keys)
    return replace(case, file=case.file.model_copy(update={"dynamics": dynamics}))


def main() -> None:
    """All simulations."""
    tables = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    axial = load_case("7008_axial")
    assert isinstance(axial, Case)
    print("7008, four constants:", timed(axial, None))
    speed = axial.file.operation.inner_speed_rpm
    started = changed(
        axial, start="rest", speed_table_rpm=((0.0, 0.0), (0.01, speed)), end_time_s=0.03, output_interval_us=15.0
    )
    print("7008 from rest:", timed(started, None))
    if tables is not None:
        print("7008, traction tables:", timed(changed(axial, friction="table"), tables))
    planar = load_case("6304_planar")
    assert isinstance(planar, Case)
    print("6304, planar:", timed(planar, None))


if __name__ == "__main__":
    main()
