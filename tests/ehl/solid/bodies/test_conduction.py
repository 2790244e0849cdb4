"""Heat conductances of rings: the cylindrical shell, a measured ring, reciprocity, balance of heat."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.solid.bodies import RingCells, RingProfile, ring_conductances
from oilfilm.ehl.solid.bodies.conduction import _resistance, conduction_matrix
from oilfilm.ehl.solid.bodies.elasticity import hexahedra, surface_weights

INNER_6208 = RingProfile(
    groove_radius=6.17e-3, track_radius=24e-3, shoulder_radius=26.3e-3, seat_radius=20e-3, width=18e-3
)
STEEL = 45.0
BAND = 1.73e-3


def test_cylindrical_shell():
    """G = 2 pi k B/ln(r_2/r_1), evenly heated outside, bore at zero."""
    inner, outer, width, angle = 20e-3, 24e-3, 18e-3, 0.1

    def place(p):
        r = outer + (inner - outer) * p[2]
        return np.stack([p[1], r * np.cos(p[0]), r * np.sin(p[0])])

    body = hexahedra([np.linspace(0.0, angle, 2), np.linspace(0.0, width, 2), np.linspace(0.0, 1.0, 5)], place)
    weights = surface_weights(body, body.on(2, 0.0))[:, None]
    resistance = _resistance(conduction_matrix(body, STEEL), weights / weights.sum(), body.on(2, 1.0))
    whole = 2.0 * np.pi / angle / resistance[0, 0]
    assert_allclose(whole, 2.0 * np.pi * STEEL * width / np.log(outer / inner), rtol=1e-5)


def test_heat_of_a_narrow_band():
    """11.35 W/K on two three-dimensional meshes of linear cells, 0.3 % apart; mean rise of flanks and lands 0.276, of
    the side faces 0.119 of the track's. The usual shell has 27.9 W/K."""
    found = ring_conductances(INNER_6208, STEEL, BAND)
    assert_allclose(1.0 / found.resistance[0, 0], 11.35, rtol=0.01)
    assert_allclose(found.resistance[:, 0] / found.resistance[0, 0], [1.0, 0.276, 0.119], atol=0.01)


def test_network_has_the_resistances():
    """Heat into one surface flows to the seat; the network's temperatures are those of the solution."""
    found = ring_conductances(INNER_6208, STEEL, BAND)
    between, to_seat = found.between, found.to_seat
    assert_allclose(between, between.T, rtol=1e-9)
    network = np.diag(between.sum(axis=1) + to_seat) - between
    for k in range(3):
        temperatures = np.linalg.solve(network, np.eye(3)[k])
        assert_allclose(temperatures, found.resistance[:, k], rtol=1e-9)
        assert_allclose(to_seat @ temperatures, 1.0, rtol=1e-9)


def test_halved_cells():
    coarse, fine = (ring_conductances(INNER_6208, STEEL, BAND, RingCells(groove=n, land=n // 6)) for n in (24, 48))
    assert_allclose(coarse.resistance, fine.resistance, rtol=5e-3)


def test_a_band_wider_than_the_groove_is_refused():
    with pytest.raises(ValueError, match="track_half_width"):
        ring_conductances(INNER_6208, STEEL, 6e-3)
