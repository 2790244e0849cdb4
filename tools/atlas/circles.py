"""What the rolling moment loses as bodies are circles, by Kapitza's pressure of elastic bodies and by the solution.

`python tools/atlas/circles.py SEED NUMBER` draws contacts of balls on grooves, solves each on 129 points, counts its
moment in the gap of circles and in that of paraboloids, and prints A, L, R_x/R_y, the layer over a^2/R_x + h_c, the
share of the moment that is lost, and that share by `oilfilm.ehl.traction.rolling_moment.circles_moment_loss`.
"""

from __future__ import annotations

import sys
from math import exp, log

import numpy as np

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.hertz import hertz_coefficients
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.traction.rolling_moment import MeniscusRegion, circles_moment_loss, rolling_moment

POINTS = 129
MODULUS = (2.26e11, 3.1e11)  # E' of steel on steel, and of ceramics [Pa]
BALL, RACE, CONFORMITY = (3e-3, 15e-3), (2.5, 8.0), (0.51, 0.54)  # radii [m], over the ball's, over its diameter
PRESSURE, VISCOSITY, SPEED, LAYER = (0.6e9, 3e9), (5e-3, 0.1), (1.0, 25.0), (2e-5, 2e-4)  # SI
LEAST_LAYER = 3.0  # over a^2/Rx + h_c


def drawn(rng: np.random.Generator) -> ContactConditions:
    """A ball on the race of an inner or an outer ring."""

    def between(ends: tuple[float, float]) -> float:
        return exp(rng.uniform(log(ends[0]), log(ends[1])))

    ball = between(BALL)
    race = ball * between(RACE) * (-1.0 if rng.random() < 0.5 else 1.0)
    groove = 2.0 * ball * between(CONFORMITY)
    oil = Lubricant(viscosity=between(VISCOSITY), pressure_viscosity=20e-9, flooded_layer=between(LAYER))
    radius_x, radius_y = 1.0 / (1.0 / ball + 1.0 / race), 1.0 / (1.0 / ball - 1.0 / groove)
    modulus = between(MODULUS)
    wanted = between(PRESSURE) / (hertz_coefficients(radius_x / radius_y)[1] * modulus)
    return ContactConditions(
        load=wanted**3 * modulus * radius_x**2,
        radius_x=radius_x,
        radius_y=radius_y,
        reduced_modulus=modulus,
        entrainment_speed=between(SPEED),
        lubricant=oil,
        ball_radius=ball,
    )


def paraboloid(self: MeniscusRegion, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """No excess of circles."""
    return np.zeros(np.broadcast(x, y).shape)


def main(seed: int, number: int) -> None:
    """Draw, solve and print."""
    rng = np.random.default_rng(seed)
    circles = MeniscusRegion._excess
    print("A, L, Rx/Ry, layer, lost by the solution, by Kapitza's pressure")
    found: list[float] = []
    while len(found) < number:
        contact = drawn(rng)
        scaled = scale_contact(contact)
        solution = solve_contact(contact, SolverOptions(points=POINTS))
        film, layer = solution.film_central, contact.lubricant.flooded_layer
        if not solution.resolved or film is None or layer < LEAST_LAYER * (scaled.film_scale + film):
            continue
        height = layer / (scaled.film_scale + film)
        moment = rolling_moment(solution).value
        MeniscusRegion._excess = paraboloid
        flat = rolling_moment(solution).value
        MeniscusRegion._excess = circles
        axes = (scaled.semi_axis_x, scaled.semi_axis_x * scaled.semi_axis_ratio)
        lost = circles_moment_loss(contact, axes, film, layer)
        found.append((lost - (flat - moment)) / flat)
        load = hertz_coefficients(scaled.radius_ratio)[0] ** 2 * scaled.moes_load ** (2.0 / 3.0)
        place = f"{load:.3g} {scaled.moes_lubricant:.3g} {scaled.radius_ratio:.3g} {height:.3g}"
        print(place, f"{1.0 - moment / flat:.4f} {lost / flat:.4f}", flush=True)
    print(f"difference, 95 %: {np.quantile(np.abs(found), 0.95):.4f}, mean {np.mean(found):.4f} of the moment")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
