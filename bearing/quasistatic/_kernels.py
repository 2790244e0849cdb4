"""Compiled equilibrium of balls at a given position of the inner ring, each by itself; the NumPy
twin, of all balls together, is `solve_balls_twin` of tests/reference.
"""

import numpy as np

from oilfilm.ehl.compiled import compiled
from oilfilm.ehl.oil._kernels import copy, copy_rows

from .kinematics import EDGE_COSINE, FRICTION_LIMIT, ROUND_OFF

OUTER_CONTROL = 0  # codes of hypotheses
INNER_CONTROL = 1
MEAN_ANGLE = 2
REACH = 0.5  # of the distance to the groove's centre within which a race has no angle [-]

COMPLEX_STEP = 1.0e-30  # [m]
BALL_TARGET = 1.0e-13  # residual of a ball over its forces at which iterating stops [-]
# residual of a ball over its forces that is accepted when it falls no further [-]
BALL_TOLERANCE = 1.0e-11
SUFFICIENT_DECREASE = 1.0e-4  # Armijo's constant (Nocedal and Wright, 2006, sec. 3.1) [-]
CUT = 0.4  # of a step that leads nowhere [-]
MAX_HALVINGS = 12
MAX_BALL_STEPS = 30
LONGEST_STEP = 0.25  # over the distance of the ball's centre from that of the outer groove [-]
SINGULAR = 1.0e-14  # determinant over squared entries of a matrix at which it counts as singular
STIFFENED = 0.1  # trace of stiffness in place of that of body forces, over forces and length [-]


@compiled
def root(z):
    """Square root of a positive number."""
    real = np.sqrt(z.real)
    return complex(real, 0.5 * z.imag / real)


@compiled
def unit(sine, cosine):
    """Direction of a pair of components."""
    length = root(sine * sine + cosine * cosine)
    return sine / length, cosine / length


@compiled
def stiffness(series, cosine):
    """Stiffness of `kinematics.stiffness_at`, by Clenshaw's recurrence [N/m^1.5]."""
    c = min(max(cosine.real, 0.0), 1.0)
    x = 2.0 * c - 1.0
    a = b = a_1 = b_1 = 0.0
    for k in range(series.shape[0] - 1, 0, -1):
        a, a_1 = series[k, 0] + 2.0 * x * a - a_1, a
        b, b_1 = series[k, 1] + 2.0 * x * b - b_1, b
    a = series[0, 0] + x * a - a_1
    b = series[0, 1] + x * b - b_1
    return np.exp(a) * (1.0 + b * (cosine - c))


@compiled
def smooth(value, full):
    """Smooth step of `balls._smooth_step` [-]."""
    if not value.real > 0.0:
        return complex(0.0, 0.0)
    if not value.real < full.real:
        return complex(1.0, 0.0)
    t = value / full
    return t * t * (3.0 - 2.0 * t)


@compiled
def pressed_load(series, distance, length, cosine):
    """Load of ball on race at the distance from its groove's centre [N]."""
    approach = distance - length
    if not approach.real > 0.0:
        return complex(0.0, 0.0)
    load = stiffness(series, cosine) * (approach * root(approach))
    return load * smooth(cosine, complex(EDGE_COSINE, 0.0))


@compiled
def attitude(outer, inner, gamma, code):
    """Attitude of `kinematics.attitude` [-]."""
    if code == OUTER_CONTROL:
        return unit(outer[0], outer[1] + gamma)
    if code == INNER_CONTROL:
        return unit(inner[0], inner[1] - gamma)
    return unit(outer[0] + inner[0], outer[1] + inner[1])


@compiled
def transmissible(load, fraction, sine, couple, diameter):
    """Fraction of `balls._transmissible_fraction` [-]."""
    asked = couple * sine * np.sign(sine.real)
    return smooth(FRICTION_LIMIT * load, fraction * asked / diameter)


