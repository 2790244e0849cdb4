"""Friction torque from the shear of the solved films, and the balls' motion in which that shear balances itself.

The forces and moments of a contact f = (F_x, F_y, M_n, M_y) on the ball (`ehl.traction.integrate_traction`) belong to
the relative motion k = (S_x, S_y, Omega, omega) of ball and race, and -f k is the power turned into heat. Divided by
the speed of the shaft, it is the torque, exactly so where the forces balance on every ball (traction equilibrium): then
the rings' power is the heat. Under a hypothesis such as race control they do not, and `imbalance` tells by how much.

The films are those solved without sliding at the contacts' centres; how much sliding thins them is left out.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ehl.rheology import Rheology, shear_stress
from ehl.solution import ContactSolution
from ehl.traction.shear import Cavitation, film_viscosity, sheared_width

from ..contacts import BearingContact
from ..geometry import Array
from ..quasistatic import QuasistaticSolution
from ..traction_forces import ContactTraction, bearing_kinematics, contact_traction
from .balance import BalancedFriction, balance_balls, ring_power
from .contact_friction import TINY, Dissipation

STRENGTH = 0.05  # traction coefficient that residual forces are measured against [-]
SLOPE_STEP = 1.0e-4  # relative change of the shear rate for a difference quotient [-]
STILL = 1.0e-9  # [m/s] sliding below which the stress counts as proportional to it


@dataclass(frozen=True, slots=True, kw_only=True)
class IntegratedTorque:
    """Heat of the contacts over the shaft's speed, by what it works against, and the balance of power.

    Attributes
    ----------
    rolling, sliding, spin, curvature : float
        Of the pressure flow, of sliding at the centres, of spin, of the surfaces' curvature [N m].
    shaft_power : float
        What the two rings feed into the contacts [W].
    heat : float
        What the contacts turn into heat [W].
    per_ball : ndarray, shape (balls,)
        Torque by ball [N m].
    """

    rolling: float
    sliding: float
    spin: float
    curvature: float
    shaft_power: float
    heat: float
    per_ball: Array

    @property
    def total(self) -> float:
        """Sum of the four [N m]."""
        return self.rolling + self.sliding + self.spin + self.curvature

    @property
    def imbalance(self) -> float:
        """Rings' power less heat, over the heat [-]: what accelerates balls that are not in balance."""
        return (self.shaft_power - self.heat) / self.heat if self.heat > 0.0 else 0.0


def integrated_torque(solution: QuasistaticSolution, tractions: Sequence[ContactTraction]) -> IntegratedTorque:
    """Torque of the shear of all lubricated contacts, at the motion the tractions were integrated for.

    Parameters
    ----------
    solution : QuasistaticSolution
        With rings that turn against each other [rad/s].
    tractions : sequence of ContactTraction
        Of every lubricated contact.

    Returns
    -------
    IntegratedTorque
        [N m], [W].
    """
    speed = abs(solution.operation.inner_speed - solution.operation.outer_speed)
    parts = np.zeros(4)
    balls, shaft = np.zeros(solution.azimuth.size), 0.0
    for part in tractions:
        k, r = part.kinematics, part.result
        parts[0] += r.pumping_loss
        parts[1] -= r.sliding_force_x * k.sliding_x + r.sliding_force_y * k.sliding_y
        parts[2] -= r.spin_moment * k.spin
        parts[3] -= r.curvature_moment * k.rolling
        balls[part.contact.ball - 1] += r.power_loss / speed
        force = np.array([r.force_x, r.force_y, r.spin_moment, r.rolling_moment_1])
        shaft += ring_power(solution, part.contact, force)
    rolling, sliding, spin, curvature = (float(power) / speed for power in parts)
    return IntegratedTorque(
        rolling=rolling,
        sliding=sliding,
        spin=spin,
        curvature=curvature,
        shaft_power=shaft,
        heat=float(parts.sum()),
        per_ball=balls,
    )


