"""Examples in the docstrings of the front door: each runs and prints what it says."""

from __future__ import annotations

import doctest
import sys

import pytest

from oilfilm.ehl.atlas.films import atlas_films
from oilfilm.ehl.traction.shear import integrate_traction
from oilfilm.ehl.traction_table.build import build_table
from oilfilm.ehl.transient.run import solve_transient


@pytest.mark.parametrize("function", [atlas_films, integrate_traction, build_table, solve_transient])
def test_the_example_prints_what_it_says(function):
    names = dict(vars(sys.modules[function.__module__]))
    (example,) = doctest.DocTestFinder(recurse=False).find(function, globs=names)
    assert example.examples
    runner = doctest.DocTestRunner()
    runner.run(example)
    assert runner.summarize(verbose=False).failed == 0
