"""Heat of sliding in a sheared film in NumPy, by bisection for each node's temperature."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from oilfilm.ehl.oil.shear_stress import shear_stress
from oilfilm.ehl.traction._heated_kernels import nahme
from oilfilm.ehl.traction.film_quadrature import on_strips, strip_positions

from .traction import mean_sliding, sliding_forces, summed_forces

HOTTEST = 3000.0  # [K], bound of the rise
HALVINGS = 36
PROFILE_STEPS = 10  # of the fixed point between softening and profile


def thinning_by_heat(wall, flux, gap, softening, conductivity):
    """ln of the ratio by which a rise of the walls [K] and a flux out of the film [W/m^2] reduce viscosity [-].

    gap [m]; softening: beta and c [1/K]; conductivity of the oil [W/(m K)].
    """
    soft, fall = softening
    loading = np.maximum(flux, 0.0) * gap / (8.0 * conductivity)
    middle = loading
    rise = np.zeros_like(loading)
    for _ in range(PROFILE_STEPS):
        local = soft / ((1.0 + fall * wall) * (1.0 + fall * (wall + middle)))
        rise, swell = nahme(loading * local)
        middle = swell / local
    return soft * wall / (1.0 + fall * wall) + rise


def heated_stress(film, slide, slide_x):
    """Stress at the nodes of `HeatedLines` for sliding speeds [m/s], shape (L, N) [Pa]; slide_x [m/s] at the centre."""
    _, _, _, gap, eta, pressure, temperature, soft, fall, _, _, capacity, conductivity = np.moveaxis(film.lines, -1, 0)
    response = film.wall_response(np.array([slide_x])).T * np.sqrt(film.span)
    flux = np.zeros((2, *gap.shape))
    before = np.zeros(gap.shape[0])
    tau = np.zeros_like(gap)
    for j in range(gap.shape[1]):
        past = np.einsum("blm,m->bl", flux[:, :, :j], film.history[j, :j]) * response
        own = response * film.history[j, j]
        between = conductivity[:, j] / gap[:, j]
        both = 1.0 + between * own.sum(axis=0)
        step = between * (past[1] - past[0]) / both
        walls = 0.5 * (past.sum(axis=0) + (own[0] - own[1]) * step)
        by_flux = 0.5 * (0.5 * own.sum(axis=0) + 2.0 * between * own[0] * own[1]) / both
        outward = 12.0 * between / (1.0 + 12.0 * between * by_flux)

        def column(rise, j=j, walls=walls, by_flux=by_flux, outward=outward):
            leaving = outward * (rise - walls)
            softening = (soft[:, j], fall[:, j])
            thinner = thinning_by_heat(walls + by_flux * leaving, leaving, gap[:, j], softening, conductivity[:, j])
            thinned = eta[:, j] * np.exp(-thinner)
            rate = slide[:, j] / gap[:, j]
            return shear_stress(rate, thinned, pressure[:, j], film.rheology, temperature[:, j] + rise), leaving

        low, high = np.zeros_like(walls), np.full_like(walls, HOTTEST)
        for _ in range(HALVINGS):
            rise = 0.5 * (low + high)
            stress, leaving = column(rise)
            cold = capacity[:, j] * (rise - before) + leaving < stress * slide[:, j]
            low, high = np.where(cold, rise, low), np.where(cold, high, rise)
        before = 0.5 * (low + high)
        tau[:, j], leaving = column(before)
        flux[0, :, j] = leaving * (0.5 + between * own[1]) / both + step
        flux[1, :, j] = leaving - flux[0, :, j]
    return tau


def strip_lines(lines):
    """Lines in the middle of each strip."""
    columns = np.moveaxis(lines.lines, -1, 0).copy()
    positive = [3, 4, 7, 11]  # film, viscosity, softening, capacity
    columns[positive] = np.log(columns[positive])
    y, width = strip_positions(columns[1], np.sqrt(12.0 * columns[10]))
    size = on_strips(np.sqrt(12.0 * columns[9]))
    found = np.stack([on_strips(column) for column in columns])
    found[positive] = np.exp(found[positive])
    found[1], found[2], found[9], found[10] = y, size * width, size**2 / 12.0, width**2 / 12.0
    return replace(lines, lines=np.moveaxis(found, 0, -1), span=on_strips(lines.span))


def heated_forces(film, kinematics):
    """`heated.film.heated_forces` of one motion, shape (4,), [N] and [N m], by the march along each strip."""
    strips = strip_lines(film.lines)
    x, y, area = np.moveaxis(strips.lines[..., :3], -1, 0)
    sliding = mean_sliding(kinematics, x, y, np.moveaxis(strips.lines[..., 9:11], -1, 0))
    tau = heated_stress(strips, sliding[2], kinematics.sliding_x)
    lines = summed_forces(kinematics, (x, y, area), tau, sliding)
    return lines + sliding_forces(film.low_pressure, kinematics)
