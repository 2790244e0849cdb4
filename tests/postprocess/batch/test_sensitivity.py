"""Sensitivities and bands of batches whose results are known in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm.postprocess.batch.packed_columns import InMemory, columns_of
from oilfilm.postprocess.batch.results import BatchPoint, BatchResults
from oilfilm.postprocess.batch.summary import bands, batch_summary, sensitivities

CASE = {"lubricant.viscosity_mPa_s": 20.0, "operation.axial_load_N": -50.0}
STEP = 0.02


def summary(values, error=1e-6):
    """A contact whose film is a power law of the keys."""
    film = 0.3 * values["lubricant.viscosity_mPa_s"] ** 0.67 * abs(values["operation.axial_load_N"]) ** -0.067
    return {"converged": True, "load_N": 7.0, "film_minimum_um": film, "film_minimum_uncertainty_um": error * film}


def batch(points, error=1e-6):
    made = tuple(
        BatchPoint(
            number=i,
            block=block,
            values=values,
            case={},
            key=str(i),
            resumed=False,
            status="done",
            message="",
            summary=summary(values, error),
        )
        for i, (block, values) in enumerate(points, 1)
    )
    return BatchResults(version="0", title="", case="", sweep="", keys=tuple(CASE), points=made)


def varied():
    points = [("sensitivity", CASE)]
    for key, value in CASE.items():
        points += [("sensitivity", CASE | {key: value * (1.0 + sign * STEP)}) for sign in (-1.0, 1.0)]
    return points


def test_exponents_of_a_power_law():
    rows = sensitivities(batch([("sweep", CASE), *varied()]))
    assert [row["key"] for row in rows] == list(CASE)
    found = [row["results"]["film_minimum_um"]["sensitivity"] for row in rows]
    # central differences of x^a are off by a (a-1) (a-2)/6 step^2, below 1e-4 here
    assert found == pytest.approx([0.67, -0.067], abs=1e-4)
    assert rows[0]["step"] == pytest.approx(STEP)
    assert rows[0]["results"]["load_N"]["sensitivity"] == 0.0


def test_changes_within_the_error_bars_are_marked():
    first, second = sensitivities(batch(varied(), error=0.01))
    assert first["results"]["film_minimum_um"]["resolved"] is True  # 2.7 % against 1.4 %
    assert second["results"]["film_minimum_um"]["resolved"] is False
    assert first["results"]["load_N"]["resolved"] is None


def test_bands_of_an_even_distribution():
    values = np.linspace(10.0, 30.0, 401)
    points = [("latin_hypercube", CASE | {"lubricant.viscosity_mPa_s": float(v)}) for v in values]
    found = bands(columns_of(InMemory(batch(points))))["film_minimum_um"]
    expected = [summary(CASE | {"lubricant.viscosity_mPa_s": v})["film_minimum_um"] for v in (11.0, 20.0, 29.0)]
    assert [found[q] for q in ("q05", "q50", "q95")] == pytest.approx(expected, rel=1e-9)
    assert found["points"] == 401
    few = bands(columns_of(InMemory(batch(points[:5]))))["film_minimum_um"]
    films = [summary(keys)["film_minimum_um"] for _, keys in points[:5]]
    assert few["mean"] == pytest.approx(sum(films) / 5)
    assert few["standard_deviation"] == pytest.approx((sum((film - few["mean"]) ** 2 for film in films) / 4) ** 0.5)


def test_a_plain_sweep_has_neither():
    document = batch_summary(batch([("sweep", CASE)]))
    assert document["sensitivity"] == []
    assert document["bands"] == {}
