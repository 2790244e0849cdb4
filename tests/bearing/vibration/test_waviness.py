"""Waviness of rings and balls: closed forms for linear springs, rules by which orders show, works that balance."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.dynamics.support import Support
from oilfilm.bearing.operation import Operation
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.bearing.vibration.assembly import assembled
from oilfilm.bearing.vibration.form import Defect, DefectKind, FormBody, SurfaceForm, Wave
from oilfilm.bearing.vibration.inputs import ContactLaw, VibrationModel, VibrationOptions, WaveFilter
from oilfilm.bearing.vibration.lines import expected_lines, passing
from oilfilm.bearing.vibration.simulation import computed, vibration_run
from oilfilm.cases.format.case import load_case
from oilfilm.postprocess.vibration.results import amplitude_at

SLOW = pytest.mark.slow
AMPLITUDE = 1e-8  # [m]: small against the approach, 2 um
INTERFERENCE = -8e-6  # of clearance [m]: all balls pressed alike without any load


@cache
def case():
    return load_case("6208_full_ceramic")


def bearing(balls=9):
    """The 6208 with another number of balls, pressed between its rings."""
    return replace(case().bearing, balls=balls, diametral_clearance=INTERFERENCE)


def run(waves, geometry, axial=0.0, rpm=6000.0, **options):
    """A vibration with linear springs, and its equilibrium."""
    state = solve_quasistatic(geometry, Operation(inner_speed=rpm * np.pi / 30.0, force=(axial, 0.0, 0.0)))
    assert state.converged
    given = {"duration": 0.04, "settling": 0.015, "sample_rate": 20480.0, "law": ContactLaw.LINEAR}
    settings = VibrationOptions(**(given | {"wave_filter": WaveFilter.NONE} | options))
    model = VibrationModel(form=SurfaceForm(waves=waves), options=settings)
    equations = assembled(state, contact_conditions(state, case().lubricant), model)
    return state, computed(vibration_run(state, model, equations))


def sizes(found):
    """Root mean square of the inner ring's motion along x, y, z, times sqrt 2 [m]."""
    return np.sqrt(2.0) * found.motion[:, :3].std(axis=0)


def amplitudes(found, frequency, first=0):
    """Amplitudes at a frequency [Hz] along x, y, z of a ring [m]."""
    time = np.linspace(0.0, found.model.options.duration, len(found.motion), endpoint=False)
    return np.array([amplitude_at(found.motion[:, k], time, frequency) for k in range(first, first + 3)])


def closed_form(found, frequency, mass):
    """Amplitude of a ring on Z springs in a plane, driven by a wave of a suited order [m]: A/(1 - w^2 m/(Z k/2))."""
    stiffness = 0.5 * found.solution.bearing.balls / sum(1.0 / k for k in found.assembled.laws[:, 0])
    return AMPLITUDE / (1.0 - (2.0 * np.pi * frequency) ** 2 * mass / stiffness)


@pytest.mark.parametrize("order", [1, 10, pytest.param(8, marks=SLOW), pytest.param(28, marks=SLOW)])
def test_one_wave_on_the_inner_ring_shows_with_the_amplitude_of_springs(order):
    """Of a 6208, to 1 %: half of the 2 % that the ball's own mass and the finite record may take."""
    state, found = run({FormBody.INNER: (Wave(order=order, amplitude=AMPLITUDE),)}, bearing())
    (line,) = expected_lines(state, found.assembled, found.model.form)
    speeds = found.assembled.speeds / (2.0 * np.pi)
    k = round(order / 9)
    assert_allclose(line.frequency, abs(order * speeds[0] - 9 * k * speeds[2]), rtol=1e-12)
    wanted = closed_form(found, line.frequency, found.simulation.data.constants.ring_mass)
    assert_allclose(amplitudes(found, line.frequency)[1:], wanted, rtol=0.01)
    spectrum = abs(np.fft.rfft(found.motion[:, 1] - found.motion[:, 1].mean()))
    highest = np.fft.rfftfreq(len(found.motion), 0.04 / len(found.motion))[spectrum.argmax()]
    assert abs(highest - line.frequency) <= 25.0  # a line of a record of 0.04 s
    assert found.energy_balance_error < 1e-6