@compiled
def shared_attitude(outer, inner, loads, shape, hypothesis):
    """Attitude and share of the inner race as `balls._shared_motion` has them [-]."""
    gamma, diameter, couple = shape
    code, part = hypothesis
    alone = attitude(outer, inner, gamma, OUTER_CONTROL)
    share = transmissible(loads[1], 2.0, alone[0], couple, diameter)
    beta = unit(share * alone[0], 1.0 + share * (alone[1] - 1.0))
    if code == OUTER_CONTROL:
        return beta, complex(1.0, 0.0)
    chosen = attitude(outer, inner, gamma, code)
    share = transmissible(loads[0], part, chosen[0], couple, diameter)
    sine = beta[0] + share * (chosen[0] - beta[0])
    return unit(sine, beta[1] + share * (chosen[1] - beta[1])), share


@compiled
def rolling(outer, inner, beta, gamma, speeds):
    """Orbit and spin as `kinematics.rolling_motion` [rad/s]."""
    radius_outer = 1.0 + gamma * outer[1]
    radius_inner = 1.0 - gamma * inner[1]
    arm_outer = outer[1] * beta[1] + outer[0] * beta[0]
    arm_inner = inner[1] * beta[1] + inner[0] * beta[0]
    total = radius_inner * arm_outer + radius_outer * arm_inner
    orbit = speeds[0] * radius_inner * arm_outer + speeds[1] * radius_outer * arm_inner
    spin = (speeds[0] - speeds[1]) / gamma * radius_inner * radius_outer / total
    return orbit / total, spin


@compiled
def body_forces(outer, inner, loads, sizes, speeds, hypothesis, prescribed):
    """Centrifugal force and friction at inner and outer race [N]; prescribed, shape (6,): orbit,
    spin [rad/s], sine and cosine of the attitude [-], friction at both races [N], where they are.
    """
    diameter, pitch, mass, couple = sizes
    if prescribed.size:
        orbit = complex(prescribed[0], 0.0)
        frictions = complex(prescribed[4], 0.0), complex(prescribed[5], 0.0)
    else:
        gamma = diameter / pitch
        shape = (gamma, diameter, couple)
        beta, share = shared_attitude(outer, inner, loads, shape, hypothesis)
        orbit, spin = rolling(outer, inner, beta, gamma, speeds)
        moment = 0.1 * mass * diameter**2 * orbit * spin * beta[0]
        part = hypothesis[1] * share
        frictions = part * moment / diameter, (2.0 - part) * moment / diameter
    return 0.5 * mass * pitch * orbit * orbit, frictions[0], frictions[1]


@compiled
def balance(u, w, lengths, sizes, speeds, hypothesis, prescribed, inner_series, outer_series):
    """State of one ball at u and w, (x, r) each [m], as `balls.ball_state` has it, and the sum of
    its loads and its centrifugal force [N]; lengths: of the arms, and radius of the inner groove
    [m].
    """
    inner_length, outer_length, groove = lengths
    distance = root(u[0] * u[0] + u[1] * u[1])
    outer = (u[0] / distance, u[1] / distance)
    outer_load = pressed_load(outer_series, distance, outer_length, outer[1])
    distance = w[0] * w[0] + w[1] * w[1]
    inner = outer
    inner_load = complex(0.0, 0.0)
    if w[1].real > 0.0 and distance.real > (REACH * inner_length) ** 2:
        distance = root(distance)
        inner = (w[0] / distance, w[1] / distance)
        inner_load = pressed_load(inner_series, distance, inner_length, inner[1])
    loads = (inner_load, outer_load)
    force, at_inner, at_outer = body_forces(
        outer, inner, loads, sizes, speeds, hypothesis, prescribed
    )
    inner_x = inner_load * inner[0] + at_inner * inner[1]
    inner_r = inner_load * inner[1] - at_inner * inner[0]
    left_x = inner_x - outer_load * outer[0] - at_outer * outer[1]
    left_r = inner_r - outer_load * outer[1] + at_outer * outer[0] + force
    size = (inner_load + outer_load + force).real
    return (left_x, left_r, -inner_x, -inner_r, -at_inner * groove, force), size