def film_balance(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | None],
    rheology: Rheology,
) -> BalancedFriction:
    """Motion of all balls in which the shear of their films balances itself, films and loads held.

    Parameters
    ----------
    solution : QuasistaticSolution
    contacts : sequence of BearingContact
        All of its contacts, inner then outer, ball by ball.
    films : sequence of ContactSolution or None
        One per contact, None where there is no load.
    rheology : Rheology

    Returns
    -------
    BalancedFriction
        Its forces contain the hydrodynamic rolling moment.
    """
    laws = [
        None if film is None else _film_law(solution, contact, film, rheology)
        for contact, film in zip(contacts, films, strict=True)
    ]

    def law(motion: Array) -> Dissipation:
        gradient, curvature = np.zeros((len(laws), 4)), np.zeros((len(laws), 4, 4))
        for i, contact in enumerate(laws):
            if contact is not None:
                gradient[i], curvature[i] = contact(motion[i])
        return Dissipation(np.zeros(len(laws)), gradient, curvature)

    load = np.array([0.0 if film is None else contact.load for contact, film in zip(contacts, films, strict=True)])
    return balance_balls(solution, contacts, law, STRENGTH * load)


def balanced_tractions(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | None],
    rheology: Rheology,
    balance: BalancedFriction,
) -> tuple[ContactTraction, ...]:
    """Tractions of all contacts with a film at balanced motions; arguments as in `film_balance`, forces in [N]."""
    return tuple(
        contact_traction(solution, contact, film, rheology, balance.motions[contact.ball - 1])
        for contact, film in zip(contacts, films, strict=True)
        if film is not None
    )


def _film_law(
    solution: QuasistaticSolution, contact: BearingContact, film: ContactSolution, rheology: Rheology
) -> Callable[[Array], tuple[Array, Array]]:
    """Gradient (4,) and curvature (4, 4) of a film's friction by the motion, as `integrate_traction` sums it."""
    if film.x is None or film.y is None or film.film is None:
        raise ValueError("films must have dimensional conditions")
    x, y = np.broadcast_arrays(film.x[:, None], film.y[None, :])
    width = sheared_width(film.film, film.pressure, Cavitation.STRIATED)
    area = _weights(film.x)[:, None] * _weights(film.y)[None, :]
    hydrodynamic = float(np.sum(area * x * film.pressure))
    chosen = width > 0.0
    x, y, area = x[chosen], y[chosen], (area * width)[chosen]
    gap, pressure, eta = film.film[chosen], film.pressure[chosen], film_viscosity(film)[chosen]
    kinematics = bearing_kinematics(solution, contact)
    bow = -kinematics.curvature * y**2
    pumping = -hydrodynamic * np.array([0.5 * kinematics.curvature_difference, 0.0, 0.0, 1.0])
    temperature = solution.operation.temperature
    zeros, ones = np.zeros_like(x), np.ones_like(x)
    along, across = np.stack([ones, zeros, -y, bow]), np.stack([zeros, ones, x, zeros])

    def law(motion: Array) -> tuple[Array, Array]:
        s_x, s_y = motion @ along, motion @ across
        speed = np.sqrt(s_x**2 + s_y**2 + STILL**2)
        rate = speed / np.maximum(gap, TINY)
        stress = shear_stress(rate, eta, pressure, rheology, temperature)
        faster = shear_stress((1.0 + SLOPE_STEP) * rate, eta, pressure, rheology, temperature)
        secant, tangent = area * stress / speed, area * (faster - stress) / (SLOPE_STEP * speed)
        pull = s_x * along + s_y * across
        gradient = pull @ secant + pumping
        curvature = (along * secant) @ along.T + (across * secant) @ across.T
        return gradient, curvature + (pull * ((tangent - secant) / speed**2)) @ pull.T

    return law


def _weights(nodes: Array) -> Array:
    """Weights of the trapezoidal rule, as `integrate_traction` has them [m]."""
    weights = np.gradient(nodes)
    weights[[0, -1]] *= 0.5
    return np.asarray(weights)
