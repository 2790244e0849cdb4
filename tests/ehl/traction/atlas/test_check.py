"""A solved film beside that of the atlas: silent where they agree, named where they do not."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest
from verification.contacts import OIL, from_groups, moes

from oilfilm import ehl
from oilfilm.ehl.atlas.films import atlas_disagreements
from oilfilm.ehl.oil.lubricant import InletLayer
from oilfilm.postprocess.contact.summary import solution_messages

GROUPS = moes(200.0, 10.0, 0.4, oil=OIL)


@cache
def solved(conditions):
    """On 257 points: on 129 the bar is 5 %, as wide as what the tests add."""
    return ehl.solve_contact(conditions, ehl.SolverOptions(points=257))


def wrong_by(solution, share):
    """The same with a central film that its bar does not hold."""
    film = solution.film_central_dimensionless
    return replace(solution, film_central_dimensionless=replace(film, value=(1.0 + share) * film.value))


@pytest.mark.parametrize("conditions", [GROUPS, from_groups(GROUPS, modulus=226e11)], ids=["groups", "lengths"])
def test_a_film_that_is_off_is_named(conditions):
    solution = solved(conditions)
    assert not list(atlas_disagreements(solution)) and not list(solution_messages("film", solution))
    ((name, own, other),) = atlas_disagreements(wrong_by(solution, 0.05))
    assert name == "central"
    assert own.value * (solution.film_scale or 1.0) == pytest.approx(1.05 * other.value, rel=0.01)
    (message,) = solution_messages("film", wrong_by(solution, -0.05))
    assert message.startswith("film: the central film is -5.") or message.startswith("film: the central film is -4.")


def test_behind_a_layer_the_flooded_film_is_compared():
    layer = InletLayer(thickness=(0.5 * solved(GROUPS).film_central_dimensionless.value,))
    starved = solved(replace(GROUPS, inlet_layer=layer))
    assert not list(atlas_disagreements(starved))
    off = replace(starved, supply=replace(starved.supply, flooded=wrong_by(starved.supply.flooded, 0.1)))
    assert any("the flooded central film is +" in message for message in solution_messages("film", off))


def test_what_the_atlas_does_not_know_is_not_compared():
    """A box of choice, a light contact, a film that the mesh does not resolve."""
    solution = wrong_by(solved(GROUPS), 0.2)
    boxed = replace(solution, options=replace(solution.options, domain=(-4.0, 1.5, 2.0)))
    light = replace(solution, conditions=moes(0.1, 10.0, 0.4, oil=OIL))
    for other in (boxed, light, replace(solution, resolved=False), replace(solution, converged=False)):
        assert not list(atlas_disagreements(other))
