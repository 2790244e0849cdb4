"""Stiffness and damping behind a layer of oil: against full solves, and a slider in closed form."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from verification.contacts import moes as groups

from oilfilm.ehl import SolverOptions
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.multigrid.cycle import cycle, start_level
from oilfilm.ehl.multigrid.starved import StarvedFlux, flux_change
from oilfilm.ehl.oil.lubricant import InletLayer
from oilfilm.ehl.solver import solve_attempts, solve_with_inlet_film
from oilfilm.ehl.traction import normal_response
from oilfilm.ehl.traction.linear_response import _Right, linear_contact

from .test_normal_response import STEEL, on_two_meshes

BOX = {1.0: (-6.0, 1.6, 3.5), 0.1: (-4.0, 1.5, 1.22)}
CONTACTS = {1.0: groups(20.0, 10.0), 0.1: groups(200.0, 10.0, 0.1)}


@cache
def flooded(ratio):
    return solve_attempts(CONTACTS[ratio], SolverOptions(points=65, domain=BOX[ratio]))


def behind(ratio, share, points=65):
    """Levels behind a layer of so many flooded central films; not cached, as tests change them."""
    film = flooded(ratio)[0].film_central_dimensionless.value
    conditions = replace(CONTACTS[ratio], inlet_layer=InletLayer(thickness=(share * film,)))
    solution, levels = solve_with_inlet_film(conditions, SolverOptions(points=points, domain=BOX[ratio]))
    assert solution.converged
    return levels


def settled(levels, *, source=None, load=1.0, cycles=60):
    """Approach after many plain cycles with a source of oil, or another load."""
    index = len(levels.levels) - 1
    near = replace(levels, contact=replace(levels.contact, load=load * levels.contact.load))
    start_level(near, index, levels.levels[-1].P.copy())
    if source is not None:
        near.levels[-1].f = source
    for _ in range(cycles):
        cycle(near, index)
    return near.approach


@pytest.mark.parametrize(("ratio", "share"), [(1.0, 1.2), (1.0, 0.6), (0.1, 1.2)])
def test_both_are_the_slopes_of_full_solves(ratio, share):
    """By cycles, menisci free to move: another load; the oil that a slow movement squeezes, as a source."""
    levels = behind(ratio, share)
    contact = linear_contact(levels)
    slow = contact.slow()
    p, h = contact._solved(_Right(load=1.0))
    follow = contact._content(p, h) / h
    by_load = [settled(levels, load=1.0 + step) for step in (-2e-3, 2e-3)]
    stiffness = -4e-3 * levels.contact.load / (by_load[1] - by_load[0])
    assert_allclose(slow.stiffness, stiffness, rtol=2e-3)
    by_squeeze = [settled(levels, source=rate * follow) for rate in (-2e-3, 2e-3)]
    damping = -stiffness * (by_squeeze[1] - by_squeeze[0]) / 4e-3
    assert_allclose(slow.damping, damping, rtol=0.03)


def test_an_endless_layer_is_the_flooded_contact():
    endless = linear_contact(behind(1.0, 1e3)).slow()
    wet = linear_contact(flooded(1.0)[1]).slow()
    assert_allclose((endless.stiffness, endless.damping), (wet.stiffness, wet.damping), rtol=2e-3)


def test_less_oil_damps_less_and_wide_contacts_excite_slow_movement():
    """A circle keeps less and less; in a wide ellipse the meniscus takes more than it gives, if it has the time to."""
    wet = linear_contact(flooded(1.0)[1]).slow().damping
    shares = [linear_contact(behind(1.0, share)).slow().damping / wet for share in (3.0, 1.0, 0.5)]
    assert 1.0 > shares[0] > 0.5 > shares[1] > 0.1 > abs(shares[2])
    wide = linear_contact(behind(0.1, 1.1))
    assert wide.slow().damping < 0.0 < wide.at(0.3)[1]


def test_frequency_tends_to_slow_movement():
    contact = linear_contact(behind(1.0, 1.0))
    slow = contact.slow()
    assert_allclose(contact.at(0.01), (slow.stiffness, slow.damping), rtol=2e-2)


def gap(x, rise):
    return 1.0 + rise + 0.5 * x**2


class Slider:
    """A rigid parabola along a line, oil of viscosity one: P_x = (H - Q)/H^3, behind a layer and closing in slowly.

    Oil in the full part: Q = Q_s - V (x - s) for a gap that grows at V; at the meniscus, which moves at S = V ds/dh,
    Q_s = layer + (H_s - layer) S. Pressure is zero at s and, with its slope, at the rupture r.
    """

    def __init__(self, layer):
        self.layer = layer
        self.drift = (self.ends(1e-4)[0] - self.ends(-1e-4)[0]) / 2e-4

    def slope(self, x, ends, rise, speed):
        s = ends[0]
        flow = self.layer + (gap(s, rise) - self.layer) * self.drift * speed if speed else self.layer
        return (gap(x, rise) - flow + speed * (x - s)) / gap(x, rise) ** 3

    def ends(self, rise, speed=0.0):
        def rupture(s):
            return brentq(lambda x: self.slope(x, (s,), rise, speed), 0.0, 3.0, xtol=1e-13)

        def left(s):
            x = np.linspace(s, rupture(s), 4001)
            return np.trapezoid(self.slope(x, (s,), rise, speed), x)

        s = brentq(left, -8.0, -np.sqrt(2.0 * (self.layer - 1.0 - rise)) - 1e-3, xtol=1e-13)
        return s, rupture(s)

    def load(self, rise, speed):
        ends = self.ends(rise, speed)
        x = np.linspace(*ends, 4001)
        return -np.trapezoid(x * self.slope(x, ends, rise, speed), x)

    def stiffness_and_damping(self):
        step = 1e-4
        by_gap = (self.load(step, 0.0) - self.load(-step, 0.0)) / (2.0 * step)
        by_speed = (self.load(0.0, step) - self.load(0.0, -step)) / (2.0 * step)
        return -by_gap, -by_speed

    def pressure(self, x):
        ends = self.ends(0.0)
        fine = np.linspace(*ends, 20001)
        steps = np.diff(fine) * 0.5 * (self.slope(fine, ends, 0.0, 0.0)[1:] + self.slope(fine, ends, 0.0, 0.0)[:-1])
        return np.interp(x, fine, np.concatenate([[0.0], np.cumsum(steps)]), left=0.0, right=0.0)


def on_a_mesh(slider, cells, offset):
    """Stiffness and damping by the flux behind a layer; the grid's first node shifted by a share of its mesh."""
    grid = Grid(x_in=-5.0 + 8.0 / cells * offset, hx=8.0 / cells, hy=1.0, nx=cells, ny=3, symmetric=False)
    x, h = grid.X, grid.hx
    pressure, film = slider.pressure(x), gap(x, 0.0)
    nowhere = np.zeros(3, dtype=bool)
    flux = StarvedFlux(empty=np.tile(pressure <= 0.0, (3, 1)), gap_enters=nowhere, speed=np.ones((3, cells)))

    def faces(values):
        return 0.5 * (values[1:] + values[:-1])

    def changed(p, rise, source=0.0):
        """Rows and oil of the middle line, by a change of pressure and gap and a source."""
        flow = faces(film**3) * np.diff(p) + faces(3.0 * film**2 * rise) * np.diff(pressure)
        gained = np.zeros((3, cells))
        gained[1, 1:-1] = np.diff(flow) / h**2
        answer = flux_change(flux, grid, gained - source, np.full((3, cells), rise))
        return answer.rows[1], answer.content

    full = np.flatnonzero(pressure > 0.0)
    still = np.zeros(cells)
    matrix = np.array([changed(np.eye(cells)[i], 0.0)[0][full] for i in full]).T

    def solved(right):
        p = still.copy()
        p[full] = np.linalg.solve(matrix, right[full])
        return p

    first = solved(-changed(still, 1.0)[0])
    second = solved(-changed(still, 0.0, changed(first, 1.0)[1])[0])
    return -h * first.sum(), -h * second.sum()


