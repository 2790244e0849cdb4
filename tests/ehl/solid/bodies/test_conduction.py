"""Heat and thermal stress of rings: thick rings in closed form, a measured ring, halved cells."""

from __future__ import annotations

from math import log, pi

import numpy as np
import pytest
from numpy.testing import assert_allclose
from skfem import MeshQuad, MeshQuad2

from oilfilm.ehl.solid.bodies import RingCells, RingProfile, heated_ring, thermal_hoop
from oilfilm.ehl.solid.bodies.conduction import section_heated

INNER_6208 = RingProfile(
    groove_radius=6.17e-3, track_radius=24e-3, shoulder_radius=26.3e-3, seat_radius=20e-3, width=18e-3
)
STEEL = 45.0
BAND = 1.73e-3
NU = 0.26


def cylinder(a, b, width, across=40, along=4):
    """Half of a plain ring, heated outside, zero in the bore, and its hoop stress."""
    lines = np.linspace(0.0, 0.5 * width, along + 1), np.linspace(a, b, across + 1)
    mesh = MeshQuad2.from_mesh(MeshQuad.init_tensor(*lines))
    r = mesh.doflocs[1]
    return section_heated(mesh, np.isclose(r, b), np.isclose(r, a))


def thick_ring(r, a, b):
    """Hoop stress over E alpha of a thin disc, T = ln(r/a)/ln(b/a) (Timoshenko and Goodier, art. 150)."""

    def moment(x):
        return (0.5 * x**2 * np.log(x / a) - 0.25 * (x**2 - a**2)) / log(b / a)

    return -np.log(r / a) / log(b / a) + moment(r) / r**2 + (1.0 + a**2 / r**2) * moment(b) / (b**2 - a**2)


@pytest.mark.parametrize("b", [24e-3, 40e-3])
def test_a_thick_ring(b):
    """G = 2 pi B/ln(b/a); hoop stress of a disc, and 1/(1 - nu) of it in the middle of a long cylinder."""
    a = 20e-3
    thin = cylinder(a, b, 0.02 * (b - a))
    assert_allclose(thin.conductance, 2.0 * pi * 0.02 * (b - a) / log(b / a), rtol=1e-5)
    exact = thick_ring(thin.radius, a, b)
    assert_allclose(thermal_hoop(thin, NU), exact, atol=1e-3 * exact.max())
    long = cylinder(a, b, 12.0 * b, along=60)
    middle = long.mesh.doflocs[0] == 0.0
    expected = thick_ring(long.radius[middle], a, b) / (1.0 - NU)
    assert_allclose(thermal_hoop(long, NU)[middle], expected, atol=1e-3 * expected.max())


def test_heat_of_a_narrow_band():
    """11.35 W/K on two three-dimensional meshes of linear cells, 0.3 % apart. The usual shell has 27.9 W/K."""
    assert_allclose(STEEL * heated_ring(INNER_6208, BAND).conductance, 11.35, rtol=0.01)


def test_the_cold_side_of_a_grooved_ring_is_in_tension():
    """Largest in the bore below the groove, pressed in the track; the section as a whole has no resultant."""
    ring = heated_ring(INNER_6208, BAND)
    hoop = thermal_hoop(ring, NU)
    assert_allclose(ring.mesh.doflocs[:, hoop.argmax()], [0.0, 20e-3], atol=1e-9)
    assert ring.mesh.doflocs[1, hoop.argmin()] > 23.9e-3
    assert 0.3 < hoop.max() < 0.5 < -hoop.min() < 1.0


def test_halved_cells():
    coarse, fine = (heated_ring(INNER_6208, BAND, RingCells(groove=n, land=n // 6)) for n in (24, 48))
    assert_allclose(coarse.conductance, fine.conductance, rtol=2e-3)
    assert_allclose(thermal_hoop(coarse, NU).max(), thermal_hoop(fine, NU).max(), rtol=3e-3)
    assert_allclose(thermal_hoop(coarse, NU).min(), thermal_hoop(fine, NU).min(), rtol=1e-2)


def test_an_outer_ring_is_in_tension_at_its_outside():
    outer = RingProfile(
        groove_radius=6.29e-3, track_radius=36e-3, shoulder_radius=33.7e-3, seat_radius=40e-3, width=18e-3
    )
    ring = heated_ring(outer, BAND)
    assert_allclose(ring.radius[thermal_hoop(ring, NU).argmax()], 40e-3)


def test_a_band_wider_than_the_groove_is_refused():
    with pytest.raises(ValueError, match="track_half_width"):
        heated_ring(INNER_6208, 6e-3)