@compiled
def differentiated(u, V, prescribed, problem, values, jacobian):
    """Values (6,) of `balance` of a ball at u and V, (x, r) each [m], and by a complex step their
    derivatives (6, 4) by u_x, u_r, w_x, w_r; returns the sum of forces [N].

    prescribed: motion and friction where there are any, (6,), else none; problem: lengths, sizes,
    speeds, hypothesis, series of both races, force at the free contact angle.
    """
    lengths, sizes, speeds, hypothesis, inner_series, outer_series, _ = problem
    size = 0.0
    turned = np.zeros(4)
    for k in range(4):
        turned[:] = 0.0
        turned[k] = COMPLEX_STEP
        at = (complex(u[0], turned[0]), complex(u[1], turned[1]))
        reach = (complex(V[0] - u[0], turned[2]), complex(V[1] - u[1], turned[3]))
        found, size = balance(
            at, reach, lengths, sizes, speeds, hypothesis, prescribed, inner_series, outer_series
        )
        for f in range(6):
            jacobian[f, k] = found[f].imag / COMPLEX_STEP
            values[f] = found[f].real
    return size


@compiled
def rounding(jacobian, lengths):
    """Force [N] that rounding the position is worth: the approach is a small difference of
    lengths.
    """
    largest = 0.0
    for f in range(2):
        for k in range(4):
            largest = max(largest, abs(jacobian[f, k]))
    return ROUND_OFF * (lengths[0] + lengths[1]) * largest


@compiled
def solved_2x2(a, b, c, d, x, y):
    """Solve ((a, b), (c, d)) (s, t) = (x, y); along the force where the matrix, which is negative,
    is singular; a ball free of all force (matrix zero) does not move.
    """
    determinant = a * d - b * c
    scale = a * a + b * b + c * c + d * d
    if abs(determinant) > SINGULAR * scale:
        return (d * x - b * y) / determinant, (a * y - c * x) / determinant
    if scale > 0.0:
        return -x / np.sqrt(scale), -y / np.sqrt(scale)
    return 0.0, 0.0


@compiled
def contact_load(pull, length, series):
    """Load [N] of a contact whose groove's centre lies at a distance (x, r) of the ball's [m], and
    that distance; none far from the race.
    """
    distance = np.hypot(pull[0], pull[1])
    if not distance > length:
        return 0.0, distance
    cosine = complex(pull[1] / distance, 0.0)
    return pressed_load(series, complex(distance, 0.0), length, cosine).real, distance


@compiled
def elastic_step(u, V, values, problem):
    """Step [m] with the Hertz stiffness alone, which always leads along the force.

    Each contact gives K (1.5 delta^0.5 n n + delta^1.5/l (1 - n n)), l the distance from its
    groove's centre; what changes body forces and friction with the angles is left out, and a trace
    of stiffness is added in their place.
    """
    lengths, _, _, _, inner_series, outer_series, nominal = problem
    own = (u[0], u[1])
    outer, outer_distance = contact_load(own, lengths[1], outer_series)
    reach = (V[0] - u[0], V[1] - u[1])
    inner = 0.0
    inner_distance = np.hypot(reach[0], reach[1])
    if reach[1] > 0.0:
        inner, inner_distance = contact_load(reach, lengths[0], inner_series)
    weight = outer + inner + nominal
    xx = xr = rr = 0.0
    for side in range(2):
        load = inner if side == 0 else outer
        length = lengths[side]
        pull = reach if side == 0 else own
        distance = max(inner_distance if side == 0 else outer_distance, 1e-6 * length)
        n_x = pull[0] / distance
        n_r = pull[1] / distance
        stiff = 0.0
        if load > 0.0:
            stiff = 1.5 * load / max(distance - length, 1e-12 * length)
        across = load / distance
        trace = STIFFENED * weight / length
        xx += stiff * n_x * n_x + across * (1.0 - n_x * n_x) + trace
        xr += (stiff - across) * n_x * n_r
        rr += stiff * n_r * n_r + across * (1.0 - n_r * n_r) + trace
    return solved_2x2(xx, xr, xr, rr, values[0], values[1])