@pytest.mark.parametrize("seed", [731, pytest.param(9017, marks=SLOW), pytest.param(55021, marks=SLOW)])
def test_orders_move_what_the_rule_says_and_nothing_else(seed):
    """Random numbers of balls and orders: kZ the ring along its axis, kZ +- 1 across, others nothing."""
    random = np.random.default_rng(seed)
    balls = int(random.integers(5, 12))
    geometry = replace(bearing(balls), diametral_clearance=20e-6)
    k = int(random.integers(1, 4))
    for offset in (0, 1, -1, 2, -2, int(random.integers(3, balls - 2)) if balls > 5 else 2):
        order = k * balls + offset
        place = (FormBody.INNER, FormBody.OUTER)[int(random.integers(0, 2))]
        waves = {place: (Wave(order=order, amplitude=AMPLITUDE, phase=random.uniform(0.0, 6.0)),)}
        _, found = run(waves, geometry, axial=500.0, duration=0.015, settling=0.01)
        near = min(order % balls, balls - order % balls)
        x, y, z = sizes(found)
        moved = {"x": x > 1e-3 * AMPLITUDE, "y": y > 1e-3 * AMPLITUDE, "z": z > 1e-3 * AMPLITUDE}
        assert moved == {"x": near == 0, "y": near == 1, "z": near == 1}, (balls, order, place, (x, y, z))
        if near > 1:
            assert max(y, z) < 1e-5 * AMPLITUDE  # what the start leaves in 10 ms


@pytest.mark.parametrize(("order", "moves"), [(2, True), (3, False), (4, True), (5, False)])
def test_a_ball_moves_the_ring_by_its_even_orders_alone(order, moves):
    waves = {FormBody.BALL: (Wave(order=order, amplitude=AMPLITUDE, ball=1),)}
    _, found = run(waves, bearing())
    assert (sizes(found)[1] > 0.05 * AMPLITUDE) == moves
    assert moves or sizes(found)[1] < 2e-3 * AMPLITUDE  # what the difference of the two races leaves


def test_nothing_moves_without_waves():
    _, found = run({}, bearing())
    assert found.motion[:, 1:3].std() < 1e-15


def test_a_wave_that_stands_still_under_the_cage_has_no_line():
    """An outer ring at rest that lies off its centre, order 1, moves nothing; order 10 has one line, 9 x cage."""
    state = solve_quasistatic(bearing(), Operation(inner_speed=628.3))
    conditions = contact_conditions(state, case().lubricant)
    found = {}
    for order in (1, 10):
        form = SurfaceForm(waves={FormBody.OUTER: (Wave(order=order, amplitude=AMPLITUDE),)})
        equations = assembled(state, conditions, VibrationModel(form=form, options=VibrationOptions(duration=0.1)))
        found[order] = expected_lines(state, equations, form)
    assert found[1] == () and len(found[10]) == 1
    assert found[10][0].frequency == pytest.approx(9.0 * abs(equations.speeds[2]) / (2.0 * np.pi))


def test_an_outer_ring_that_floats_moves_as_an_inner_one():
    """The inner ring held, the outer one loaded against it: the same springs, another mass."""
    state = solve_quasistatic(bearing(), Operation(inner_speed=628.3))
    waves = {FormBody.INNER: (Wave(order=10, amplitude=AMPLITUDE),)}
    options = VibrationOptions(
        duration=0.04, settling=0.015, sample_rate=20480.0, law=ContactLaw.LINEAR, wave_filter=WaveFilter.NONE
    )
    support = Support(inner_ring_fixed=True, seat_stiffness=0.0, outer_mass=0.4)
    model = VibrationModel(form=SurfaceForm(waves=waves), options=options, support=support)
    found = computed(vibration_run(state, model, assembled(state, contact_conditions(state, case().lubricant), model)))
    (line,) = expected_lines(state, found.assembled, model.form)
    outer = amplitudes(found, line.frequency, first=5)[1:]
    assert_allclose(outer, closed_form(found, line.frequency, 0.4), rtol=0.01)
    assert not found.motion[:, :5].std(axis=0).any()


