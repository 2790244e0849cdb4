"""Contacts of the traction tests: one solved, and dry ones with Hertz' pressure under a film of uniform thickness."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm import ehl

OIL = ehl.Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
INNER_6208 = ehl.ContactConditions(
    load=500.0,
    radius_x=4.8e-3,
    radius_y=1.0 / (2.0 / 12e-3 - 1.0 / 6.17e-3),
    reduced_modulus=310e9 / (1.0 - 0.26**2),
    entrainment_speed=15.08,
    lubricant=OIL,
)


@pytest.fixture(scope="session")
def conditions():
    """Inner race of the ceramic 6208, 500 N."""
    return INNER_6208


@pytest.fixture(scope="session")
def solution():
    return ehl.solve_contact(INNER_6208, ehl.SolverOptions(points=257))


@pytest.fixture(scope="session")
def hertzian(solution):
    """Makes a solution with Hertz' pressure and a uniform film [m] on a fine grid over the ellipse."""

    def make(film=1e-6, points=401, **changes):
        conditions = replace(INNER_6208, **changes)
        reference = solution if not changes else ehl.solve_contact(conditions, ehl.SolverOptions(points=65))
        ratio = reference.semi_axis_ratio
        X, Y = np.linspace(-1.0, 1.0, points), ratio * np.linspace(-1.0, 1.0, points)
        P = np.sqrt(np.maximum(1.0 - X[:, None] ** 2 - (Y[None, :] / ratio) ** 2, 0.0))
        H = np.full_like(P, film / reference.film_scale)
        return replace(reference, conditions=conditions, X=X, Y=Y, P=P, H=H)

    return make