@compiled
def newton_step(u, V, values, jacobian, problem):
    """Newton step of a ball [m]; where it leads uphill in energy, that of springs in the two
    contacts; at most a part of the outer length long.
    """
    j = jacobian
    x, r = solved_2x2(
        j[0, 0] - j[0, 2],
        j[0, 1] - j[0, 3],
        j[1, 0] - j[1, 2],
        j[1, 1] - j[1, 3],
        -values[0],
        -values[1],
    )
    if not x * values[0] + r * values[1] > 0.0:
        x, r = elastic_step(u, V, values, problem)
    shorter = min(1.0, LONGEST_STEP * problem[0][1] / max(np.hypot(x, r), 1e-300))
    return x * shorter, r * shorter


@compiled
def backtracked(u, V, prescribed, problem, step, size, trial):
    """Shorten the step of a ball until its residual falls or the force no longer opposes it; the
    sum of forces there [N], below zero where it stays.

    trial: position (2,), values (6,) and derivatives (6, 4), before and after.
    """
    at, values, jacobian = trial
    norm = np.hypot(values[0], values[1])
    rough = norm > BALL_TOLERANCE * size
    factor = 1.0
    forces = -1.0
    for _ in range(MAX_HALVINGS):
        at[0] = u[0] + factor * step[0]
        at[1] = u[1] + factor * step[1]
        forces = differentiated(at, V, prescribed, problem, values, jacobian)
        left = np.hypot(values[0], values[1])
        smaller = left < (1.0 - SUFFICIENT_DECREASE * factor) * norm
        along = values[0] * step[0] + values[1] * step[1] > 0.0
        if smaller or (along and rough):
            return forces
        if not rough:
            return -1.0
        factor *= CUT
    return forces


@compiled
def balanced(u, V, prescribed, problem, values, jacobian):
    """Balance of a ball begun at u (2,) [m], which it changes with values and derivatives as in
    `differentiated`; returns the sum of forces [N].
    """
    size = differentiated(u, V, prescribed, problem, values, jacobian)
    trial = (np.empty(2), np.empty(6), np.empty((6, 4)))
    for _ in range(MAX_BALL_STEPS):
        # 1. done at the target
        if np.hypot(values[0], values[1]) <= max(
            BALL_TARGET * size, rounding(jacobian, problem[0])
        ):
            break
        # 2. Newton step, 3. shortened until the force left on the ball falls
        step = newton_step(u, V, values, jacobian, problem)
        if step[0] == 0.0 and step[1] == 0.0:
            break
        copy(values, trial[1])
        forces = backtracked(u, V, prescribed, problem, step, size, trial)
        if forces < 0.0:
            break
        size = forces
        copy(trial[0], u)
        copy(trial[1], values)
        copy_rows(trial[2], jacobian)
    return size


@compiled
def balanced_balls(u, V, prescribed, problem, out):
    """Balance of all balls, begun at u (2, Z) [m], changed here, at V (2, Z) [m]: values (6, Z),
    du/dV (2, 2, Z), change of the forces on the ring with V (4, 2, Z), sums of forces and what
    rounding is worth (2, Z).

    prescribed: (Z, 6) or (Z, 0); problem: as in `differentiated`.
    """
    values, du_dV, ring_dV, sizes = out
    own = np.empty(6)
    jacobian = np.empty((6, 4))
    at = np.empty(2)
    reach = np.empty(2)
    for z in range(u.shape[1]):
        copy(u[:, z], at)
        copy(V[:, z], reach)
        sizes[0, z] = balanced(at, reach, prescribed[z], problem, own, jacobian)
        sizes[1, z] = rounding(jacobian, problem[0])
        copy(at, u[:, z])
        copy(own, values[:, z])
        j = jacobian
        for k in range(2):
            x, r = solved_2x2(
                j[0, 0] - j[0, 2],
                j[0, 1] - j[0, 3],
                j[1, 0] - j[1, 2],
                j[1, 1] - j[1, 3],
                -j[0, 2 + k],
                -j[1, 2 + k],
            )
            du_dV[0, k, z] = x
            du_dV[1, k, z] = r
            for f in range(4):
                by_u = (j[2 + f, 0] - j[2 + f, 2]) * x + (j[2 + f, 1] - j[2 + f, 3]) * r
                ring_dV[f, k, z] = j[2 + f, 2 + k] + by_u
