"""A film as a list of nodes that shear, and its sliding forces for many motions; twin of the kernels' sums."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..rheology import Rheology, kernel_rheology, limiting_stress, shear_stress
from ..solution import ContactSolution
from .kinematics import ContactKinematics
from .shear import Cavitation, film_viscosity, sheared_width

Array = NDArray[np.float64]

HERTZ_SHARE = 0.02  # of the largest pressure: nodes above it are taken one by one
ENOUGH = 800  # nodes there that the integrals need
BLOCK = 4  # nodes along x and y that become one elsewhere
SHARE_LEFT_OUT = 1e-3  # of the friction at the largest sliding, in nodes that are not worth their time


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmNodes:
    """Nodes of a film: place, area, film, viscosity, limiting stress.

    Attributes
    ----------
    nodes : ndarray, shape (6, n)
        x, y [m], area times sheared width [m^2], film [m], viscosity [Pa s], limiting stress [Pa].
    half_width : float
        Transverse semi-axis, beyond which curvature slip does not grow [m].
    rheology : Rheology
    """

    nodes: Array
    half_width: float
    rheology: Rheology


def film_nodes(
    solution: ContactSolution,
    rheology: Rheology,
    largest_slide: float,
    *,
    temperature: float | None = None,
    left_out: float = SHARE_LEFT_OUT,
) -> FilmNodes:
    """Nodes of a film that count.

    Parameters
    ----------
    solution : ContactSolution
        Of dimensional conditions [m], [Pa].
    rheology : Rheology
    largest_slide : float
        Sliding speed [m/s] at which the friction of each node is weighed.
    temperature : float, optional
        For the limiting stress [K].
    left_out : float
        Share of the whole friction that the weakest nodes make and that is dropped with them [-].

    Returns
    -------
    FilmNodes
    """
    if solution.x is None or solution.y is None or solution.film is None:
        raise ValueError("solution: traction needs dimensional conditions, not Moes' groups alone")
    every = _stride(solution)
    x, y, h, p = solution.x[::every], solution.y[::every], solution.film[::every, ::every], solution.pressure
    p = p[::every, ::every]
    area = np.gradient(x)[:, None] * np.gradient(y)[None, :] * sheared_width(h, p, Cavitation.STRIATED)
    eta, limit = film_viscosity(solution)[::every, ::every], limiting_stress(p, rheology, temperature)
    gap = np.maximum(h, np.finfo(np.float64).tiny)
    strength = area * shear_stress(largest_slide / gap, eta, p, rheology, temperature)
    order = np.argsort(strength, axis=None)
    counts = np.zeros(strength.size, dtype=bool)
    counts[order[np.cumsum(strength.ravel()[order]) > left_out * strength.sum()]] = True
    counts = counts.reshape(strength.shape) & (area > 0.0)
    fields = np.stack(np.broadcast_arrays(x[:, None], y[None, :], area * counts, gap, eta, limit))
    near = p > HERTZ_SHARE * p.max()
    half_width = float(solution.semi_axis_x or 0.0) * solution.semi_axis_ratio
    return FilmNodes(nodes=_merged(fields, near), half_width=half_width, rheology=rheology)


def _stride(solution: ContactSolution) -> int:
    """Every how many nodes of a grid are enough for the integrals: `ENOUGH` in the Hertz zone."""
    near = int(np.count_nonzero(solution.pressure > HERTZ_SHARE * solution.pressure.max()))
    every = 1
    while near > 4 * ENOUGH * every**2 and (solution.X.size - 1) % (2 * every) == 0 == (solution.Y.size - 1) % (
        2 * every
    ):
        every *= 2
    return every


def _merged(fields: Array, near: NDArray[np.bool_]) -> Array:
    """Nodes of a grid, shape (6, n); those of blocks without a node of the Hertz zone become one, at its mean place.

    One node with the area, the fluidity-weighted film A/sum(A/h) and viscosity of the block shears a Newtonian oil as
    all of them do at equal sliding.
    """
    nx, ny = (-(-size // BLOCK) for size in near.shape)
    pad = ((0, nx * BLOCK - near.shape[0]), (0, ny * BLOCK - near.shape[1]))
    x, y, area, gap, eta, limit = (np.pad(part, pad, mode="edge") for part in fields)
    area = np.pad(fields[2], pad)
    block = np.add.outer(np.arange(nx * BLOCK) // BLOCK * ny, np.arange(ny * BLOCK) // BLOCK).ravel()
    fine = (np.bincount(block, np.pad(near, pad).ravel(), nx * ny) > 0)[block]

    def total(values: Array) -> Array:
        sums: Array = np.bincount(block, values.ravel(), nx * ny).astype(np.float64)
        return sums

    weight, thin = total(area), total(area / gap)
    kept = (weight > 0.0) & (np.bincount(block, fine, nx * ny) == 0)
    weight, thin = weight[kept], thin[kept]
    finite = np.where(np.isfinite(limit), limit, 0.0)
    bound = total(area * finite)[kept] / weight if np.isfinite(limit).all() else np.full(weight.size, np.inf)
    merged = (total(area * x)[kept] / weight, total(area * y)[kept] / weight, weight, weight / thin)
    single = fine & (area.ravel() > 0.0)
    far = np.stack([*merged, total(area * eta / gap)[kept] / thin, bound])
    return np.concatenate([np.stack([part.ravel()[single] for part in (x, y, area, gap, eta, limit)]), far], axis=1)


def sliding_forces(film: FilmNodes, slide: tuple[Array, Array, Array], rolling: Array, curvature: float) -> Array:
    """F_x, F_y [N] and M_n, M_y [N m] on body 1 by sliding, for each of n motions, shape (n, 4).

    Parameters
    ----------
    film : FilmNodes
    slide : tuple of ndarray, shape (n,)
        slide_x, slide_y [m/s] and spin [rad/s].
    rolling : ndarray, shape (n,)
        Relative rolling speed [rad/s].
    curvature : float
        1/(2R) of the loaded surface [1/m].
    """
    from . import _kernels

    r = kernel_rheology(film.rheology)
    out = np.empty((slide[0].size, _kernels.COLUMNS))
    law = (r.law, r.stress, r.exponent, r.breadth)
    _kernels.sliding_sums_many(film.nodes, *law, *slide, rolling, curvature, film.half_width, out)
    return out


def sliding_forces_twin(film: FilmNodes, kinematics: ContactKinematics) -> Array:
    """`sliding_forces` of one motion in NumPy, shape (4,), [N] and [N m]."""
    x, y, area, gap, eta, limit = film.nodes
    s_x, s_y = kinematics.sliding(x, y)
    speed = np.hypot(s_x, s_y)
    base = Rheology(
        law=film.rheology.law,
        eyring_stress=film.rheology.eyring_stress,
        carreau_modulus=film.rheology.carreau_modulus,
        carreau_exponent=film.rheology.carreau_exponent,
        yasuda_exponent=film.rheology.yasuda_exponent,
    )
    tau = shear_stress(speed / gap, eta, 0.0 * eta, base)
    finite = np.isfinite(limit)
    tau = np.where(finite, -np.where(finite, limit, 1.0) * np.expm1(-tau / np.where(finite, limit, 1.0)), tau)
    pull = area * tau / np.where(speed > 0.0, speed, 1.0)
    t_x, t_y = pull * s_x, pull * s_y
    return np.array([-t_x.sum(), -t_y.sum(), (y * t_x - x * t_y).sum(), -(kinematics.bow(y) * t_x).sum()])
