"""Paths over hollows, what a contact leaves of waves, laws of contacts: closed forms."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.dynamics._race_kernels import elastic_energy, elastic_force, height_at, lasting
from oilfilm.bearing.quasistatic.solution import Frequencies
from oilfilm.bearing.vibration.assembly import SolvedFilms, dry_law, dry_transmission, film_law, filtered, linear_law
from oilfilm.bearing.vibration.form import (
    POINTS,
    Defect,
    DefectKind,
    FormBody,
    SurfaceForm,
    Wave,
    graded,
    heights,
    hollow,
    rolled,
    waves_of,
)
from oilfilm.bearing.vibration.lines import is_resolved, name_of, sums_and_harmonics

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
    assert_allclose(slope, -9e-6 * np.sin(9 * angle + 0.3), rtol=1e-3)


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


def forces(law, approach):
    """Elastic force [N], damping [N s/m] and elastic energy [J] of a law at an approach [m]."""
    row = np.array(law)
    elastic = elastic_force(row, approach)
    return elastic, (lasting(row, elastic, approach, 1e-3) - elastic) / 1e-3, elastic_energy(row, approach)


def test_laws_of_contacts():
    """Hertz and springs as they are; a film's stiffness and damping between its loads, energy their integral."""
    factor = 5e10
    approach = (450.0 / factor) ** (2.0 / 3.0)
    elastic, damping, energy = forces(dry_law(factor, 1e-6), approach)
    assert_allclose(elastic, 450.0, rtol=1e-12)
    assert_allclose(damping, 1.5e-6 * factor * np.sqrt(approach), rtol=1e-9)
    assert_allclose(energy, 0.4 * factor * approach**2.5, rtol=1e-12)
    spring = linear_law(factor, 700.0, 0.0)
    stiffness = 1.5 * factor ** (2.0 / 3.0) * 700.0 ** (1.0 / 3.0)
    assert_allclose(forces(spring, 1e-6), (1e-6 * stiffness, 0.0, 0.5e-12 * stiffness), atol=1e-12)
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
        at = float(np.interp(load, [forces(law, d)[0] for d in grid], grid))
        slope = (forces(law, 1.1 * at)[0] - forces(law, 0.9 * at)[0]) / (0.2 * at)
        assert_allclose(slope, ratio * 1.5 * factor ** (2.0 / 3.0) * load ** (1.0 / 3.0), rtol=0.02)
        assert_allclose(forces(law, at)[1], wanted, rtol=0.02)
    steps = np.linspace(1e-8, 5e-6, 20001)
    values = np.array([forces(law, d)[0] for d in steps])
    work = float(np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(steps)))
    assert_allclose(forces(law, 5e-6)[2] - forces(law, 1e-8)[2], work, rtol=1e-6)


def test_a_grade_gives_what_is_not_given():
    """ISO 3290-1, G10: 0.25 um from valley to crest on each body, diameters within 0.5 um; no two balls are alike."""
    wave = Wave(order=7, amplitude=1e-7)
    form = graded(SurfaceForm(waves={FormBody.INNER: (wave,)}), "G10", 9, 73_019)
    assert FormBody.INNER not in form.profiles  # as given
    assert_allclose(np.ptp(form.profiles[FormBody.OUTER]), 0.25e-6)
    balls = form.profiles[FormBody.BALL]
    assert_allclose(np.ptp(balls, axis=1), 0.25e-6)
    assert len({round(float(row[0]), 15) for row in balls}) == 9
    assert np.ptp(form.ball_diameters) <= 0.5e-6
    assert_allclose(heights(form, FormBody.BALL, 4)[::16], balls[3], atol=1e-12)
    again = graded(SurfaceForm(), "G10", 9, 73_019)
    assert_allclose(again.profiles[FormBody.BALL], balls)  # the seed draws the same
    assert [wave.order for wave in waves_of(form, FormBody.BALL)][:3] == [2, 3, 4]


def test_a_defect_of_a_ball_shows_twice_a_turn():
    """It meets both races: multiples of twice the spin with the cage beside; rings by the passing balls."""
    passes = Frequencies(cage=9.59, ball_pass_outer=76.7, ball_pass_inner=123.3, ball_spin=49.7)
    named = {one.name: one.frequency for one in sums_and_harmonics(passes, 25.0)}
    assert named["2*BSF"] == pytest.approx(99.4) and named["4*BSF"] == pytest.approx(198.8)
    assert named["2*BSF-1*FTF"] == pytest.approx(99.4 - 9.59) and named["1*BPFI+1*f_r"] == pytest.approx(148.3)
    assert named["1*BPFO"] == pytest.approx(76.7)


def test_names_of_peaks():
    """A 6310 at 1500 r/min: 2 f_r at 50 Hz and 2 BSF/2 at 49.7 are not told apart in half a second; a peak between
    the sidebands of BPFI has its name, one beside all is none of the bearing's.
    """
    passes = Frequencies(cage=9.59, ball_pass_outer=76.7, ball_pass_inner=123.3, ball_spin=49.7)
    named = sums_and_harmonics(passes, 25.0)
    assert name_of(123.3, named, 2.0) == "1*BPFI"
    assert name_of(98.3, named, 0.5) == "1*BPFI-1*f_r"
    assert name_of(2 * 76.7, named, 2.0) == "2*BPFO"
    assert name_of(2 * 49.7 + 9.59, named, 1.0) == "2*BSF+1*FTF"
    assert name_of(5.0, named, 1.0) is None
    assert name_of(230.5, named, 1.0) == "3*BPFO"
    assert name_of(2.0 * 99.4, named, 0.5) == "4*BSF or 1*BPFI+3*f_r"
    assert name_of(99.0, named, 1.0) == "2*BSF or 1*BPFI-1*f_r"
    assert name_of(100.0, named, 1.0) == "2*BSF"  # 4 f_r takes more than twice as many multiples
    assert name_of(99.0, named, 1.0, {"ball spin twice": 0.1, "shaft": 0.1, "ball pass inner": 9.0}) == "1*BPFI-1*f_r"
    assert name_of(20.0 * 76.7, named, 0.5) == "20*BPFO"
    assert all(line.frequency != pytest.approx(8.0 * 9.59) for line in named if line.body == "cage")
    ball = next(line for line in named if line.body == "ball spin twice" and line.terms == 1)
    assert not is_resolved(ball, named, 4.0)  # 4 f_r at 100 Hz
    assert is_resolved(ball, named, 0.5)
