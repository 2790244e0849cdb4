"""Contacts as compiled functions: what ball and race, ball and pocket, cage and land do to each
other.

A body is a row of numbers: centre, axis, velocity, angular velocity, along x, y, z. Every pair
gets opposite forces at one point, and the power lost there follows from the velocities of the two
bodies at that point: the energies close.
"""

import numpy as np

from ehl.compiled import compiled
from ehl.traction._kernels import hertz_friction, table_lookup

from ..films._kernels import elastic_approach, smallest_load
from ..problem import COEFFICIENT, DAMPING, EXPONENT, FILM, FRICTIONLESS, STIFFNESS

# columns of a motion [m]
APPROACH = 19
THICKNESS = 20
# of the film of a land; nearer, its forces stay and the solid contact takes over [-]
ECCENTRICITY_LIMIT = 0.95


@compiled
def cross(a0, a1, a2, b0, b1, b2):
    """Vector product."""
    return a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0


@compiled
def elastic_force(law, approach):
    """K approach^n, zero in the gap."""
    if approach <= 0.0:
        return 0.0
    return law[STIFFNESS] * approach ** law[EXPONENT]


@compiled
def normal_force(law, approach, speed, impact_speed):
    """K approach^n (1 + chi speed/impact speed), never adhesive."""
    elastic = elastic_force(law, approach)
    return max(0.0, elastic * (1.0 + law[DAMPING] * speed / impact_speed))


@compiled
def ramped(friction, slide, ramp):
    """Coefficient of friction that rises linearly up to a sliding speed `ramp`."""
    return friction if slide >= ramp else friction * slide / ramp


@compiled
def wall_shear(radius, film):
    """Drag of a sphere sliding along a wall over that in free flow, Goldman, Cox and Brenner
    (1967).
    """
    return 8.0 / 15.0 * np.log(max(radius / film, 1.0)) + 0.9588


@compiled
def point_velocity(body, x, y, z):
    """Velocity of the point of a body at x, y, z."""
    w0, w1, w2 = cross(body[9], body[10], body[11], x - body[0], y - body[1], z - body[2])
    return body[6] + w0, body[7] + w1, body[8] + w2


@compiled
def groove_contact(body, centre_radius, reach, pos, normal):
    """Ball in a groove: approach, axial and radial part of the normal, radius, direction of the
    azimuth.

    reach = groove radius less ball radius; the approach is the distance of the ball from the
    circle of the groove's centres, less the reach. The normal into the race is written to
    normal[:3].
    """
    sx, sy, sz = pos[0] - body[0], pos[1] - body[1], pos[2] - body[2]
    a0, a1, a2 = body[3], body[4], body[5]
    axial = sx * a0 + sy * a1 + sz * a2
    ex, ey, ez = sx - axial * a0, sy - axial * a1, sz - axial * a2
    rho = np.sqrt(ex * ex + ey * ey + ez * ez)
    ex, ey, ez = ex / rho, ey / rho, ez / rho
    radial = rho - centre_radius
    distance = max(np.sqrt(axial * axial + radial * radial), 1e-12)
    c, r = axial / distance, radial / distance
    normal[0], normal[1], normal[2] = c * a0 + r * ex, c * a1 + r * ey, c * a2 + r * ez
    t0, t1, t2 = cross(a0, a1, a2, ex, ey, ez)
    return distance - reach, c, r, rho, t0, t1, t2


@compiled
def race_friction(kind, data, normal, motion, friction):
    """Friction of one race on all balls: F_x, F_y [N], M_n, M_y [N m]; at 6, 7 stiffness and
    damping of the film.

    Where films part the bodies the approach in the motion becomes that of the elastic bodies, and
    the damping fades below the table's smallest load as friction does.
    """
    for j in range(motion.shape[0]):
        k, out = motion[j], friction[j]
        k[THICKNESS] = 0.0
        if kind == FILM:
            distance = k[APPROACH]
            k[APPROACH] = elastic_approach(data.axes, data.scalars, normal, distance, k[16])
            k[THICKNESS] = k[APPROACH] - distance
        load = elastic_force(normal, k[APPROACH])
        if load <= 0.0 or kind == FRICTIONLESS:
            out[:] = 0.0
        elif kind == COEFFICIENT:
            hertz_friction(data.disc, data.law, data.shape, load, k[16], k[12], k[13], k[14], out)
        else:
            table_lookup(
                data.axes,
                data.constants,
                data.scalars,
                data.values,
                load,
                k[16],
                k[12],
                k[13],
                k[14],
                out,
            )
            if kind == FILM:
                out[7] *= min(1.0, load / smallest_load(data.axes))
            else:
                k[THICKNESS] = out[5]


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