@pytest.mark.parametrize("layer", [1.15, 1.05])
def test_a_slider_in_closed_form(layer):
    """Wherever the meniscus stands in its cell; damping is negative, as oil that fills the inlet is missing behind."""
    slider = Slider(layer)
    exact = slider.stiffness_and_damping()
    assert exact[1] < 0.0
    errors = []
    for cells in (160, 640):
        found = np.array([on_a_mesh(slider, cells, offset) for offset in np.arange(0.0, 1.0, 0.25)])
        errors.append(np.abs(found / exact - 1.0))
    assert np.all(errors[1].mean(axis=0) < 0.03)
    assert np.all(errors[1].max(axis=0) < 0.3 * errors[0].max(axis=0))


STARVED_STEEL = replace(STEEL, inlet_layer=InletLayer(thickness=(4e-7,)))


def test_error_bars_hold_the_finer_mesh():
    on_two_meshes(STARVED_STEEL)


def test_oil_across_the_lines_is_refused():
    """An entrainment that turns has no response behind a layer, and says so."""
    turning = replace(STARVED_STEEL, mean_spin=0.1 * STEEL.entrainment_speed / 1e-3)
    answer = normal_response(turning, SolverOptions(points=65))
    assert not answer.converged
    assert "across the lines" in answer.message
