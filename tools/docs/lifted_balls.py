"""Print what lifts balls off the outer race of the 7008, and its step of sliding at the loaded zone.

Run it with `python tools/docs/lifted_balls.py`, two to three minutes of one core. The numbers stand in
docs/validation/validation_000.md, whose text names this script.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from dynamics_runs import RPM, Run, changed, over_azimuth, run
from validation_000 import RADIAL, cage, zones

from oilfilm.bearing.dynamics._cage_kernels import pocket_frame, pocket_motion
from oilfilm.bearing.dynamics._motion_kernels import place_bodies
from oilfilm.bearing.dynamics._state_kernels import ball_position
from oilfilm.bearing.dynamics.arrays import CAGE_ROTATION, RING
from oilfilm.cases import Case, load_case

LOADS = (100.0, 300.0)  # axial and radial, under which balls leave the outer race [N]
SAMPLED = {"end_time_s": 0.06, "output_interval_us": 20.0}
STEPS = {"end_time_s": 0.08, "output_interval_us": 200.0}
PARTS = 24  # of the turn


def with_cage(case: Case, **keys: Any) -> Case:
    """A case with other keys of [cage]."""
    assert case.file.cage is not None
    return replace(case, file=case.file.model_copy(update={"cage": case.file.cage.model_copy(update=keys)}))


def inward(result: Run) -> Any:
    """Force of its pocket on each ball towards the axis, shape (m, Z) [N]."""
    data = result.simulation.data
    c = data.constants
    forces = np.zeros((len(result.record.time), c.balls))
    for row, state in enumerate(result.record.state):
        body = place_bodies(c.balls, state, *data.schedule[-1, :2])[2]
        angle = state[RING + CAGE_ROTATION]
        turned = np.cos(angle), np.sin(angle)
        for j in range(c.balls):
            place = state[ball_position(j) : ball_position(j) + 3]
            frame = pocket_frame(c, body, data.pocket_direction[j], turned)
            normal = pocket_motion(c, body, frame, tuple(place))[0]  # into the wall that pushes back
            outward = place[1:] / np.hypot(*place[1:])
            forces[row, j] = result.record.pockets[row, j, 0] * float(np.dot(normal[1:], outward))
    return forces


def lifted(name: str, case: Case) -> None:
    """One line: share of the time without the outer race, where, and what acts there."""
    result = run(changed(case, LOADS, **SAMPLED))
    free = result.record.races[:, 1, :, 0] <= 0.0
    middles, share = over_azimuth(result, free.astype(float), PARTS)
    text = f"{name:34s} outer race free {free.mean():.3f}"
    c = result.simulation.data.constants
    worst = share > 0.5
    if worst.any() and c.cage_mass > 0.0:
        there = middles[worst]
        _, force = over_azimuth(result, inward(result), PARTS)
        _, inner = over_azimuth(result, result.record.races[:, 0, :, 0], PARTS)
        orbit = result.statistics.orbit_speed
        pull = c.ball_mass * 0.5 * (c.inner_centre + c.outer_centre) * orbit**2
        text += f"; above half from {there.min():.0f} to {there.max():.0f} deg"
        text += f", pocket {force[worst].mean():.2f} N inward, centrifugal {pull:.2f} N"
        text += f", inner race {inner[worst].mean():.2f} N"
    print(text, f"(cage {result.statistics.cage_speed / RPM:.1f} r/min)", flush=True)


def steps(name: str, case: Case) -> None:
    """Inner sliding outside the loaded zone less inside, over the radial loads."""
    found = []
    for load in RADIAL:
        result = run(changed(case, (0.0, load), **STEPS))
        inside, outside = zones(result)[:2]
        found.append((outside - inside, cage(result)))
    print(f"{name:34s} step", *(f"{step:.3f}" for step, _ in found), "m/s, cage", *(f"{c:.3f}" for _, c in found))


def main() -> None:
    """Balls that are lifted, then steps."""
    case = load_case("7008_combined")
    lifted("as shipped, drag 1.4 N", case)
    for drag in (0.7, 0.3, 0.0):
        lifted(f"drag {drag} N", changed(case, ball_drag_N=drag))
    lifted("without a film in the pockets", changed(case, cage_film=False))
    lifted("without friction in the pockets", with_cage(case, pocket_friction=0.0))
    lifted("pockets of 0.4 mm play", with_cage(case, pocket_clearance_mm=0.4))
    lifted("restitution 0.5", changed(case, restitution=0.5))
    lifted("friction at the centre alone", changed(case, friction_on="centre"))
    radial = load_case("7008_radial")
    print("radial loads", *RADIAL)
    steps("as shipped, drag 1.4 N", radial)
    steps("without friction in the pockets", with_cage(radial, pocket_friction=0.0))
    for drag in (0.3, 3.0):
        steps(f"drag {drag} N", changed(radial, ball_drag_N=drag))


if __name__ == "__main__":
    main()
