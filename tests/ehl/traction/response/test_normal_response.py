"""Stiffness and damping of a contact: against full solves, closed forms, meshes, boxes and time."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest
from numpy.testing import assert_allclose
from verification.contacts import DEGREE, from_groups
from verification.contacts import moes as groups

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, ViscosityLaw
from oilfilm.ehl.multigrid.cycle import cycle, start_level
from oilfilm.ehl.multigrid.newton import LinearSolverError, certify
from oilfilm.ehl.solver import solve_attempts
from oilfilm.ehl.traction import linear_response, normal_response
from oilfilm.ehl.traction.linear_response import _Right, linear_contact

OPEN = None
BOXES = {"M 20": (-6.0, 1.6, 3.5), "M 200": (-4.5, 1.5, 3.0), "M 500": (-4.0, 1.5, 1.22)}
ROELANDS = Lubricant(viscosity=0.04, pressure_viscosity=22e-9, roelands_z=0.68)
# stiffness and damping on the way to zero mesh, of an earlier linearisation of the same equations
# without the multigrid's code: 129 and 257 points
MEASURED = {
    "M 20": (groups(20.0, 10.0, oil=ROELANDS), (2.9421, 2.9461), (0.42315, 0.41774)),
    "M 200": (groups(200.0, 10.0, oil=ROELANDS), (3.0942, 3.0996), (0.10105, 0.09467)),
    "M 500": (groups(500.0, 15.0, 0.1, oil=ROELANDS), (9.1484, 9.1522), (0.52873, 0.52058)),
}


def levels(contact, points, domain=OPEN):
    solution, state = solve_attempts(contact, SolverOptions(points=points, domain=domain))
    assert solution.converged
    return state


@pytest.mark.parametrize("name", list(MEASURED))
def test_one_mesh_agrees_with_a_separate_linearisation(name):
    """Closed boxes, 129 points: stiffness and damping to the digits of the other code."""
    contact, stiffness, damping = MEASURED[name]
    slow = linear_contact(levels(contact, 129, BOXES[name])).slow()
    assert_allclose(slow.stiffness, stiffness[0], rtol=3e-5)
    assert_allclose(slow.damping, damping[0], rtol=3e-4)
    assert slow.damping_outside == 0.0


@pytest.mark.parametrize(
    "contact",
    [groups(200.0, 10.0), groups(100.0, 10.0, 0.1), groups(100.0, 5.0, 0.3, 40.0 * DEGREE)],
    ids=["circle", "wide", "oblique"],
)
def test_stiffness_is_the_slope_of_full_solves(contact):
    """Load over approach between two Newton solutions 0.2 % apart in load on the same grid, to 1e-4."""
    state = levels(contact, 65)
    answer = linear_contact(state).slow()
    load, approach, pressure = state.contact.load, state.approach, state.levels[-1].P.copy()
    found = []
    for share in (-1e-3, 1e-3):
        near = replace(state, contact=replace(state.contact, load=(1.0 + share) * load), approach=approach)
        start_level(near, len(near.levels) - 1, pressure)
        assert certify(near).certified
        found.append(near.approach)
    assert_allclose(-2e-3 * load / (found[1] - found[0]), answer.stiffness, rtol=1e-4)


def test_damping_is_the_slope_of_full_solves():
    """Reynolds' equation with the oil squeezed by a slow approach, solved by cycles, to 1 %: a closed box."""
    state = levels(groups(20.0, 10.0), 65, BOXES["M 20"])
    contact = linear_contact(state)
    answer = contact.slow()
    p, h = contact._solved(_Right(load=1.0))
    follow = contact._content(p, h) / h  # of the oil with H0
    start, pressure = state.approach, state.levels[-1].P.copy()
    found = []
    for rate in (-2e-3, 2e-3):
        moving = replace(state, approach=start)
        start_level(moving, len(moving.levels) - 1, pressure)
        moving.levels[-1].f = rate * follow
        for _ in range(40):
            cycle(moving, len(moving.levels) - 1)
        found.append(moving.approach)
    assert_allclose(-answer.stiffness * (found[1] - found[0]) / 4e-3, answer.damping, rtol=0.01)


def test_frequency_tends_to_slow_movement_and_film_waves_take_the_damping():
    """At omega a/u_m of 0.02 both are those of slow movement; damping falls to half at 1, and stays positive."""
    contact = linear_contact(levels(groups(200.0, 10.0, oil=ROELANDS), 65, BOXES["M 200"]))
    slow = contact.slow()
    assert_allclose(contact.at(0.02), (slow.stiffness, slow.damping), rtol=1e-3)
    half = contact.at(1.0)
    assert 0.5 < half[1] / slow.damping < 0.65
    assert half[0] > slow.stiffness


