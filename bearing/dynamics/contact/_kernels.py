"""Laws of the contacts, compiled: normal force, friction, motion of a point, films.

Every pair of bodies gets opposite forces at one point, and the power lost there follows from the
velocities of the two bodies at that point: the energies close.
"""

import numpy as np

from ehl.compiled import compiled

from .._state_kernels import accumulate, cross, minus, plus
from ..arrays import DAMPING, EXPONENT, FORCE, MOMENT, STIFFNESS

# of the film of a land; beyond it its forces stay and the solid contact takes over [-]
ECCENTRICITY_LIMIT = 0.95


@compiled
def elastic_force(law, approach):
    """K approach^n, zero in the gap."""
    if approach <= 0.0:
        return 0.0
    if law[EXPONENT] == 1.5:  # a root costs a fifth of a power
        return law[STIFFNESS] * approach * np.sqrt(approach)
    return law[STIFFNESS] * approach ** law[EXPONENT]


@compiled
def elastic_energy(law, approach):
    """K approach^(n + 1)/(n + 1), stored in a contact."""
    return elastic_force(law, approach) * max(approach, 0.0) / (law[EXPONENT] + 1.0)


@compiled
def normal_force(law, approach, speed, impact_speed):
    """K approach^n (1 + chi speed/impact speed), never adhesive."""
    return damped(law, elastic_force(law, approach), speed, impact_speed)


@compiled
def damped(law, elastic, speed, impact_speed):
    """Elastic force with its damping, never adhesive."""
    if elastic <= 0.0:
        return 0.0
    return max(0.0, elastic * (1.0 + law[DAMPING] * speed / impact_speed))


@compiled
def ramped(friction, slide, ramp):
    """Coefficient of friction that rises linearly up to a sliding speed `ramp`."""
    return friction if slide >= ramp else friction * slide / ramp


@compiled
def point_velocity(body, point):
    """Velocity of a point of a body."""
    return plus(body.velocity, cross(body.turn, minus(point, body.centre)))


@compiled
def add_load(load, body, point, force):
    """Add a force at a point to the force on a body and to the moment about its centre."""
    accumulate(load, FORCE, force)
    accumulate(load, MOMENT, cross(minus(point, body.centre), force))


@compiled
def land_film(radius, clearance, width, viscosity, ex, ey, vx, vy, mean_speed):
    """Film of a short journal bearing with a cavitated half (Ocvirk): force on the journal, and
    1/sqrt(1 - eps^2).

    (ex, ey) is the journal's eccentricity, (vx, vy) its rate, mean_speed half the sum of the
    speeds; the root is the factor of its friction.
    """
    e = np.sqrt(ex * ex + ey * ey)
    if e < 1e-15:
        return 0.0, 0.0, 1.0
    ux, uy = ex / e, ey / e
    eps = min(e / clearance, ECCENTRICITY_LIMIT)
    squeeze = (vx * ux + vy * uy) / clearance
    turn = mean_speed * eps - (vy * ux - vx * uy) / clearance  # (mean speed - whirl) eps
    d = 1.0 - eps * eps
    scale = viscosity * radius * width**3 / clearance**2
    radial = scale * (
        -2.0 * eps * abs(turn) / d**2 - 0.5 * np.pi * squeeze * (1.0 + 2.0 * eps**2) / d**2.5
    )
    sense = 1.0 if turn >= 0.0 else -1.0
    across = scale * (0.5 * np.pi * turn / d**1.5 + sense * 2.0 * eps * squeeze / d**2)
    return radial * ux - across * uy, radial * uy + across * ux, 1.0 / np.sqrt(d)
