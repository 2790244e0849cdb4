"""Load sharing of film and asperities: published numbers, exact integrals, flattening of waves by the film."""

from __future__ import annotations

from dataclasses import replace
from math import erfc, exp, inf, log, pi, sqrt

import pytest
from scipy.integrate import quad

from oilfilm.bearing import Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.films.asperities import (
    Asperities,
    LoadSharing,
    Spectrum,
    five_halves_integral,
    zhou_hoeprich_share,
)
from oilfilm.ehl import Lubricant
from oilfilm.ehl.conditions import moes_groups

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, density=870.0)


@pytest.fixture(scope="module")
def contact(bearings):
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=500.0, force=(0.0, 3000.0, 0.0)))
    return contact_conditions(state, OIL)[0]


@pytest.mark.parametrize(
    ("height", "known"), [(0.0, 0.616634), (0.5, 0.240402), (1.0, 0.080562), (2.0, 0.005424), (3.0, 0.000171)]
)
def test_greenwood_and_tripps_integral_is_exact(height, known):
    def density(s):
        return (s - height) ** 2.5 * exp(-0.5 * s * s) / sqrt(2.0 * pi)

    assert five_halves_integral(height) == pytest.approx(quad(density, height, inf)[0], rel=1e-7)
    assert five_halves_integral(height) == pytest.approx(known, abs=1e-6)


def test_shares_fall_from_one_to_none(contact):
    for law in LoadSharing:
        rough = Asperities(inner_roughness=1e-7, outer_roughness=1e-7, boundary=0.12, sharing=law)
        shares = [rough.load_fraction(contact, film) for film in (0.0, 0.3e-7, 1e-7, 2e-7, 8e-7)]
        assert shares == sorted(shares, reverse=True)
        assert shares[-1] < 1e-4
        if law is not LoadSharing.GREENWOOD_TRIPP:  # whose planes never carry more than their pressure
            assert shares[0] == 1.0
    assert zhou_hoeprich_share(1.0) == pytest.approx(exp(-2.32))
    arana = replace(rough, sharing=LoadSharing.ARANA)
    assert arana.load_fraction(contact, 1e-7) == pytest.approx(erfc(1.0))
    smooth = replace(rough, inner_roughness=0.0)
    assert smooth.load_fraction(contact, 0.0) == 0.0


def test_greenwood_and_tripps_share_by_hand(contact):
    """(16 sqrt 2/15) pi (eta beta sigma)^2 sqrt(sigma/beta) E*/2 F_5/2 pi a b/Q."""
    law = LoadSharing.GREENWOOD_TRIPP
    rough = Asperities(inner_roughness=1e-7, outer_roughness=1e-7, boundary=0.12, sharing=law, density=0.04, slope=1e-3)
    h = contact.hertz
    pressure = 16.0 * sqrt(2.0) / 15.0 * pi * 0.04**2 * sqrt(1e-3) * 0.5 * h.reduced_modulus * 0.080562
    expected = pressure * pi * h.semi_axis_x * h.semi_axis_y / contact.load
    assert rough.load_fraction(contact, 1e-7) == pytest.approx(expected, rel=1e-5)


def test_the_film_flattens_long_waves(contact):
    """A single wave keeps 1/(1 + 0.15 x + 0.015 x^2), a spectrum between its shortest and its longest wave."""
    load, lubricant = moes_groups(contact.conditions)

    def kept(length):
        x = length / contact.hertz.semi_axis_x * sqrt(load / lubricant)
        return 1.0 / (1.0 + 0.15 * x + 0.015 * x**2)

    assert Spectrum(shortest=2e-5, longest=2e-5).left(contact) == pytest.approx(kept(2e-5))
    wide = Spectrum(shortest=1e-6, longest=2e-4).left(contact)
    assert kept(2e-4) < wide < kept(1e-6) < 1.0
    for hurst in (0.3, 0.8):  # of a profile whose waves between ln l and ln l + d ln l have l^2H

        def power(at, hurst=hurst):
            return exp(2.0 * hurst * at)

        ends = (log(1e-6), log(2e-4))
        left = quad(lambda at, power=power: power(at) * kept(exp(at)) ** 2, *ends)[0] / quad(power, *ends)[0]
        found = Spectrum(shortest=1e-6, longest=2e-4, hurst=hurst).left(contact)
        assert found == pytest.approx(sqrt(left), rel=0.03)  # 64 waves, both ends count whole
    rough = Asperities(inner_roughness=2e-7, outer_roughness=2e-7, boundary=0.12)
    flattened = replace(rough, spectrum=Spectrum(shortest=1e-6, longest=2e-4))
    assert flattened.load_fraction(contact, 2e-7) < rough.load_fraction(contact, 2e-7)
