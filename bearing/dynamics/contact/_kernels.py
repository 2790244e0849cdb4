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
def pressure_integrals(eps, cos_end, sin_end):
    """Integrals of cos^2, cos sin and sin^2 of theta over (1 + eps cos theta)^3 along the half of
    the circle that ends at (cos_end, sin_end).

    By Sommerfeld's substitution (1904) 1 + eps cos theta = (1 - eps^2)/(1 - eps cos psi).
    """
    d = 1.0 - eps * eps
    root = np.sqrt(d)
    end = 1.0 + eps * cos_end
    s = root * sin_end / end
    c = (eps + cos_end) / end
    start = 1.0 - eps * cos_end
    s0 = -root * sin_end / start
    c0 = (eps - cos_end) / start
    arc = np.arctan2(s * c0 - c * s0, c * c0 + s * s0)
    if arc < 0.0:
        arc += 2.0 * np.pi
    product = s * c - s0 * c0
    along = 0.5 * (arc + product) - 2.0 * eps * (s - s0) + eps * eps * arc
    mixed = 0.5 * (s * s - s0 * s0) + eps * (c - c0)
    return along / (d * d * root), mixed / (d * d), 0.5 * (arc - product) / (d * root)


@compiled
def land_film(radius, clearance, width, viscosity, ex, ey, vx, vy, mean_speed):
    """Film of a short journal bearing that carries pressure where it closes and is torn elsewhere:
    force on the journal, and 1/sqrt(1 - eps^2).

    p = (6 viscosity/h^3) (width^2/4 - z^2) max(0, -dh/dt) with dh/dt = clearance (turn sin theta -
    squeeze cos theta) seen by an observer who goes with the mean surface, theta from the thinnest
    film; Ocvirk (1952). Half the circle closes: which one, turning and squeezing decide together.
    (ex, ey) is the journal's eccentricity, (vx, vy) its rate, mean_speed half the sum of the
    speeds; the root is the factor of its friction.
    """
    e = np.sqrt(ex * ex + ey * ey)
    ux, uy = (ex / e, ey / e) if e > 1e-15 else (1.0, 0.0)
    eps = min(e / clearance, ECCENTRICITY_LIMIT)
    squeeze = (vx * ux + vy * uy) / clearance
    turn = mean_speed * eps - (vy * ux - vx * uy) / clearance  # (mean speed - whirl) eps
    root = 1.0 / np.sqrt(1.0 - eps * eps)
    closing = np.sqrt(squeeze * squeeze + turn * turn)
    if closing == 0.0:
        return 0.0, 0.0, root
    # the half ends a quarter of the circle after the direction (-squeeze, turn) of fastest closing
    cc, cs, ss = pressure_integrals(eps, -turn / closing, -squeeze / closing)
    scale = viscosity * radius * width**3 / clearance**2
    radial = scale * (-squeeze * cc + turn * cs)
    across = scale * (-squeeze * cs + turn * ss)
    return radial * ux - across * uy, radial * uy + across * ux, root
