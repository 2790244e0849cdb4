"""Threads that share the lines of a contact."""

from __future__ import annotations

from dataclasses import replace
from threading import get_ident

import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl import Lubricant, MoesConditions, SolverOptions, solve_contact
from oilfilm.ehl.multigrid.threads import SHARED_NODES, Threads


@pytest.mark.parametrize("threads", [1, 2, 3, 7])
@pytest.mark.parametrize("lines", [range(0, 5), range(1, 40, 2), range(0, 2), range(3, 4)])
def test_each_line_is_given_once_and_in_its_colour(threads, lines):
    given = []
    Threads(threads).run(lambda first, stop: given.append(range(first, stop, lines.step)), lines, SHARED_NODES)
    assert sorted(line for part in given for line in part) == list(lines)
    assert len(given) == min(threads, len(lines))


def test_small_grids_stay_with_the_caller():
    seen = []
    Threads(4).run(lambda first, stop: seen.append((first, stop, get_ident())), range(10), SHARED_NODES - 1)
    assert seen == [(0, 10, get_ident())]


def test_an_error_of_any_part_is_raised():
    def kernel(first, stop):
        if first > 0:
            raise ValueError(first)

    with pytest.raises(ValueError, match="5"):
        Threads(2).run(kernel, range(10), SHARED_NODES)


@pytest.mark.parametrize("angle", [0.0, 0.4], ids=["half", "full"])
def test_films_do_not_depend_on_the_threads(angle):
    conditions = MoesConditions(
        load_parameter=40.0,
        lubricant_parameter=8.0,
        radius_ratio=0.4,
        entrainment_angle=angle,
        lubricant=Lubricant(viscosity=0.05, pressure_viscosity=20e-9),
    )
    options = SolverOptions(points=257)
    one, three = (solve_contact(conditions, replace(options, threads=threads)) for threads in (1, 3))
    assert one.P.size >= SHARED_NODES
    assert one.converged
    assert one.record.cycles == three.record.cycles
    assert_allclose(three.P, one.P, rtol=0.0, atol=1e-11)
    assert_allclose(three.H, one.H, rtol=0.0, atol=1e-11)
