"""Every shipped case: complete, valid, and with the numbers it had when they were last looked at.

Cases with films are run on a coarse grid, and on the grid that they ask for among the slow tests.

The numbers are ours, not a reference: a change of them is to be understood, then written down by
`python tests/regression/test_shipped_cases.py`. Loads and pressures follow from closed equations and are kept to 1e-6,
films, and the loads of balls between two films, to 0.5 %, which covers a change of grid or of extrapolation, not one of
physics.
"""

from __future__ import annotations

import json
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from oilfilm.cases import Case, load_case, run_case, run_contact
from oilfilm.cases.format.shaft_case import load_shaft
from oilfilm.cases.format.shipped import LIBRARY, shipped_cases, shipped_sweeps

SHAFTS = tuple(stem for stem, path in shipped_cases().items() if path.parent.name == "shaft")
STEMS = tuple(stem for stem in shipped_cases() if stem not in SHAFTS)  # bearings and contacts
EXPECTED = Path(__file__).with_name("expected.json")
COARSE = Path(__file__).with_name("expected_coarse.json")
COARSE_POINTS = 65
# elastic rings by finite elements, films of vibrations: among the slow tests
SLOW = ("61808_split_housing", "6208_finite_bodies", "6208_steel_seats", "6205_outer_defect", "6208_run_up")
SLOW += ("6208_waviness", "61808_loose_rings")
MAIN = ("6208_full_ceramic", "moes_20_10")  # on their own grid, too
CLOSED, FILM = 1e-6, 5e-3
LIGHT = 0.02  # of the heaviest ball's load
NOISE = 1e-6  # of values that are zero, in the unit of their key


def numbers(stem, points=None):
    """The main results of a case, by key, with its own points along x or others."""
    from oilfilm.postprocess import summary

    case = load_case(stem)
    if points is not None:
        case = replace(case, solver=replace(case.solver, points=points))
    found = summary(run_case(case) if isinstance(case, Case) else run_contact(case))
    if not isinstance(case, Case):
        films = ("film_central_dimensionless", "film_minimum_dimensionless", "film_central_um", "film_minimum_um")
        return {key: found[key] for key in ("converged", "hertz_pressure_GPa", *films)}
    kept = {"converged": found["converged"], "cage_speed_rpm": found["cage_speed_rpm"]}
    for direction, value in zip("xyz", found["ring"]["displacement_um"], strict=True):
        kept[f"displacement_{direction}_um"] = value
    for block in ("life", "duty_cycle", "clearance"):
        kept |= {f"{block} {key}": value for key, value in found[block].items() if value is not None}
    for ring in ("inner_ring", "outer_ring"):
        block = found["strength"][ring]
        if block["failure_probability"] is not None:
            kept |= {f"strength {ring} {key}": block[key] for key in ("hoop_tension_MPa", "groove_tension_MPa")}
    for contact in found["contacts"]:
        name = f"ball {contact['ball']} {contact['race']}"
        for key in ("load_N", "contact_angle_deg", "hertz_pressure_GPa", "film_central_um", "film_minimum_um"):
            # films of the atlas have tests of their own; those with maps are what a run prints
            of_atlas = "film" in key and contact["film_origin"] == "atlas" and contact["points"] is None
            kept[f"{name} {key}"] = None if of_atlas else contact[key]
    return kept


def test_stems_are_unique():
    studies = list(LIBRARY.glob("optimisations/*.toml"))
    assert len(list(LIBRARY.rglob("*.toml"))) == len(shipped_cases()) + len(shipped_sweeps()) + len(studies)


@pytest.mark.parametrize("stem", [*STEMS, *SHAFTS])
def test_a_case_says_what_it_is_and_where_its_numbers_come_from(stem):
    document = tomllib.loads(shipped_cases()[stem].read_text(encoding="utf-8"))
    assert document["title"]
    assert document["source"]
    assert document["assumed"]
    load_shaft(stem) if stem in SHAFTS else load_case(stem)


def is_slow(stem):
    """Whether a case takes more than a few seconds, or runs on a coarse grid already."""
    return stem in SLOW or (stem in json.loads(COARSE.read_text(encoding="utf-8")) and stem not in MAIN)


@pytest.mark.parametrize(
    "stem", [pytest.param(stem, marks=pytest.mark.slow) if is_slow(stem) else stem for stem in STEMS]
)
def test_numbers(stem):
    compare(numbers(stem), json.loads(EXPECTED.read_text(encoding="utf-8"))[stem])


@pytest.mark.parametrize(
    "stem",
    [
        pytest.param(stem, marks=pytest.mark.slow) if stem in SLOW else stem
        for stem in json.loads(COARSE.read_text(encoding="utf-8"))
    ],
)
def test_numbers_on_a_coarse_grid(stem):
    compare(numbers(stem, COARSE_POINTS), json.loads(COARSE.read_text(encoding="utf-8"))[stem])


def test_every_case_with_films_has_numbers_on_a_coarse_grid():
    assert films() == list(json.loads(COARSE.read_text(encoding="utf-8")))


def films():
    """Cases that have a film among their expected numbers."""
    expected = json.loads(EXPECTED.read_text(encoding="utf-8"))
    return [stem for stem in STEMS if any("film" in key and value is not None for key, value in expected[stem].items())]


def compare(found, expected):
    assert found.keys() == expected.keys()
    offenders = {}
    loads = {key: value for key, value in expected.items() if key.endswith("inner load_N")}
    heaviest = max(loads.values(), default=0.0)
    # balls that ride between two films, whose loads follow from the films
    light = [key.split(" inner")[0] + " " for key, value in loads.items() if value < LIGHT * heaviest]
    for key, value in expected.items():
        tolerance = FILM if "film" in key or key.startswith(tuple(light)) else CLOSED
        if found[key] != (value if value is None else pytest.approx(value, rel=tolerance, abs=NOISE)):
            offenders[key] = found[key], value
    assert offenders == {}


def write(path, numbers_of):
    """Write the expected numbers, by case."""
    path.write_text(json.dumps(numbers_of, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write(EXPECTED, {stem: numbers(stem) for stem in STEMS})
    write(COARSE, {stem: numbers(stem, COARSE_POINTS) for stem in films()})
