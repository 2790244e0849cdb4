"""Paths over hollows, what a contact leaves of waves, laws of contacts: closed forms."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.vibration._kernels import height_at, law_at
from oilfilm.bearing.vibration.assembly import SolvedFilms, dry_law, film_law, linear_law
from oilfilm.bearing.vibration.form import (
    POINTS,
    Defect,
    DefectKind,
    FormBody,
    SurfaceForm,
    Wave,
    heights,
    hollow,
    rolled,
)
from oilfilm.bearing.vibration.transmission import dry_transmission, filtered

RADIUS, REDUCED = 0.0235, 0.0048  # of a track and of ball and race [m]
CELL = 2.0 * np.pi * RADIUS / POINTS


def spall(width, depth=1e-3, kind=DefectKind.SPALL):
    return Defect(place=FormBody.OUTER, kind=kind, width=width, depth=depth, azimuth=1.0)


@pytest.mark.parametrize("width", [0.18e-3, 0.53e-3, 2e-3])
def test_a_ball_drops_into_a_gap_until_it_touches_both_edges(width):
    """w^2/(8 R_x) to what a cell of the table leaves of the width; nothing outside."""
    path = rolled(-hollow(spall(width), RADIUS), RADIUS, REDUCED)
    assert_allclose(-path.min(), width**2 / (8.0 * REDUCED), rtol=5.0 * CELL / width)
    middle = path.argmin() / POINTS * 2.0 * np.pi
    assert_allclose(middle, 1.0, atol=3e-4)
    assert_allclose((path < 0.0).sum() * CELL, width, atol=3.0 * CELL)
    near = np.arange(POINTS) * CELL - (1.0 * RADIUS - 0.5 * width)
    u = 0.25 * width
    assert_allclose(np.interp(u, near, path), -(u**2) / (2.0 * REDUCED), rtol=0.1)


def test_a_shallow_hollow_is_followed_to_its_bottom():
    for kind in DefectKind:
        path = rolled(-hollow(spall(2e-3, depth=2e-6, kind=kind), RADIUS), RADIUS, REDUCED)
        assert_allclose(path.min(), -2e-6, rtol=1e-4)


def test_long_waves_are_rolled_over_as_they_are():
    form = SurfaceForm(waves={FormBody.INNER: (Wave(order=9, amplitude=1e-6, phase=0.3),)})
    profile = heights(form, FormBody.INNER)
    # a slope touches the ball beside its lowest point: slope^2 R_x/2
    steepest = 9e-6 / RADIUS
    assert_allclose(rolled(profile, RADIUS, REDUCED), profile, atol=1.01 * steepest**2 * REDUCED / 2.0)
    angle = 1.2345
    height, slope = height_at(profile, angle + 4.0 * np.pi)
    assert_allclose(height, 1e-6 * np.cos(9 * angle + 0.3), rtol=1e-5)
    assert_allclose(slope, -9e-6 * np.sin(9 * angle + 0.3), rtol=2e-3)


def test_profiles_and_orders_add():
    even = 1e-6 * np.sin(2.0 * np.pi * np.arange(3600) / 3600.0)
    form = SurfaceForm(waves={FormBody.OUTER: (Wave(order=1, amplitude=1e-6),)}, profiles={FormBody.OUTER: even})
    angle = 2.0 * np.pi * np.arange(POINTS) / POINTS
    assert_allclose(heights(form, FormBody.OUTER), 1e-6 * (np.cos(angle) + np.sin(angle)), atol=1e-11)


@pytest.mark.parametrize("order", [3, 100, 700])
def test_a_dry_contact_takes_the_mean_over_its_length(order):
    """sin(ka)/(ka) of a wave; by the marginal of the pressure that a small load adds, even over the length."""
    semi_axis = 0.2e-3
    profile = np.cos(order * 2.0 * np.pi * np.arange(POINTS) / POINTS)
    left = filtered(profile, dry_transmission(semi_axis), RADIUS)
    number = order * semi_axis / RADIUS
    assert_allclose(left, np.sin(number) / number * profile, atol=1e-12)
    # the integral itself, along x after y: dp/dF = 1/(2 pi a b sqrt(1 - x^2/a^2 - y^2/b^2))
    x = np.cos((np.arange(4000) + 0.5) / 4000 * np.pi)
    assert_allclose(
        np.sum(np.sqrt(1.0 - x**2) * np.cos(number * x)) * np.pi / 4000 / 2.0, np.sin(number) / number, atol=1e-6
    )


def test_laws_of_contacts():
    """Hertz and springs as they are; energy the integral of the force; a film's stiffness between its loads."""
    factor, largest = 5e10, 1500.0
    approach = (0.3 * largest / factor) ** (2.0 / 3.0)
    elastic, damping, energy = law_at(dry_law(factor, largest, 1e-6), approach)
    assert_allclose(elastic, 0.3 * largest, rtol=1e-12)
    assert_allclose(damping, 1.5e-6 * factor * np.sqrt(approach), rtol=1e-3)
    assert_allclose(energy, 0.4 * factor * approach**2.5, rtol=1e-12)
    spring = linear_law(factor, 700.0, largest, 0.0)
    stiffness = 1.5 * factor ** (2.0 / 3.0) * 700.0 ** (1.0 / 3.0)
    assert_allclose(law_at(spring, 1e-6), (1e-6 * stiffness, 0.0, 0.5e-12 * stiffness))
    assert law_at(spring, -1e-9) == (0.0, 0.0, 0.0)
    films = SolvedFilms(
        loads=np.array([300.0, 1500.0]),
        stiffness_ratio=np.array([0.95, 1.02]),
        damping=np.array([100.0, 80.0]),
        damping_uncertainty=np.zeros(2),
        frequency=1e3,
    )
    law = film_law(factor, films)
    for load, ratio, wanted in ((1500.0, 1.02, 80.0), (300.0, 0.95, 100.0), (30.0, 0.95, 10.0)):
        grid = np.geomspace(1e-7, 1e-5, 4001)
        forces = np.array([law_at(law, d)[0] for d in grid])
        at = float(np.interp(load, forces, grid))
        slope = (law_at(law, 1.01 * at)[0] - law_at(law, 0.99 * at)[0]) / (0.02 * at)
        assert_allclose(slope, ratio * 1.5 * factor ** (2.0 / 3.0) * load ** (1.0 / 3.0), rtol=0.02)
        assert_allclose(law_at(law, at)[1], wanted, rtol=0.02)
    steps = np.linspace(1e-8, 5e-6, 20001)
    forces = np.array([law_at(law, d)[0] for d in steps])
    work = float(np.sum(0.5 * (forces[1:] + forces[:-1]) * np.diff(steps)))
    assert_allclose(law_at(law, 5e-6)[2] - law_at(law, 1e-8)[2], work, rtol=1e-4)
