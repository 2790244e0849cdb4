"""Compiled balance of balls for complex steps; the equations are those of `balls` and
`kinematics`, whose NumPy functions are its twins.

Numbers are complex with imaginary parts so small that their products vanish.
"""

import numpy as np

from ehl.compiled import compiled

from .limits import EDGE_COSINE, FRICTION_LIMIT

OUTER_CONTROL = 0  # codes of hypotheses
INNER_CONTROL = 1
MEAN_ANGLE = 2
REACH = 0.5  # of the distance to the groove's centre within which a race has no angle [-]


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
    """As `stiffness_at`, by Clenshaw's recurrence [N/m^1.5]."""
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
    """As `balls._smooth_step` [-]."""
    if not value.real < full.real:
        return complex(1.0, 0.0)
    if not value.real > 0.0:
        return complex(0.0, 0.0)
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
    """As `kinematics.attitude` [-]."""
    if code == OUTER_CONTROL:
        return unit(outer[0], outer[1] + gamma)
    if code == INNER_CONTROL:
        return unit(inner[0], inner[1] - gamma)
    return unit(outer[0] + inner[0], outer[1] + inner[1])


@compiled
def transmissible(load, part, sine, couple, diameter):
    """As `balls._transmissible_share` [-]."""
    asked = couple * sine * np.sign(sine.real)
    return smooth(FRICTION_LIMIT * load, part * asked / diameter)


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
    """What `balls.ball_balance` gives of one ball at u and w, (x, r) each [m], and the sum of its
    loads and its centrifugal force [N]; lengths: of the arms, and radius of the inner groove [m].
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
