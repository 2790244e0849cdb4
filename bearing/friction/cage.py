"""Balance of balls and cage: balls that the inner race does not drive are driven by the cage,
which the other balls push.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ..contacts.motion import ball_speeds
from ..quasistatic.solution import QuasistaticSolution
from .contact_friction import TINY
from .newton import BALANCE_TOLERANCE, MotionProblem, contacts_of, solve_with_couple_steps
from .resistance import Resistance, ResistedPower

CAGE_STEPS = 20  # rounds of the push of the cage
CAGE_TARGET = 1.0e-8  # change to stop at [-]
# slope of the required over the applied push above which a secant is not taken [-]
MAX_SECANT_SLOPE = 0.5
# orbit speed over that of the ball's surface below which the cage takes no ball along [-]: rings
# that turn against each other
STILL_ORBIT = 1.0e-2


class CageBalance(NamedTuple):
    """Balance of balls and cage: z [m/s], residual of each ball and change of the cage's push
    [-].
    """

    problem: MotionProblem
    z: Array
    residual: Array
    change: float


def balance_cage(
    solution: QuasistaticSolution, problem: MotionProblem, start: Array, resistance: Resistance
) -> CageBalance:
    """Balls in balance under the push of the cage that they themselves ask for.

    Balls that the inner race does not drive move with the cage, at a speed that follows from the
    others' balance under the push; the push is solved by secants.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing under a hypothesis
    problem : MotionProblem
        balance of the balls under their traction
    start : Array
        initial guess of the unknowns z, shape (balls, 4) [m/s]
    resistance : Resistance
        drag of oil, pockets and lands

    Returns
    -------
    CageBalance
        balance with the push that it needs
    """
    # 1. start with the cage at the mean speed of the balls that drive it
    z = _cage_driven_motion(solution, problem.driven, start)
    problem = _pushed(problem, _cage_force(solution, problem, z, resistance), resistance)
    last: tuple[Array, Array] | None = None  # push applied and required in the last round [N]
    for _ in range(CAGE_STEPS):
        # 2. balance of the race-driven balls under the push
        z, residual = solve_with_couple_steps(problem, z)
        # 3. motion of the others, and the push that this requires
        z = _cage_driven_motion(solution, problem.driven, z)
        applied = problem.cage_force
        required = _cage_force(solution, problem, z, resistance)
        largest = float(max(np.abs(required).max(), np.abs(applied).max()))
        change = float(np.abs(required - applied).max()) / largest if largest > 0.0 else 0.0
        failed = last is not None and not residual.max() <= BALANCE_TOLERANCE
        if change <= CAGE_TARGET or failed:
            break
        # 4. next push by a secant
        problem = _pushed(problem, _secant_cage_force(applied, required, last), resistance)
        last = applied, required
    return CageBalance(_pushed(problem, applied, resistance), z, residual, change)


def _pushed(problem: MotionProblem, push: Array, resistance: Resistance) -> MotionProblem:
    """The balance under a push into the cage [N], and the friction in the pockets with it."""
    return replace(problem, cage_force=push, pocket=resistance.pocket * np.abs(push))


def _secant_cage_force(applied: Array, required: Array, last: tuple[Array, Array] | None) -> Array:
    """Push [N] at which the line through two rounds requires what is applied; the required one
    where the line is steep.
    """
    if last is None:
        return required
    at = int(np.abs(applied).argmax())  # pushes of all rounds are in one proportion, by the loads
    step = float(applied[at] - last[0][at])
    slope = float(required[at] - last[1][at]) / step if step != 0.0 else np.inf
    if not slope < MAX_SECANT_SLOPE:
        return required
    return required + slope / (1.0 - slope) * (required - applied)


def orbit_velocities(solution: QuasistaticSolution) -> Array:
    """Velocities of the balls' centres along the orbit.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    Array
        velocities, shape (balls,) [m/s]
    """
    return solution.orbit_speed * 0.5 * solution.bearing.pitch_diameter


def ball_velocities(solution: QuasistaticSolution) -> Array:
    """Velocities of the balls: of their centres along the orbit, and of their rotation times the
    radius.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    Array
        velocities, shape (balls, 4) [m/s]
    """
    rotation = 0.5 * solution.bearing.ball_diameter * ball_speeds(solution)[1]
    return np.column_stack([orbit_velocities(solution), rotation])


def resisted_power(solution: QuasistaticSolution, resistance: Resistance) -> ResistedPower:
    """Power into the oil around the balls, pockets and the cage's land at the motion of an
    equilibrium.

    The cage is pushed by the loaded balls alone.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    resistance : Resistance
        drag of oil, pockets and lands

    Returns
    -------
    ResistedPower
        power by its kind [W]
    """
    speed = orbit_velocities(solution)
    load = solution.inner_load
    velocities = ball_velocities(solution)
    drag = float((resistance.drag(velocities) * velocities).sum())
    if not load.any():
        return ResistedPower(drag=drag)
    no_change = np.zeros((load.size, 4))
    pushed = resistance.cage_power(solution, driven_cage_speed(solution, load, no_change))
    push = pushed / max(abs(float((load * speed).sum())), TINY) * load
    surface = np.hypot(*rubbing_speeds(solution).T)
    pocket = float((resistance.pocket * np.abs(push) * surface).sum())
    return with_land(
        ResistedPower(drag=drag, pocket=pocket), solution, resistance, no_change, load
    )


def with_land(
    power: ResistedPower,
    solution: QuasistaticSolution,
    resistance: Resistance,
    z: Array,
    load: Array,
) -> ResistedPower:
    """The power with that of the cage's land.

    Parameters
    ----------
    power : ResistedPower
        power into oil and pockets [W]
    solution : QuasistaticSolution
        equilibrium of the bearing
    resistance : Resistance
        drag of oil, pockets and lands
    z : Array
        unknowns of the balls, shape (balls, 4) [m/s]
    load : Array
        loads of the balls that drive the cage, else zero, shape (balls,) [N]

    Returns
    -------
    ResistedPower
        power by its kind [W]
    """
    cage = driven_cage_speed(solution, load, z)
    guiding = resistance.guiding_power(solution, cage)
    return replace(power, land=resistance.cage_power(solution, cage) + guiding, guiding=guiding)


def rubbing_speeds(solution: QuasistaticSolution) -> Array:
    """Speeds of the balls' surfaces in their pockets along e_x and e_r.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    Array
        speeds, shape (balls, 2) [m/s]
    """
    return ball_velocities(solution)[:, 1:3]


def _cage_force(
    solution: QuasistaticSolution, problem: MotionProblem, z: Array, resistance: Resistance
) -> Array:
    """Push into the cage by the balls that the inner race drives, shared by their load [N].

    What the other balls cost, and the drag of the cage's guidance.
    """
    driving = problem.driven
    load = np.where(driving, solution.inner_load, 0.0)
    speed = orbit_velocities(solution) + z[:, 0]
    driving_power = float((load * speed).sum())
    if driving_power == 0.0:
        return np.zeros(driving.size)
    power = resistance.cage_power(solution, driven_cage_speed(solution, load, z))
    others = np.flatnonzero(~driving)
    if others.size:
        needed = _driven_power(solution, problem, z)[others]
        power += float(
            needed.sum() + cage_driven_pocket_power(solution, problem, z, resistance).sum()
        )
    return load * power / max(abs(driving_power), TINY) * np.sign(driving_power)


def _driven_power(solution: QuasistaticSolution, problem: MotionProblem, z: Array) -> Array:
    """Heat less what the rings feed in, and drag, of balls that the cage drives, (balls,) [W];
    zero of the others.
    """
    others = problem.first[~problem.driven[problem.first]]
    velocities = ball_velocities(solution) + z
    power = np.zeros(problem.driven.size)
    k = problem.start[others] + np.einsum("bckj,bj->bck", problem.slopes[others], z[others])
    gradient = problem.law.evaluate(k.reshape(-1, 4), contacts_of(others)).gradient
    heat = (gradient.reshape(k.shape) * (k - problem.ring_motion[others])).sum(axis=(1, 2))
    power[others] = heat + (problem.drag * velocities).sum(axis=1)[others]
    return power[problem.first][problem.like]


def cage_driven_pocket_power(
    solution: QuasistaticSolution, problem: MotionProblem, z: Array, resistance: Resistance
) -> Array:
    """Friction power in the pockets of balls that the cage drives.

    mu times the push that takes a ball along times the speed of its surface; zero if the cage
    hardly moves.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    problem : MotionProblem
        balance of the balls under their traction
    z : Array
        unknowns of the balls, shape (balls, 4) [m/s]
    resistance : Resistance
        drag of oil, pockets and lands

    Returns
    -------
    Array
        power, shape (balls,) [W]
    """
    others = np.flatnonzero(~problem.driven)
    if resistance.pocket == 0.0 or not others.size:
        return np.zeros(problem.driven.size)
    speed = np.abs(orbit_velocities(solution) + z[:, 0])
    surface = np.hypot(*(problem.rubbing + z[:, 1:3]).T)
    moving = speed > STILL_ORBIT * surface
    push = np.abs(_driven_power(solution, problem, z)) / np.where(moving, speed, 1.0)
    return np.where(moving, resistance.pocket * push * surface, 0.0)


def driven_cage_speed(solution: QuasistaticSolution, load: Array, z: Array) -> float:
    """Mean orbit speed of the balls that drive the cage, by load.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    load : Array
        loads of the balls that drive the cage, else zero, shape (balls,) [N]
    z : Array
        unknowns of the balls, shape (balls, 4) [m/s]

    Returns
    -------
    float
        speed of the cage [rad/s]
    """
    return float(
        (load * (solution.orbit_speed + z[:, 0] * 2.0 / solution.bearing.pitch_diameter)).sum()
        / load.sum()
    )


def _cage_driven_motion(
    solution: QuasistaticSolution, driving: NDArray[np.bool_], z: Array
) -> Array:
    """The unknowns [m/s] with balls that the inner race does not drive at the mean orbit speed of
    those that do.
    """
    load = solution.inner_load
    if driving.all() or not driving.any():
        return z
    bearing = solution.bearing
    outer = solution.operation.outer_speed
    radius = 0.5 * bearing.pitch_diameter
    mean = driven_cage_speed(solution, np.where(driving, load, 0.0), z)
    shifted = z.copy()
    rotation = ball_speeds(solution)[1]
    for i in np.flatnonzero(~driving):
        orbit = float(solution.orbit_speed[i])
        # rolling goes with the orbit
        faster = (mean - outer) / (orbit - outer) - 1.0 if orbit != outer else 0.0
        shifted[i, 0] = radius * (mean - orbit)
        shifted[i, 1:] = 0.5 * bearing.ball_diameter * faster * rotation[i]
    return shifted
