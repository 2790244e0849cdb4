"""Examples in the docstrings of the front door: each runs and prints what it says."""

from __future__ import annotations

import doctest
import sys

import pytest

from oilfilm.bearing import (
    Bearing,
    Material,
    Operation,
    bearing_frequencies,
    bearing_life,
    library_lubricant,
    list_bearings,
    list_greases,
    list_lubricants,
    list_materials,
    load_bearing,
    load_catalogue_entry,
    load_material,
    reduced_modulus,
    solve_quasistatic,
)
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.library.designation import read_designation

OBJECTS = [
    *(Bearing, Material, Operation, bearing_frequencies, bearing_life, library_lubricant),
    *(list_bearings, list_greases, list_lubricants, list_materials, load_bearing, load_catalogue_entry),
    *(load_material, read_designation, reduced_modulus, simulation, solve_quasistatic),
]


@pytest.mark.parametrize("thing", OBJECTS, ids=lambda thing: thing.__name__)
def test_the_example_prints_what_it_says(thing):
    names = dict(vars(sys.modules[thing.__module__]))
    (example,) = doctest.DocTestFinder(recurse=False).find(thing, globs=names)
    assert example.examples
    runner = doctest.DocTestRunner()
    runner.run(example)
    assert runner.summarize(verbose=False).failed == 0
