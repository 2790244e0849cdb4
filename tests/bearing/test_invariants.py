"""Laws that every result of a bearing obeys: each check notices a fault that is planted."""

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing.films.film import FilmThickness
from oilfilm.bearing.invariants import CheckedState, broken_laws
from oilfilm.cases import load_case, run_case


@pytest.fixture(scope="module")
def state():
    results = run_case(load_case("6208_self_heating"))
    return CheckedState(
        quasistatic=results.quasistatic,
        pour_point=results.pour_point,
        contacts=results.contacts,
        films=results.torque.shear.films,
        frequencies=results.frequencies,
        torque=results.torque,
        heating=results.heating,
    )


def _with_torque(state, **parts):
    shear = state.torque.shear
    models = dict(state.torque.models)
    models["integrated"] = replace(models["integrated"], components={**models["integrated"].components, **parts})
    return replace(state, torque=replace(state.torque, models=models, shear=shear))


def _with_film(state, **changes):
    films = list(state.films)
    place = next(k for k, film in enumerate(films) if film is not None)
    films[place] = replace(films[place], **changes)
    return replace(state, films=tuple(films))


def test_a_right_result_breaks_no_law(state):
    assert broken_laws(state) == ()


def test_a_minimum_above_the_centre_is_told_with_its_ball(state):
    (fault, *_) = broken_laws(_with_film(state, minimum=FilmThickness(1.0e-4)))
    assert "the minimum film, 100 um, exceeds the central one" in fault
    assert fault.startswith("check failed: ball ")


def test_films_of_the_torque_are_those_of_the_results(state):
    film = next(film for film in state.films if film is not None)
    thicker = film.central._replace(value=2.0 * film.central.value)
    assert any("of other films" in fault for fault in broken_laws(_with_film(state, central=thicker)))


def test_forces_are_checked(state):
    solution = replace(state.quasistatic, residual=1.0e-3)
    (residual,) = broken_laws(replace(state, quasistatic=solution))
    assert "balance to 1.0e-03" in residual
    heavier = [replace(one, load=one.load * (1.0 + 1e-6)) if one.ball == 1 else one for one in state.contacts]
    (ring, *_) = broken_laws(replace(state, contacts=heavier))
    assert "of the largest one on the inner ring" in ring
    inner = [replace(one, load=one.load * (1.0 + 1e-6)) if k == 0 else one for k, one in enumerate(state.contacts)]
    assert any("on a ball" in fault for fault in broken_laws(replace(state, contacts=inner)))


def test_oil_below_its_pour_point_is_told(state):
    above = state.quasistatic.operation.temperature + 1.0
    (fault,) = broken_laws(replace(state, pour_point=above))
    assert "below its pour point" in fault and "does not flow" in fault


def test_parts_of_the_torque_resist_and_add_up(state):
    rolling = state.torque.models["integrated"].components["rolling"]
    faults = broken_laws(_with_torque(state, rolling=-rolling))
    assert any("part 'rolling'" in fault for fault in faults)
    assert any("drives the bearing" in fault for fault in faults)


def test_no_node_is_colder_than_its_surroundings(state):
    heat = state.heating.state
    cold = replace(heat, temperatures=np.full_like(heat.temperatures, 100.0))
    (fault,) = broken_laws(replace(state, heating=replace(state.heating, state=cold)))
    assert "colder than all surroundings" in fault


def test_the_cage_turns_between_the_rings(state):
    fast = replace(state.quasistatic, cage_speed=2.0 * state.quasistatic.operation.inner_speed)
    (fault,) = broken_laws(replace(state, quasistatic=fast))
    assert "outside the speeds of the rings" in fault


def test_rings_that_turn_as_one_are_no_fault(state):
    """A cage as fast as both rings, to round-off: "the cage turns outside the speeds of the rings" before."""
    speed = state.quasistatic.operation.inner_speed
    together = replace(state.quasistatic.operation, outer_speed=speed)
    still = replace(state.frequencies, ball_pass_outer=1e-13, ball_pass_inner=0.0)
    solution = replace(state.quasistatic, operation=together, cage_speed=speed * (1.0 - 4e-16))
    found = broken_laws(replace(state, quasistatic=solution, frequencies=still, torque=None))
    assert not any("cage" in fault or "frequencies" in fault for fault in found)
