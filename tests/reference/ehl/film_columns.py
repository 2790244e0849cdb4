"""Columns of film in NumPy: stress across each, and the integrals of the generalized Reynolds
equation. The reference for `oilfilm.ehl.generalized._kernels`, where the equations stand.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.generalized.film_heat import Section
from oilfilm.ehl.oil._kernels import LIMIT_POWER
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, limiting_stress
from oilfilm.ehl.oil.shear_stress import shear_stress

from .rheology import shear_rate, unlimited

Array = NDArray[np.float64]

# share of the limiting stress by which the stress of plain sliding may exceed it
LIMIT_EXCESS = 1e-3
NEWTON_STEPS = 100
TOLERANCE = 1e-12  # of the mean shear rate, relative to the mean of its magnitude across the film
# what counts as solved: near a limiting stress round-off may leave more than the tolerance
ACCEPTED = 1e-8
OVERSHOOT = 0.5  # of the slope along a step that may remain beyond its minimum
HALVINGS = 60
# share of the residual left by a step from which on the next is as long as for an exponential law
CREEPING = 0.2


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmColumns:
    """m columns of film, each with n nodes; SI. Body a is at z = 0, body b at z = h."""

    film: Array  # h, shape (m,) [m]
    pressure: Array  # shape (m,) [Pa]
    gradient: Array  # grad p, shape (m, 2) [Pa/m]
    speed_a: Array  # surface velocities (u, v), shape (m, 2) [m/s]
    speed_b: Array
    viscosity: Array  # low-shear viscosity at the nodes, shape (m, n) [Pa s]
    density: Array  # shape (m, n) [kg/m^3]
    temperature: Array | None = None  # mean over the film, for the limiting stress, shape (m,) [K]


@dataclass(frozen=True, slots=True, kw_only=True)
class ColumnFlow:
    """Integrals across the film after Yang and Wen (1990), each of shape (m,) or (m, 2)."""

    # (rho/eta)_e: the mass flux of the pressure is -(rho/eta)_e h^3/12 grad p [kg/(m^3 Pa s)]
    poiseuille: Array
    couette: Array  # mass flux of the surfaces over h [kg/(m^2 s)]
    # 12/h^3 times -d(mass flux)/d(grad p) at unchanged film, shape (m, 2, 2) [kg/(m^3 Pa s)]
    tangent: Array


def _newtonian_stress(tau: Array, rheology: Rheology, limit: Array, margin: Array) -> tuple[Array, Array]:
    """eta times the rate, and its derivative by tau, at the stress magnitude tau; a tangent from
    the margin on.
    """
    slope, beyond = np.ones_like(tau), np.zeros_like(tau)
    if rheology.limiting_coefficient is not None:
        share = np.minimum(tau / limit, 1.0 - margin)
        beyond = tau - share * limit
        tau, slope = unlimited(share, limit, rheology)
        if rheology.law is ShearLaw.CARREAU_YASUDA:
            tau, beyond = tau + slope * beyond, np.zeros_like(beyond)
    newtonian = shear_rate(tau, 1.0, 0.0, rheology.unlimited)
    if rheology.law is ShearLaw.REE_EYRING:
        slope = slope * np.hypot(1.0, newtonian / rheology.eyring_stress)
    elif rheology.law is ShearLaw.CARREAU_YASUDA:
        n, a = rheology.carreau_exponent, rheology.yasuda_exponent
        power = (newtonian / rheology.carreau_modulus) ** a
        relative = np.where(tau > 0.0, newtonian / np.where(tau > 0.0, tau, 1.0), 1.0)
        slope = slope * relative / (1.0 + (n - 1.0) * power / (1.0 + power))
    return newtonian + slope * beyond, slope


def _limits(columns: FilmColumns, rheology: Rheology, rate: Array) -> tuple[Array, Array]:
    """Limiting stress of each column, shape (m, 1), and the margin e from which on the law follows
    its tangent.
    """
    limit = limiting_stress(columns.pressure, rheology, columns.temperature)[:, None]
    thickest = columns.viscosity.max(axis=1, keepdims=True)
    base = shear_stress(np.hypot(rate[:, :1], rate[:, 1:]), thickest, 0.0, rheology.unlimited)
    margin = LIMIT_EXCESS / np.maximum(base / limit, 1.0)
    return limit, margin if rheology.law is ShearLaw.NEWTONIAN else margin / LIMIT_POWER


def _stresses(middle: Array, columns: FilmColumns, section: Section) -> Array:
    """Stress vectors at the nodes, shape (m, n, 2) [Pa]."""
    rise = (section.nodes - 0.5)[None, :, None] * (columns.film[:, None] * columns.gradient)[:, None, :]
    return middle[:, None, :] + rise


def fluidities(stress: Array, columns: FilmColumns, rheology: Rheology, rate: Array) -> tuple[Array, Array]:
    """1/eta* and the derivative of the rate's magnitude by the stress's, at the nodes [1/(Pa s)].

    Parameters
    ----------
    stress : ndarray, shape (m, n, 2)
        Stress vectors [Pa].
    columns : FilmColumns
    rheology : Rheology
    rate : ndarray, shape (m, 2)
        Mean shear rate of each column [1/s]; sets how near the limiting stress the law is
        followed.
    """
    limit, margin = _limits(columns, rheology, rate)
    magnitude = np.hypot(stress[..., 0], stress[..., 1])
    newtonian, slope = _newtonian_stress(magnitude, rheology, limit, margin)
    relative = np.where(magnitude > 0.0, newtonian / np.where(magnitude > 0.0, magnitude, 1.0), 1.0)
    return relative / columns.viscosity, slope / columns.viscosity


def mid_stress(
    columns: FilmColumns, section: Section, rheology: Rheology, start: Array | None = None
) -> tuple[Array, NDArray[np.bool_]]:
    """Stress tau_m in the middle of the film from the difference of the surface velocities [Pa].

    Parameters
    ----------
    columns : FilmColumns
    section : Section
    rheology : Rheology
    start : ndarray, shape (m, 2), optional
        First guess [Pa]; None: the stress of the mean rate at the mean fluidity.

    Returns
    -------
    stress : ndarray, shape (m, 2)
        [Pa].
    converged : ndarray of bool, shape (m,)
    """
    rate = (columns.speed_b - columns.speed_a) / columns.film[:, None]
    middle = _first_guess(columns, section, rheology, rate) if start is None else start.copy()
    residual, jacobian, scale = _balance(middle, columns, section, rheology, rate)
    size = np.hypot(residual[:, 0], residual[:, 1])
    creeping = np.zeros(len(middle), dtype=np.bool_)
    wanted = np.hypot(rate[:, 0], rate[:, 1])
    for _ in range(NEWTON_STEPS):
        open_ones = size > TOLERANCE * scale
        if not open_ones.any():
            break
        step = -np.linalg.solve(jacobian, residual[..., None])[..., 0] * open_ones[:, None]
        before = (residual * step).sum(axis=1)
        share = np.where(
            creeping, np.log(np.clip(size / np.maximum(wanted, scale * TOLERANCE), np.exp(1.0), 1e12)), 1.0
        )
        for _ in range(HALVINGS):
            trial = middle + share[:, None] * step
            residual, jacobian, scale = _balance(trial, columns, section, rheology, rate)
            too_far = (residual * step).sum(axis=1) > -OVERSHOOT * before
            if not too_far.any():
                break
            share = np.where(too_far, 0.5 * share, share)
        middle, last = trial, size
        size = np.hypot(residual[:, 0], residual[:, 1])
        creeping = size > CREEPING * last
    return middle, size <= ACCEPTED * scale


def _first_guess(columns: FilmColumns, section: Section, rheology: Rheology, rate: Array) -> Array:
    mean = 1.0 / (section.weights / columns.viscosity).sum(axis=1)
    magnitude = np.hypot(rate[:, 0], rate[:, 1])
    stress = shear_stress(magnitude, mean, columns.pressure, rheology, columns.temperature)
    sliding = np.where(magnitude > 0.0, magnitude, 1.0)
    return stress[:, None] * rate / sliding[:, None]


def _balance(
    middle: Array, columns: FilmColumns, section: Section, rheology: Rheology, rate: Array
) -> tuple[Array, Array, Array]:
    """Mean rate less the wanted one [1/s], its derivative by tau_m, and the mean of the rate's
    magnitude [1/s].
    """
    stress = _stresses(middle, columns, section)
    fluidity, slope = fluidities(stress, columns, rheology, rate)
    magnitude = np.hypot(stress[..., 0], stress[..., 1])
    rates = fluidity[..., None] * stress
    residual = np.einsum("k,mkc->mc", section.weights, rates) - rate
    unit = stress / np.where(magnitude > 0.0, magnitude, 1.0)[..., None]
    excess = (slope - fluidity) * section.weights
    jacobian = np.einsum("mk,mkc,mkd->mcd", excess, unit, unit)
    jacobian += (section.weights * fluidity).sum(axis=1)[:, None, None] * np.eye(2)
    scale = (section.weights * fluidity * magnitude).sum(axis=1) + np.hypot(rate[:, 0], rate[:, 1])
    return residual, jacobian, scale


def flow_integrals(columns: FilmColumns, section: Section, rheology: Rheology, middle: Array) -> ColumnFlow:
    """Integrals across the film, Yang and Wen (1990).

    With 1/eta_e = (1/h) int dz/eta*, 1/eta'_e = (1/h^2) int z dz/eta*, rho_e = (1/h) int rho dz,
    rho'_e = (1/h^2) int rho int_0^z dz'/eta* dz, rho''_e = (1/h^3) int rho int_0^z z' dz'/eta* dz:
    (rho/eta)_e = 12 (eta_e rho'_e/eta'_e - rho''_e) [kg/(m^3 Pa s)], and the mass flux of the
    surfaces over h, rho'_e eta_e (u_b - u_a) + rho_e u_a [kg/(m^2 s)], in both directions. The
    tangent is that of both parts together.

    Parameters
    ----------
    columns : FilmColumns
    section : Section
    rheology : Rheology
    middle : ndarray, shape (m, 2)
        Stress in the middle of the film [Pa].
    """
    rate = (columns.speed_b - columns.speed_a) / columns.film[:, None]
    stress = _stresses(middle, columns, section)
    fluidity, slope = fluidities(stress, columns, rheology, rate)
    w, z = section.weights, section.nodes
    mean = fluidity @ w
    moment = fluidity @ (w * z)
    first = (columns.density * (fluidity @ section.cumulative.T)) @ w
    second = (columns.density * ((fluidity * z) @ section.cumulative.T)) @ w
    slide = (first / mean)[:, None] * (columns.speed_b - columns.speed_a)
    return ColumnFlow(
        poiseuille=12.0 * (moment / mean * first - second),
        couette=slide + (columns.density @ w)[:, None] * columns.speed_a,
        tangent=_tangent(stress, fluidity, slope, columns.density, section),
    )


def _tangent(stress: Array, fluidity: Array, slope: Array, density: Array, section: Section) -> Array:
    """The integrals of Yang and Wen with the tangent fluidity d(rate)/d(tau), a tensor, in place
    of 1/eta*.
    """
    magnitude = np.hypot(stress[..., 0], stress[..., 1])
    unit = stress / np.where(magnitude > 0.0, magnitude, 1.0)[..., None]
    tensor = (slope - fluidity)[..., None, None] * unit[..., :, None] * unit[..., None, :]
    tensor = tensor + fluidity[..., None, None] * np.eye(2)
    w = section.weights
    wz = section.weights * section.nodes
    mean, moment = np.einsum("k,mkcd->mcd", w, tensor), np.einsum("k,mkcd->mcd", wz, tensor)
    inner = np.einsum("k,mk,kl,mlcd->mcd", w, density, section.cumulative, tensor, optimize=True)
    inner_z = np.einsum("k,mk,kl,l,mlcd->mcd", w, density, section.cumulative, section.nodes, tensor, optimize=True)
    return 12.0 * (inner @ np.linalg.solve(mean, moment) - inner_z)
