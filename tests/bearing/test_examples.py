"""Examples in docstrings: each runs and prints what it says; those of the front door in tests/test_front_door.py."""

from __future__ import annotations

import doctest
import sys

import pytest

from oilfilm.bearing import list_greases, load_catalogue_entry, reduced_modulus
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.library.designation import read_designation

OBJECTS = [list_greases, load_catalogue_entry, read_designation, reduced_modulus, simulation]


@pytest.mark.parametrize("thing", OBJECTS, ids=lambda thing: thing.__name__)
def test_the_example_prints_what_it_says(thing):
    names = dict(vars(sys.modules[thing.__module__]))
    (example,) = doctest.DocTestFinder(recurse=False).find(thing, globs=names)
    assert example.examples
    runner = doctest.DocTestRunner()
    runner.run(example)
    assert runner.summarize(verbose=False).failed == 0
