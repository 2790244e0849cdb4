"""Oils of other laws in the film atlas: the Roelands oil that stands for them, and their density."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from verification.contacts import OIL, from_groups, moes

from oilfilm import ehl
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.ehl import DensityLaw, ViscosityLaw
from oilfilm.ehl.atlas.oils import density_correction, inlet_oil, with_inlet_oil
from oilfilm.ehl.oil.lubricant import log_viscosity_ratio


def test_moments_of_barus():
    """q_1 = 1/alpha and q_2 = 1/alpha^2: Roelands with z = 1."""
    own = inlet_oil(replace(OIL, viscosity_law=ViscosityLaw.BARUS))
    assert own.moment * OIL.pressure_viscosity == pytest.approx(1.0, rel=1e-6)
    assert own.exponent == pytest.approx(1.0, abs=1e-4)
    assert own.pressure_viscosity == pytest.approx(OIL.pressure_viscosity, rel=1e-5)


def test_roelands_stands_for_itself():
    own = inlet_oil(OIL)
    assert own[:2] == (OIL.pressure_viscosity, OIL.exponent)
    conditions = from_groups(moes(200.0, 10.0, 0.4, oil=OIL))
    assert with_inlet_oil(conditions) is conditions
    found = inlet_oil(replace(OIL, roelands_pressure=OIL.roelands_pressure * (1.0 + 1e-9)))
    assert found.exponent == pytest.approx(OIL.exponent, rel=1e-4)
    assert found.moment == pytest.approx(own.moment, rel=1e-8)


@pytest.mark.parametrize("name", ["fva 3", "arana n100", "arana m100", "arana pao100", "shell t9"])
def test_viscosities_agree_where_the_film_is_made(name):
    """Up to 1/alpha* within 2 %."""
    oil = load_lubricant(name, 333.15)
    own = inlet_oil(oil)
    roelands = replace(OIL, pressure_viscosity=own.pressure_viscosity, roelands_z=own.exponent)
    pressure = np.linspace(0.0, own.moment, 30)
    assert log_viscosity_ratio(pressure, roelands) == pytest.approx(log_viscosity_ratio(pressure, oil), abs=0.02)


def test_another_reference_pressure_is_not_overlooked():
    """A Roelands oil with p_r 100 MPa thickens less under pressure: its film is thinner."""
    conditions = from_groups(moes(200.0, 10.0, 0.4, oil=OIL), modulus=226e11)
    other = replace(conditions, lubricant=replace(OIL, roelands_pressure=1e8))
    films, usual = ehl.atlas_films(other), ehl.atlas_films(conditions)
    solution = ehl.solve_contact(other, ehl.SolverOptions(points=257))
    assert films.central.value < 0.98 * usual.central.value
    assert films.central.value == pytest.approx(solution.film_central, abs=films.central.uncertainty)


def test_density_of_the_table_adds_nothing():
    assert not density_correction(OIL, 1e9, 50.0).any()
    incompressible = replace(OIL, density_law=DensityLaw.INCOMPRESSIBLE)
    added = density_correction(incompressible, 1e9, 50.0)
    assert 0.1 < added[0] < 0.2  # the centre of a film that cannot be compressed is thicker
    light = from_groups(moes(12.0, 8.0, oil=incompressible), modulus=226e11)
    with pytest.raises(ValueError, match=r"density_law.*light contacts.*solve_contact"):
        ehl.atlas_films(light)


CASES = {
    "modulus": load_lubricant("fva 3", 333.15),
    "volume": load_lubricant("shell t9", 333.15),
    "barus": replace(OIL, viscosity_law=ViscosityLaw.BARUS, pressure_viscosity=18e-9),
    "incompressible": replace(OIL, density_law=DensityLaw.INCOMPRESSIBLE),
    "isoviscous": replace(OIL, viscosity_law=ViscosityLaw.ISOVISCOUS),
}


@pytest.mark.parametrize("oil", CASES.values(), ids=CASES)
def test_films_beside_solves(oil):
    """Within both bars, which are as narrow as the page says."""
    conditions = from_groups(moes(300.0, 6.0, 0.15, oil=oil), modulus=226e11)
    films = ehl.atlas_films(conditions)
    solution = ehl.solve_contact(conditions, ehl.SolverOptions(points=257))
    assert solution.resolved
    for own, solved, bar in (
        (films.central, solution.film_central, solution.film_central_uncertainty),
        (films.minimum, solution.film_minimum, solution.film_minimum_uncertainty),
    ):
        assert own.value == pytest.approx(solved, abs=own.uncertainty + bar)
        assert own.uncertainty <= (1.0 + 1e-12) * 0.065 * own.value


def test_moes_groups_keep_their_pressure():
    """L and alpha of the standing oil change together: M, and p_h, stay."""
    oil = CASES["barus"]
    groups = moes(200.0, 10.0, 0.4, oil=oil)
    in_lengths = ehl.atlas_films(from_groups(groups, modulus=226e11))
    scale = ehl.solve_contact(from_groups(groups, modulus=226e11), ehl.SolverOptions(points=65)).film_scale
    assert ehl.atlas_films(groups).central.value * scale == pytest.approx(in_lengths.central.value, rel=1e-6)
