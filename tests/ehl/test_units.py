"""Numbers of named units in SI and back."""

from math import degrees, pi

import numpy as np
import pytest

from oilfilm.ehl.units import UNITS, from_si, to_si, unit_of, unit_symbol


@pytest.mark.parametrize(
    ("key", "value", "si"),
    [
        ("film_minimum_um", 0.25, 2.5e-7),
        ("temperature_C", 40.0, 313.15),
        ("inner_speed_rpm", 60.0, 2.0 * pi),
        ("tilt_deg", 180.0, pi),
        ("supply_mL_min", 60.0, 1e-6),
        ("pressure_sliding_maximum_GPa_m_s", 2.0, 2e9),
        ("torque_N_mm", 70.0, 0.07),
        ("rating_kN", 30.0, 3e4),
        ("viscosity_mPa_s", 26.0, 0.026),
        ("viscosity_mm2_s", 12.0, 1.2e-5),
        ("inertia_g_mm2", 5.0, 5e-9),
        ("stiffness_N_um", 50.0, 5e7),
        ("pressure_viscosity_1_GPa", 18.0, 1.8e-8),
        ("life_h", 2.0, 7200.0),
        ("conductivity_W_m_K", 46.0, 46.0),
        ("ratio", 0.5, 0.5),
    ],
)
def test_values_of_keys_in_si(key, value, si):
    assert to_si(key, value) == pytest.approx(si, rel=1e-15)
    assert from_si(key, si) == pytest.approx(value, rel=1e-15)


def test_every_unit_returns_what_went_in():
    values = np.array([-3.0, 0.0, 17.0])
    for suffix, unit in UNITS.items():
        key = f"anything_{suffix}"
        assert unit_of(key) == unit.text
        assert to_si(key, 1.0) - to_si(key, 0.0) == pytest.approx(unit.si, rel=1e-13)
        np.testing.assert_allclose(from_si(key, to_si(key, values)), values, rtol=1e-15, atol=1e-12)


def test_null_and_signs():
    assert from_si("load_N", None) is None
    assert to_si("load_N", None) is None
    assert from_si("azimuth_deg", 0.7) == degrees(0.7)
    assert unit_symbol("film_minimum_um") == "µm"
    assert unit_symbol("temperature_C") == "°C"
