"""Balls of a bearing without a cage where they meet each other, compiled."""

from ehl.compiled import compiled

from .._state_kernels import accumulate, ball_motion, cross, dot, minus, norm, plus, times
from ..arrays import CONTACT, FORCE, MOMENT, POCKET, WORK
from ._kernels import elastic_force, normal_force, ramped


@compiled
def ball_collisions(p, balls, memory, y):
    """Each ball and the next one: Hertz contact with Coulomb friction, in the places of the
    pockets, of which there are none.
    """
    c = p.constants
    law = p.normal[POCKET]
    power = p.power
    for j in range(c.balls):
        k = (j + 1) % c.balls
        out = balls[j].pocket_out
        forces = balls[j].forces
        next_forces = balls[k].forces
        position, velocity, turn = ball_motion(y, c.balls, j)
        other, other_velocity, other_turn = ball_motion(y, c.balls, k)
        offset = minus(other, position)
        distance = norm(offset)
        normal = times(1.0 / distance, offset)
        approach = 2.0 * c.ball_radius - distance
        relative = minus(velocity, other_velocity)
        rate = dot(relative, normal)
        push = normal_force(law, approach, rate, memory[POCKET * c.balls + j])
        out[CONTACT.load] = push
        out[CONTACT.approach] = approach
        out[CONTACT.approach_speed] = rate
        if push <= 0.0:
            continue
        arm = times(c.ball_radius, normal)
        slide = minus(plus(relative, cross(plus(turn, other_turn), arm)), times(rate, normal))
        speed = norm(slide)
        pull = push * ramped(c.ball_friction, speed, c.friction_ramp) / max(speed, 1e-300)
        power[WORK.pocket_damping] += (push - elastic_force(law, approach)) * rate
        power[WORK.pocket_friction] += pull * speed * speed
        grip = times(-pull, slide)
        force = minus(grip, times(push, normal))
        moment = cross(arm, grip)
        accumulate(forces, FORCE, force)
        accumulate(next_forces, FORCE, times(-1.0, force))
        accumulate(forces, MOMENT, moment)
        accumulate(next_forces, MOMENT, moment)
