"""Cases with one equilibrium have it solved once, and each its own copy of it."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import oilfilm
from oilfilm.bearing.geometry import SINGLE
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.runs import equilibrium
from oilfilm.cases.runs.equilibrium import Equilibria, case_equilibrium


def as_run(name):
    """A shipped case from its document as run, as the changed ones are."""
    return case_of_document(oilfilm.load_case(name).document)


def changed(case, table, **values):
    """The case with other values of one table."""
    return case_of_document(case.document | {table: case.document[table] | values})


def assert_same(one, other):
    """All fields are equal to the last bit."""
    for field in dataclasses.fields(one):
        first, second = getattr(one, field.name), getattr(other, field.name)
        if isinstance(first, np.ndarray):
            assert first.tobytes() == second.tobytes(), field.name
        else:
            assert first == second, field.name


@pytest.fixture
def solved(monkeypatch):
    """Equilibria that were solved, by their operation."""
    found = []

    def counted(bearing, operation, model, rows):
        found.append(operation)
        return solve_quasistatic(bearing, operation, model, rows=rows)

    monkeypatch.setattr(equilibrium, "solve_quasistatic", counted)
    return found


def test_oil_and_temperature_leave_one_equilibrium(solved):
    case, equilibria = as_run("6206_combined_1000N"), Equilibria()
    others = [
        case,
        changed(case, "lubricant", kinematic_viscosity_mm2_s=77.0),
        changed(case, "operation", temperature_C=55.0),
        changed(case, "ehl", points=65),
    ]
    for other in others:
        own = solve_quasistatic(other.bearing, other.operation, other.model, rows=other.rows or SINGLE)
        assert_same(case_equilibrium(other, equilibria), own)
    assert len(solved) == 1


def test_loads_speeds_and_sizes_have_their_own(solved):
    case, equilibria = as_run("6206_combined_1000N"), Equilibria()
    others = [
        case,
        changed(case, "operation", inner_speed_rpm=1234.0),
        changed(case, "operation", radial_load_N=777.0),
        changed(case, "bearing", inner_groove_radius_mm=5.0),
        changed(case, "model", ball_kinematics="inner race control"),
    ]
    first = [case_equilibrium(other, equilibria) for other in others]
    assert len(solved) == len(others)
    assert len({solution.inner_load.tobytes() for solution in first}) >= 4


def test_temperature_counts_where_it_changes_the_clearance(solved):
    case = as_run("7008_back_to_back")
    warm = changed(case, "operation", temperature_C=90.0)
    equilibria = Equilibria()
    cold, hot = case_equilibrium(case, equilibria), case_equilibrium(warm, equilibria)
    assert len(solved) == (1 if case.bearing == warm.bearing else 2)
    assert hot.operation.temperature - cold.operation.temperature == pytest.approx(
        warm.operation.temperature - case.operation.temperature
    )


def test_nobody_changes_what_others_get(solved):
    case, equilibria = as_run("6206_combined_1000N"), Equilibria()
    first = case_equilibrium(case, equilibria)
    untouched = dataclasses.replace(first, inner_load=first.inner_load.copy())
    first.inner_load[:] = -1.0
    assert_same(case_equilibrium(case, equilibria), untouched)
    assert len(solved) == 1
