"""Films of many contacts at once: those of the atlas one by one, and none where it has none."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm import ehl
from oilfilm.ehl.atlas.films import atlas_load
from oilfilm.ehl.scaling import scale_contact

NAMES = (
    *("load", "radius_x", "radius_y", "reduced_modulus", "entrainment_speed"),
    *("viscosity", "pressure_viscosity", "roelands_z"),
)
NUMBER = 120


def drawn():
    """Contacts of steel and ceramics, many of them outside the range, a third with the oil of the table."""
    random = np.random.default_rng(51207)

    def log_uniform(low, high):
        return np.exp(random.uniform(np.log(low), np.log(high), NUMBER))

    radius = random.uniform(2e-3, 1e-2, NUMBER)
    third = np.arange(NUMBER) % 3 == 0
    return {
        "load": log_uniform(5.0, 4000.0),
        "radius_x": radius,
        "radius_y": radius / log_uniform(0.008, 6.0),
        "reduced_modulus": random.uniform(2e11, 3.2e11, NUMBER),
        "entrainment_speed": log_uniform(0.3, 40.0),
        "viscosity": log_uniform(0.003, 0.3),
        "pressure_viscosity": np.where(third, 22e-9, random.uniform(9e-9, 31e-9, NUMBER)),
        "roelands_z": np.where(third, 0.68, random.uniform(0.38, 0.82, NUMBER)),
    }


def conditions_of(given, number):
    contact = {name: float(given[name][number]) for name in NAMES}
    oil = ehl.Lubricant(**{name: contact.pop(name) for name in NAMES[5:]})
    return ehl.ContactConditions(**contact, lubricant=oil)


def one_by_one(given, number):
    return ehl.atlas_films(conditions_of(given, number))


def for_bearings_alone(given, number):
    """Whether a contact lies in what `range_of` adds to `RANGE`."""
    scaled = scale_contact(conditions_of(given, number))
    return atlas_load(scaled) > 160.0 or scaled.moes_lubricant > 30.0


def test_many_at_once_are_those_one_by_one():
    """To a fifth of the error bars; the errors themselves, and what is refused, as there."""
    given = drawn()
    found = ehl.atlas_arrays(ehl.ContactArrays(**given))
    assert 30 < found.inside.sum() < NUMBER - 20
    for number in range(NUMBER):
        try:
            own = one_by_one(given, number)
        except ValueError:
            assert not found.inside[number]
            assert np.isnan(found.central[number]) and np.isnan(found.minimum_error[number])
            continue
        if for_bearings_alone(given, number):
            assert not found.inside[number]
            continue
        assert found.inside[number]
        for name in ("central", "minimum", "approach", "stiffness"):
            value, known = getattr(found, name)[number], getattr(own, name)
            assert abs(value - known.value) < 0.2 * known.uncertainty
        for name in ("central", "minimum"):
            known = getattr(own, name)
            assert getattr(found, f"{name}_error")[number] == pytest.approx(known.uncertainty / known.value)
        assert found.approach_error[number] == pytest.approx(own.approach.uncertainty, rel=2e-3)  # it has the film


def test_shapes_are_brought_together():
    """A column of loads beside a row of speeds; more load leaves less film, more speed more."""
    given = {name: 1.0 * values[0] for name, values in drawn().items()}
    given |= {"radius_x": 4e-3, "radius_y": 4e-2, "viscosity": 0.03, "pressure_viscosity": 22e-9, "roelands_z": 0.68}
    given |= {"load": np.geomspace(100.0, 800.0, 4)[:, None], "entrainment_speed": np.geomspace(3.0, 12.0, 5)}
    found = ehl.atlas_arrays(ehl.ContactArrays(**given))
    assert found.central.shape == found.inside.shape == (4, 5) and found.inside.all()
    assert np.all(np.diff(found.central, axis=0) < 0.0) and np.all(np.diff(found.minimum, axis=1) > 0.0)
    with pytest.raises(ValueError, match="shape"):
        ehl.atlas_arrays(ehl.ContactArrays(**{**given, "viscosity": np.ones(3)}))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
def test_no_number_comes_of_nonsense(name, value):
    """A value that cannot be is outside, without a warning."""
    given = {name: values[:2].copy() for name, values in drawn().items()}
    given[name][1] = value
    found = ehl.atlas_arrays(ehl.ContactArrays(**given))
    assert not found.inside[1] and np.isnan(found.central[1]) and np.isnan(found.stiffness[1])
