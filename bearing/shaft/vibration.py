"""Small vibrations of a shaft about its equilibrium: whirl, critical speeds, unbalance.

M q'' + (C + W G) q' + (K + S) q = f at the speed W; K has the tangents of the bearings at the
equilibrium (of its speed and load), G is the gyroscopic matrix over the speed. The films of the
balls damp by C; as the balls orbit they also push across, by the skew S, so that what turns with
the balls is not damped. Frequencies are those without C and S, which are small; their damping
follows from the undamped modes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin

import numpy as np
import scipy
from threadpoolctl import threadpool_limits

from oilfilm.ehl.arrays import Array

from .beam import FREEDOMS, RING, Beam
from .equilibrium import ShaftSolution, ring_part

ELEMENTS = (
    40  # at least along the shaft: its mass, and with it the frequencies, converge with them
)
# threads take thirty times as long as one on matrices this small, on a machine that is in use
one_thread = threadpool_limits.wrap(limits=1, user_api="blas")
MODES = 60  # at rest, of which those of the turning shaft are made [-]
NOT_HELD = (
    "the bearings do not hold the shaft in every direction (a light load in the play of a "
    "bearing, or no axial stiffness): no natural frequencies"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Vibration:
    """Matrices of the small vibrations of a shaft in its bearings."""

    beam: Beam
    stiffness: Array  # with the bearings, (n, n) [N/m], [N], [N m]
    damping: Array  # by the films of the bearings, (n, n) [N s/m], ...
    across: Array  # force over displacement by the orbit of the balls, (n, n) [N/m], ...
    free: Array  # unknowns that are not held


def vibration(
    solution: ShaftSolution,
    films: Sequence[tuple[Array, Array]] | None = None,
    longest: float | None = None,
) -> Vibration:
    """Matrices of the small vibrations about an equilibrium.

    Parameters
    ----------
    solution : ShaftSolution
        Converged equilibrium.
    films : sequence of (Array, Array), optional
        Damping of each bearing, and force across, `studies.stiffness.ring_damping`.
    longest : float, optional
        Longest element [m]; left out, a fortieth of the shaft.

    Returns
    -------
    Vibration
        Matrices of a mesh fine enough for frequencies.
    """
    system = solution.system
    part, tangent = _series(solution)
    length = system.sections[-1].end - system.sections[0].start
    beam = system.beam(longest or length / ELEMENTS)
    # places on the shaft per unknown
    select = np.zeros((part.shape[0], beam.stiffness.shape[0]))
    places = [FREEDOMS * beam.node(support.position) + RING for support in system.supports]
    select[np.arange(part.shape[0]), np.concatenate(places)] = 1.0
    stiffness = beam.stiffness + select.T @ (0.5 * (tangent + tangent.T)) @ select
    resisting, across = (np.zeros_like(stiffness) for _ in range(2))
    if films is not None:
        held = part @ select
        resisting, across = (
            held.T @ scipy.linalg.block_diag(*matrices) @ held
            for matrices in zip(*films, strict=True)
        )
    free = np.setdiff1d(np.arange(stiffness.shape[0]), [3])
    return Vibration(beam=beam, stiffness=stiffness, damping=resisting, across=across, free=free)


def _series(solution: ShaftSolution) -> tuple[Array, Array]:
    """Movement of the rings against their seats per movement of the shaft, and the force of
    bearings and housing in series on it.
    """
    part = scipy.linalg.block_diag(*(ring_part(state) for state in solution.bearings))
    bearings = scipy.linalg.block_diag(*(state.stiffness for state in solution.bearings))
    housing = solution.system.housing
    if housing is not None:
        # K_b (K_b + K_housing)^-1 K_housing
        part = part @ np.linalg.solve(bearings @ part + housing, housing)
    return part, bearings @ part


def support_matrices(solution: ShaftSolution, films: Sequence[Array]) -> list[tuple[Array, Array]]:
    """Stiffness and damping of each support, bearing and housing in series, the others at rest.

    Parameters
    ----------
    solution : ShaftSolution
        Converged equilibrium.
    films : sequence of Array
        Damping of each bearing, `studies.stiffness.ring_damping`.

    Returns
    -------
    list of (Array, Array)
        In the order x, y, z, tilt y, tilt z, (5, 5) each [N/m], [N s/m], ...
    """
    part, tangent = _series(solution)
    damping = part.T @ scipy.linalg.block_diag(*films) @ part
    blocks = [slice(row, row + RING.size) for row in range(0, tangent.shape[0], RING.size)]
    return [(tangent[block, block], damping[block, block]) for block in blocks]


@one_thread
def critical_speeds(matrices: Vibration, highest: float) -> Array:
    """Speeds at which a rotating unbalance meets a natural frequency.

    A motion that turns with the shaft, q = phi exp(i W t), obeys K phi = W^2 (M - i G) phi.

    Parameters
    ----------
    matrices : Vibration
        Of the shaft, undamped.
    highest : float
        Speeds above are left out [rad/s].

    Returns
    -------
    Array
        Ascending [rad/s]; lateral ones, of both directions of whirl.
    """
    mass, gyroscopic, scale = _over_root_of_stiffness(matrices)
    # eigenvalues 1/W^2 of a Hermitian matrix, with phi over the root of K
    values, vectors = scipy.linalg.eigh(mass - 1j * gyroscopic)
    speeds = []
    for value, vector in zip(values, vectors.T, strict=True):
        if value > 1.0 / highest**2 and _lateral(scale @ vector, matrices.free):
            speeds.append(value**-0.5)
    return np.array(sorted(speeds))


def _over_root_of_stiffness(matrices: Vibration) -> tuple[Array, Array, Array]:
    """Mass and gyroscopic matrix between R^-T, K = R^T R, and R^-1.

    Raises
    ------
    ValueError
        If the bearings do not hold the shaft in some direction, as light loads in the play of a
        bearing.
    """
    keep = np.ix_(matrices.free, matrices.free)
    stiffness = matrices.stiffness[keep]
    unit = np.diag(stiffness) ** 0.5
    if not (unit > 0.0).all():
        raise ValueError(NOT_HELD)
    try:
        upper = scipy.linalg.cholesky(stiffness / np.outer(unit, unit))
    except np.linalg.LinAlgError:
        raise ValueError(NOT_HELD) from None
    inverse = scipy.linalg.solve_triangular(upper, np.eye(unit.size)) / unit[:, None]
    mass = inverse.T @ matrices.beam.mass[keep] @ inverse
    gyroscopic = inverse.T @ matrices.beam.gyroscopic[keep] @ inverse
    return mass, gyroscopic, inverse


def _lateral(vector: Array, free: Array) -> bool:
    """Check for a motion that bends, not one along the axis or of torsion (at 1 m from it)."""
    freedom = free % FREEDOMS
    size = np.abs(vector)
    along = size[(freedom == 0) | (freedom == 3)].max()
    return bool(size[(freedom == 1) | (freedom == 2)].max() > along)


@one_thread
def whirl_frequencies(
    matrices: Vibration, speeds: Sequence[float], count: int
) -> tuple[Array, Array]:
    """Natural frequencies of bending over the speed of the shaft, for Campbell's diagram, and
    their damping ratios by the films.

    Parameters
    ----------
    matrices : Vibration
        Of the shaft; stiffness and damping of the bearings are kept.
    speeds : sequence of float
        Of the shaft [rad/s].
    count : int
        Number of frequencies, the lowest [-].

    Returns
    -------
    frequencies
        Shape (speeds, count) [rad/s].
    ratios
        Of the damping to the critical one, to first order (speeds, count) [-].
    """
    mass, gyroscopic, scale = _over_root_of_stiffness(matrices)
    # 1. the lowest modes at rest: M between them is the diagonal of 1/w^2
    flexibility, modes = scipy.linalg.eigh(mass)
    size = min(MODES, flexibility.size)
    flexibility = flexibility[-size:]
    modes = modes[:, -size:]
    at_rest = flexibility**-0.5
    turning = (modes.T @ gyroscopic @ modes) * np.outer(at_rest, at_rest)
    # 2. the gyroscopic moments couple them
    keep = np.ix_(matrices.free, matrices.free)
    damping, across = matrices.damping[keep], matrices.across[keep]
    rows, ratios = [], []
    for speed in speeds:
        # x' = S x with S skew, so that i S is Hermitian: its eigenvalues are the frequencies, in
        # pairs
        state = np.zeros((2 * size, 2 * size))
        state[:size, :size] = -speed * turning
        state[:size, size:] = -np.diag(at_rest)
        state[size:, :size] = np.diag(at_rest)
        values, vectors = scipy.linalg.eigh(1j * state)
        positive = values > 0.0
        shapes = scale @ modes @ vectors[size:, positive]
        bends = [_lateral(shape, matrices.free) for shape in shapes.T]
        found = values[positive][bends][:count]
        rows.append(found)
        # 3. the modes turn as exp(-i w t) and have the energy 1/4; C and S take 2 w/4 of it times
        # the ratio
        shape = shapes[:, bends][:, :count]
        force = -1j * found * (damping @ shape) + across @ shape
        ratios.append(-np.imag(np.sum(shape.conj() * force, axis=0)))
    return np.array(rows), np.array(ratios)


@one_thread
def unbalance_response(matrices: Vibration, solution: ShaftSolution, speed: float) -> Array:
    """Amplitudes of the nodes under the unbalances of the loads.

    Parameters
    ----------
    matrices : Vibration
        Of the shaft, with the damping of its bearings.
    solution : ShaftSolution
        With the unbalances among its loads.
    speed : float
        Of the shaft [rad/s].

    Returns
    -------
    Array
        Complex amplitudes, factors of exp(i W t), (nodes, 6) [m], [rad].
    """
    beam = matrices.beam
    force = np.zeros(beam.mass.shape[0], dtype=complex)
    for load in solution.system.loads:
        first = FREEDOMS * beam.node(load.position)
        pull = (
            load.unbalance
            * speed**2
            * (cos(load.unbalance_angle) + 1j * sin(load.unbalance_angle))
        )
        force[first + 1] += pull
        force[first + 2] += -1j * pull
    resisting = matrices.damping + speed * beam.gyroscopic
    dynamic = matrices.stiffness + matrices.across + 1j * speed * resisting - speed**2 * beam.mass
    found = np.zeros_like(force)
    keep = matrices.free
    found[keep] = np.linalg.solve(dynamic[np.ix_(keep, keep)], force[keep])
    return found.reshape(-1, FREEDOMS)