def test_the_closed_form_beyond_the_edge_brackets_a_wide_box():
    """A circle in boxes of twice the size: the squeeze beyond the edge halves their difference at least."""
    near, wide = (linear_contact(levels(groups(20.0, 2.0), points, OPEN)).slow() for points in (65, 129))
    assert near.damping_outside > 0.0
    assert near.damping - near.damping_outside < wide.damping < near.damping * 1.01


STEEL = ContactConditions(
    load=150.0, radius_x=2.9e-3, radius_y=28.5e-3, reduced_modulus=2.26e11, entrainment_speed=7.0,
    lubricant=Lubricant(viscosity=0.02, pressure_viscosity=18e-9),
)  # fmt: skip


def on_two_meshes(conditions):
    """65 with 129 points and 129 with 257, whose values the bars of the first hold."""
    coarse, fine = (normal_response(conditions, SolverOptions(points=points)) for points in (129, 257))
    assert coarse.converged and fine.converged
    for name in ("stiffness", "damping"):
        rough, better = getattr(coarse, name), getattr(fine, name)
        assert abs(rough.value - better.value) <= rough.uncertainty
    return coarse, fine


def test_error_bars_hold_the_finer_mesh():
    """And shrink with the mesh; stiffness to half a per cent."""
    coarse, fine = on_two_meshes(STEEL)
    for name in ("stiffness", "damping"):
        assert getattr(fine, name).uncertainty < getattr(coarse, name).uncertainty
    assert fine.stiffness.uncertainty < 5e-3 * fine.stiffness.value


def test_frequencies_in_hertz_have_a_limit():
    """Slow ones are the response at rest; one whose film wave no mesh carries is refused, with the limit."""
    slow = normal_response(STEEL, SolverOptions(points=65), (1.0, 2e4))
    assert_allclose(slow.stiffnesses[0].value, slow.stiffness.value, rtol=1e-6)
    assert_allclose(slow.dampings[0].value, slow.damping.value, rtol=1e-4)
    assert slow.dampings[1].value < slow.damping.value
    with pytest.raises(ValueError, match="frequencies: above 0 and at most"):
        normal_response(STEEL, SolverOptions(points=65), (1e7,))
    with pytest.raises(ValueError, match="frequencies: above 0"):
        normal_response(STEEL, SolverOptions(points=65), (0.0,))


def test_what_has_no_response_is_refused():
    """Moes' groups have no lengths."""
    with pytest.raises(ValueError, match="need lengths"):
        normal_response(groups(20.0, 10.0))


def test_rigid_sphere_far_from_rest():
    """A light isoviscous contact, hardly deflected: damping of a half-wetted sphere lies below 6 pi eta R^2/h_0."""
    thin = Lubricant(viscosity=0.02, pressure_viscosity=0.0, viscosity_law=ViscosityLaw.ISOVISCOUS)
    contact = replace(STEEL, load=0.05, radius_y=2.9e-3, lubricant=thin)
    answer = normal_response(contact, SolverOptions(points=129))
    solution, _ = solve_attempts(contact, SolverOptions(points=129))
    whole = 6.0 * pi * 0.02 * contact.radius_x**2 / solution.film_central
    assert answer.converged
    assert 0.3 * whole < answer.damping.value < whole


def test_a_coarse_mesh_that_fails_leaves_a_wide_bar(monkeypatch):
    """The finer one alone has bars as wide as its values; where that fails, too, there is nothing, and why."""
    asked = linear_response._mesh

    def coarse_fails(conditions, points, solved, frequencies):
        if points < 129 or conditions.load > 200.0:
            raise LinearSolverError("no")
        return asked(conditions, points, solved, frequencies)

    monkeypatch.setattr(linear_response, "_mesh", coarse_fails)
    alone = normal_response(STEEL, SolverOptions(points=129))
    assert alone.converged and "single mesh" in alone.message
    assert alone.stiffness.uncertainty >= alone.stiffness.value > 0.0
    none = normal_response(replace(STEEL, load=300.0), SolverOptions(points=129))
    assert not none.converged and none.message == "129 points: no"


@pytest.mark.parametrize(("m", "l", "ratio"), [(5.06, 14.2, 0.261), (445.0, 14.1, 0.0739)])
def test_a_stiffness_whose_meshes_agree_by_chance_keeps_a_bar(m, l, ratio):
    """Two meshes differed by 0.1 and 0.02 %, the next by 0.7 and 0.05 %: thirteen and two bars off."""
    law = ViscosityLaw.BARUS if m < 10.0 else ViscosityLaw.ISOVISCOUS
    oil = Lubricant(viscosity=0.02, pressure_viscosity=2e-8, viscosity_law=law)
    contact = from_groups(groups(m, l, ratio, oil=oil))
    coarse, fine = (normal_response(contact, SolverOptions(points=points)).stiffness for points in (129, 257))
    assert abs(coarse.value - fine.value) < coarse.uncertainty < 0.025 * coarse.value
    assert fine.uncertainty < coarse.uncertainty
