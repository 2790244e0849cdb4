"""Sobol indices and Morris' effects of functions whose answers are known."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm.cases.batch.samples import morris_design, saltelli_design
from oilfilm.postprocess.batch.summary import elementary_effects, sobol_indices

SEED = 58_201


def ishigami(x):
    """Ishigami and Homma (1990) with a = 7, b = 0.1."""
    return np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def test_ishigamis_indices():
    """Exact first indices 0.3139, 0.4424, 0 and total ones 0.5576, 0.4424, 0.2437 (Saltelli et al. 2008, sec. 4)."""
    samples = 4096
    places = np.pi * (2.0 * saltelli_design(3, samples, SEED) - 1.0)
    first, total, intervals = sobol_indices(ishigami(places), 3, samples)
    assert first == pytest.approx([0.3139, 0.4424, 0.0], abs=0.01)
    assert total == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.01)
    for exact, ends in zip(([0.3139, 0.4424, 0.0], [0.5576, 0.4424, 0.2437]), intervals, strict=True):
        assert (ends[:, 0] < exact).all() and (exact < ends[:, 1]).all()


def test_effects_of_a_linear_function_are_its_coefficients():
    design = morris_design(3, 5, 4, SEED).reshape(5, 4, 3)
    assert design.min() >= 0.0 and design.max() <= 1.0 + 1e-12
    moves = np.abs(np.diff(design, axis=1))
    assert np.count_nonzero(moves > 1e-9, axis=2).tolist() == [[1] * 3] * 5  # one key at a time
    assert (np.count_nonzero(moves > 1e-9, axis=1) == 1).all()  # and each once
    assert moves.max() == pytest.approx(2.0 / 3.0)
    effects, _ = elementary_effects(design @ np.array([1.0, -2.0, 0.5]), design)
    assert effects == pytest.approx(np.tile([1.0, -2.0, 0.5], (5, 1)))


def test_a_trajectory_with_a_gap_is_told_by_nan():
    design = morris_design(2, 2, 4, SEED).reshape(2, 3, 2)
    values = design.sum(axis=2)
    values[1, 1] = np.nan
    effects, _ = elementary_effects(values, design)
    assert np.isnan(effects).any(axis=1).tolist() == [False, True]
