"""Stiffness of a bearing over speed, and damping by its films."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl import Lubricant
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import RPM

from ..contacts.contact import BearingContact
from ..contacts.contacts import contact_conditions
from ..films.unsolved_films import film_lag
from ..geometry import SINGLE, Bearing, Row
from ..operation import Operation, QuasistaticModel
from ..quasistatic.ring import ring_of
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic


@dataclass(frozen=True, slots=True, kw_only=True)
class StiffnessOverSpeed:
    """Stiffness and displacement of the inner ring over its speed; NaN without an equilibrium."""

    speeds: Array  # of the inner ring [rad/s], shape (n,)
    # d(load)/d(displacement) in the order x, y, z, tilt y, tilt z, shape (n, 5, 5)
    matrices: Array  # [N/m], [N/rad], [N m/rad]
    displacements: Array  # [m], [rad], shape (n, 5)
    messages: tuple[str, ...]  # of the speeds without an equilibrium
    damping: Array  # by the films, in the same order; zero without oil (n, 5, 5) [N s/m], ...

    @property
    def converged(self) -> NDArray[np.bool_]:
        """True for the speeds with an equilibrium, shape (n,) [-]."""
        return np.asarray(np.isfinite(self.matrices).all(axis=(1, 2)))


def stiffness_over_speed(
    bearing: Bearing,
    operation: Operation,
    speeds: Sequence[float],
    model: QuasistaticModel | None = None,
    rows: Sequence[Row] = SINGLE,
    solve: Callable[..., QuasistaticSolution] = solve_quasistatic,
    oil: Lubricant | None = None,
) -> StiffnessOverSpeed:
    """Stiffness at several speeds of the inner ring, all else as in the operation.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        loads; its inner speed is replaced
    speeds : Sequence[float]
        speeds of the inner ring, shape (n,) [rad/s]
    model : QuasistaticModel | None, optional
        assumptions of the equilibrium
    rows : Sequence[Row], default SINGLE
        rows of balls on the inner ring
    solve : Callable[..., QuasistaticSolution], default solve_quasistatic
        called as `solve_quasistatic`
    oil : Lubricant | None, optional
        lubricant of the films that damp

    Returns
    -------
    StiffnessOverSpeed
        stiffness and displacement over speed, NaN without an equilibrium
    """
    matrices = np.full((len(speeds), 5, 5), np.nan)
    damping = np.zeros_like(matrices)
    displacements = np.full((len(speeds), 5), np.nan)
    last: QuasistaticSolution | None = None
    messages = []
    for index, speed in enumerate(speeds):
        at_speed = replace(operation, inner_speed=float(speed))
        solution = solve(bearing, at_speed, model, initial_guess=last, rows=rows)
        if solution.converged:
            matrices[index] = solution.stiffness
            displacements[index] = [*solution.displacement, *solution.tilt]
            if oil is not None:
                damping[index], _ = ring_damping(solution, contact_conditions(solution, oil))
            last = solution
        else:
            messages.append(f"{speed / RPM:.6g} r/min: {solution.message}")
    return StiffnessOverSpeed(
        speeds=np.asarray(speeds, dtype=np.float64),
        matrices=matrices,
        displacements=displacements,
        messages=tuple(messages),
        damping=damping,
    )


def ring_damping(
    state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[Array, Array]:
    """Damping of a ring by the films of its balls, and the force across by their orbit.

    Inner and outer film of a ball act one after the other, along the contact angle of the inner
    race. The balls orbit at w_b, so that the approach of a ball changes by the movement u of the
    ring and by its own: f = sum c g (g' du/dt + w_b (dg/dpsi)' u), g the approach over u.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts; those without a film do not damp.

    Returns
    -------
    damping
        In the order x, y, z, tilt y, tilt z (5, 5) [N s/m], [N s], [N m s].
    across
        Force over displacement, likewise (5, 5) [N/m], [N], [N m].
    """
    balls = state.azimuth.size
    lag, flexibility = np.zeros(balls), np.zeros(balls)
    films = np.zeros(balls)
    for contact in contacts:
        if contact.conditions is None or contact.hertz is None:
            continue
        ball = contact.ball - 1
        films[ball] += 1
        lag[ball] += film_lag(contact.conditions, contact.hertz)
        flexibility[ball] += contact.hertz.approach / (1.5 * contact.load)
    both = films == 2.0
    damping = np.where(both, lag / np.where(both, flexibility, 1.0) ** 2, 0.0)
    ring = ring_of(state.bearing, state.operation, state.rows)
    angle = state.inner_contact_angle
    turned = np.zeros_like(ring.movement)
    turned[:, [1, 3]] = -ring.movement[:, [2, 4]]
    turned[:, [2, 4]] = ring.movement[:, [1, 3]]
    approach, orbiting = (
        (np.sin(angle) * m[0] + np.cos(angle) * m[1]) * ring.scale[:, None]
        for m in (ring.movement, turned)
    )
    return (
        (damping * approach) @ approach.T,
        (damping * state.orbit_speed * approach) @ orbiting.T,
    )
