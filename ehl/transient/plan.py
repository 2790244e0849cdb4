"""Times of the steps: the film moves from node to node in each, where it moves fast enough."""

import numpy as np
from scipy.optimize import brentq

from ..arrays import Array
from .inputs import Impact, TransientConditions

GROWTH = 1.5  # of a step over the one before; second order backwards is stable below 2.41
LONGEST_STEP = 4.0  # steps as long as this many of those at the speed of the scales
MAX_STEPS = 1_000_000
IMPACT_STEPS = 300.0  # of the time that dry elastic bodies touch each other
FULL_NODE = 1.0 - 1e-9  # of a node, that counts as one


def step_times(conditions: TransientConditions, mesh: float, largest: float | None) -> Array:
    """Plan the times of all steps from t = 0.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    mesh : float
        distance of the nodes along the entrainment [m]
    largest : float | None
        longest step; None: four times that in which the film moves by a node [s]

    Returns
    -------
    Array
        times, shape (n + 1,) [s]

    Raises
    ------
    ValueError
        if there are more than `MAX_STEPS`
    """
    usual = mesh / conditions.contact.entrainment_speed
    longest = LONGEST_STEP * usual if largest is None else largest
    if largest is None and conditions.impact is not None:
        longest = impact_time(conditions, conditions.impact) / IMPACT_STEPS
    times = [0.0]
    before = longest
    while times[-1] < conditions.end_time * FULL_NODE:
        step = min(_step(conditions, times[-1], mesh, longest), GROWTH * before)
        left = conditions.end_time - times[-1]
        if conditions.impact is not None or conditions.speed is not None:
            step = min(step, left)
        times.append(times[-1] + step)
        before = step
        if len(times) > MAX_STEPS:
            raise ValueError(f"end_time: takes more than {MAX_STEPS} steps")
    return np.array(times)


def _step(conditions: TransientConditions, time: float, mesh: float, longest: float) -> float:
    """In which the film moves by a node, `longest` at most [s]."""
    if conditions.speed is None:
        return min(mesh / conditions.contact.entrainment_speed, longest)
    start = conditions.displacement(time)

    def beyond(step: float) -> float:
        return abs(conditions.displacement(time + step) - start) - mesh

    if beyond(longest) <= 0.0:
        return longest
    return float(brentq(beyond, 0.0, longest, xtol=1e-12 * longest, rtol=1e-14))


def nodes_moved(conditions: TransientConditions, times: Array, mesh: float) -> Array:
    """Count the nodes that the film moves by in each step; whole numbers without round-off.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    times : Array
        times of the steps, shape (n + 1,) [s]
    mesh : float
        distance of the nodes along the entrainment [m]

    Returns
    -------
    Array
        nodes, of either sign, shape (n,) [-]
    """
    displacement = np.array([conditions.displacement(float(time)) for time in times])
    moved = np.diff(displacement) / mesh
    whole = np.round(moved)
    return np.where((np.abs(moved - whole) < 1e-6) & (whole != 0.0), whole, moved)


def impact_time(conditions: TransientConditions, impact: Impact) -> float:
    """Estimate the time that dry elastic spheres touch each other, Johnson (1985), sec. 11.4.

    2.94 d/V with the largest approach d = (15 m V^2/(16 sqrt(R) E*))^(2/5), R the mean radius of
    the contact.

    Parameters
    ----------
    conditions : TransientConditions
        contact over time
    impact : Impact
        mass and speed of the bodies

    Returns
    -------
    float
        time [s]
    """
    c = conditions.contact
    radius = (c.radius_x * c.radius_y) ** 0.5
    energy = 15.0 * impact.mass * impact.approach_speed**2
    deepest = (energy / (16.0 * radius**0.5 * 0.5 * c.reduced_modulus)) ** 0.4
    return 2.94 * deepest / abs(impact.approach_speed)