def test_hertz_and_centrifugal_forces_hold_the_works_together():
    """Radial load, clearance, dry loss: what is put in is stored or lost, to 1e-3."""
    geometry = replace(case().bearing, diametral_clearance=13e-6)
    state = solve_quasistatic(geometry, Operation(inner_speed=500.0, force=(100.0, 900.0, 0.0)))
    options = VibrationOptions(
        duration=0.03,
        settling=0.015,
        sample_rate=20480.0,
        law=ContactLaw.DRY,
        loss_time=1e-6,
        wave_filter=WaveFilter.DRY,
    )
    form = SurfaceForm(waves={FormBody.OUTER: (Wave(order=9, amplitude=2e-7),)}, ball_diameters=(1e-7,) + (0.0,) * 8)
    model = VibrationModel(form=form, options=options)
    found = computed(vibration_run(state, model, assembled(state, contact_conditions(state, case().lubricant), model)))
    assert found.energy_balance_error < 1e-3
    assert_allclose(found.motion[:, :3].mean(axis=0), state.displacement, atol=3e-7)
    balls = geometry.balls
    assert_allclose(found.loads[:, :balls].max(), state.inner_load.max(), rtol=0.1)
    assert_allclose(passing(state, found.assembled).ball_pass_outer, balls * state.cage_speed / (2.0 * np.pi))


@pytest.mark.parametrize("rpm", [0.5, 40000.0])
def test_both_ends_of_the_speed(rpm):
    _, found = run({FormBody.INNER: (Wave(order=8, amplitude=AMPLITUDE),)}, bearing(), rpm=rpm, duration=0.02)
    assert np.isfinite(found.motion).all()
    assert found.energy_balance_error < 1e-3


def harmonics_left(found, frequency):
    """What is left of the motion along y without the multiples of a frequency [Hz], over all of it [-]."""
    part = found.motion[:, 1] - found.motion[:, 1].mean()
    values = abs(np.fft.rfft(part * np.hanning(part.size))) ** 2
    lines = np.fft.rfftfreq(part.size, found.model.options.duration / part.size)
    beside = abs(lines - frequency * np.round(lines / frequency)) * found.model.options.duration
    return np.sqrt(values[beside > 2.5].sum() / values.sum())


def forced(form, force):
    """Vibration of a 6208 with Hertz' law and a loss, at 30000 r/min."""
    state = solve_quasistatic(replace(bearing(), diametral_clearance=5e-6), Operation(inner_speed=3141.6, force=force))
    options = VibrationOptions(
        duration=0.02,
        settling=0.03,
        sample_rate=51200.0,
        law=ContactLaw.DRY,
        loss_time=1e-5,
        wave_filter=WaveFilter.NONE,
    )
    model = VibrationModel(form=form, options=options)
    equations = assembled(state, contact_conditions(state, case().lubricant), model)
    return passing(state, equations), computed(vibration_run(state, model, equations))


def test_passing_balls_show_at_their_multiples_alone():
    """Varying compliance: nothing but k Z n_c, to what the start leaves of balls outside the load zone."""
    passes, found = forced(SurfaceForm(), (200.0, 1500.0, 0.0))
    assert found.motion[:, 1].std() > 1e-9
    assert harmonics_left(found, passes.ball_pass_outer) < 0.05


def test_balls_of_different_size_show_with_the_cage():
    passes, found = forced(SurfaceForm(ball_diameters=(5e-7, *[0.0] * 8)), (1500.0, 0.0, 0.0))
    time = np.linspace(0.0, 0.02, len(found.motion), endpoint=False)
    one = amplitude_at(found.motion[:, 1], time, passes.cage)
    assert one > 1e-8
    assert amplitude_at(found.motion[:, 1], time, 4.0 * passes.cage) < 0.05 * one


@pytest.mark.parametrize("place", list(FormBody))
def test_lines_of_a_defect_are_those_of_its_body(place):
    """Passing balls of a ring, twice the spin of a ball, which meets both races in a turn."""
    geometry = bearing()
    state = solve_quasistatic(geometry, Operation(inner_speed=600.0, outer_speed=-90.0))
    form = SurfaceForm(defects=(Defect(place=place, kind=DefectKind.SPALL, width=1e-3, depth=1e-5, azimuth=0.3),))
    model = VibrationModel(form=form, options=VibrationOptions(duration=0.04, settling=0.0, sample_rate=20480.0))
    equations = assembled(state, contact_conditions(state, case().lubricant), model)
    inner, outer, cage, spin = np.asarray(equations.speeds) / (2.0 * np.pi)
    wanted = {FormBody.INNER: 9 * (inner - cage), FormBody.OUTER: 9 * (cage - outer), FormBody.BALL: 2.0 * abs(spin)}
    lines = [line.frequency for line in expected_lines(state, equations, form) if "defect" in line.source]
    assert_allclose(lines[:3], wanted[place] * np.array([1.0, 2.0, 3.0]), rtol=1e-12)
