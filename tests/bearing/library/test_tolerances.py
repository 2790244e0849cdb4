"""Deviations of seats by name: values that handbooks print, and the rules of ISO 286 among them."""

from __future__ import annotations

import pytest

from oilfilm.bearing.library.bearings import (
    TOLERANCE_CLASSES,
    bore_deviations,
    housing_deviations,
    inner_interference,
    outer_interference,
    outside_deviations,
    shaft_deviations,
)
from oilfilm.bearing.library.plugins import library_data

SIZES = (8.0, 18.0, 25.0, 40.0, 80.0, 110.0, 150.0, 200.0, 300.0)


@pytest.mark.parametrize(
    ("name", "size", "expected"),
    [
        ("k5", 40.0, (2, 13)),
        ("m6", 65.0, (11, 30)),
        ("j6", 25.0, (-4, 9)),
        ("h6", 30.0, (-13, 0)),
        ("g6", 50.0, (-25, -9)),
        ("js5", 80.0, (-6.5, 6.5)),
        ("p6", 120.0, (37, 59)),
    ],
)
def test_shafts_of_handbooks(name, size, expected):
    assert shaft_deviations(name, size) == expected


@pytest.mark.parametrize(
    ("name", "size", "expected"),
    [
        ("H7", 80.0, (0, 30)),
        ("K6", 40.0, (-13, 3)),
        ("M7", 40.0, (-25, 0)),
        ("N7", 40.0, (-33, -8)),
        ("P7", 40.0, (-42, -17)),
        ("J7", 90.0, (-13, 22)),
        ("G7", 52.0, (10, 40)),
        ("K6", 150.0, (-21, 4)),
    ],
)
def test_housings_of_handbooks(name, size, expected):
    assert housing_deviations(name, size) == expected


def test_grades_grow_by_the_fifth_root_of_ten_and_with_the_size():
    """ISO 286: IT6 to IT8 are 10, 16 and 25 units i = 0.45 D^(1/3) + 0.001 D, D the mean of the range; rounded."""
    grades = library_data("fits.toml")["grades"]
    for values in grades.values():
        assert values == sorted(values)
    ends = [6.0, *library_data("fits.toml")["sizes"]["up_to_mm"]]
    for grade, units in (("IT6", 10.0), ("IT7", 16.0), ("IT8", 25.0)):
        for column, value in enumerate(grades[grade]):
            mean = (ends[column] * ends[column + 1]) ** 0.5
            unit = 0.45 * mean ** (1.0 / 3.0) + 0.001 * mean
            assert value == pytest.approx(units * unit, rel=0.09, abs=1.0)


def test_a_tighter_class_has_smaller_tolerances():
    for size in SIZES:
        for deviations in (bore_deviations, outside_deviations):
            lower = [deviations(name, size)[0] for name in TOLERANCE_CLASSES]
            assert lower == sorted(lower)
            assert all(deviations(name, size)[1] == 0.0 for name in TOLERANCE_CLASSES)


def test_interference_is_that_of_the_extremes():
    """k5 on 40 mm, normal class: shaft +2 to +13, bore -12 to 0; H7 in 80 mm: housing 0 to 30, ring -13 to 0."""
    assert inner_interference("k5", "normal", 40.0) == (2.0, 25.0)
    assert outer_interference("H7", "normal", 80.0) == (-43.0, 0.0)
    assert outside_deviations("normal", 170.0) == (-25.0, 0.0)


@pytest.mark.parametrize("name", ["k9", "z5", "K5", "5k", "", "j7"])
def test_unknown_tolerances_say_what_is_allowed(name):
    with pytest.raises(ValueError, match="allowed"):
        shaft_deviations(name, 40.0)


def test_sizes_beyond_the_tables_are_refused():
    with pytest.raises(ValueError, match="size must lie above 6 mm"):
        shaft_deviations("k5", 5.0)
    with pytest.raises(ValueError, match="up to 315 mm"):
        housing_deviations("H7", 400.0)
