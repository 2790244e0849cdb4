"""The catalogue: names, estimates of the internal geometry and their warnings."""

from __future__ import annotations

import csv
from math import cos, pi, radians

import estimated_bearings
import pytest
from geometry_estimate import (
    CatalogueData,
    ball_sizes,
    estimate_geometry,
    most_balls,
    normal_clearance,
    typical_geometry,
)

from bearing import list_bearings, load_catalogue_entry
from bearing.library.bearings import published_bearings, warn_of_estimates
from bearing.library.names import matching_name, plain_name

ESTIMATED = tuple(name for name in list_bearings() if name not in published_bearings())
ROWS = estimated_bearings.rows()


def test_there_are_the_common_bearings():
    assert len(list_bearings()) >= 90
    for series in ("60", "62", "63"):
        assert {f"{series}{bore:02d}" for bore in range(13)} <= set(list_bearings())
    for suffix in ("C", "AC"):
        assert {f"70{bore:02d}{suffix}" for bore in range(13)} <= set(list_bearings())
    assert {f"72{bore:02d}{suffix}" for bore in range(13) for suffix in "BC"} <= set(list_bearings())


@pytest.mark.parametrize("name", ["7208B", "7208 b", "7208-B", " 7208_B "])
def test_names_match_without_case_spaces_and_hyphens(name):
    assert load_catalogue_entry(name)["name"] == "7208B"


def test_a_name_itself_comes_before_its_likes():
    names = ("6208 full ceramic", "6208-Full-Ceramic")
    assert matching_name("6208-Full-Ceramic", names) == "6208-Full-Ceramic"
    assert matching_name("6208FULLCERAMIC", names) == "6208 full ceramic"
    assert matching_name("6209", names) is None
    assert len({plain_name(name) for name in list_bearings()}) == len(list_bearings())


def test_the_data_file_is_what_the_estimator_makes_of_the_ratings():
    assert estimated_bearings.TARGET.read_text(encoding="utf-8") == estimated_bearings.text()


@pytest.fixture(scope="module")
def estimates():
    """The estimated geometry of each row of the catalogue with a rating."""
    return {name: estimated_bearings.estimate(row) for name, row in ROWS.items() if row["dynamic_rating_kN"]}


def test_one_pair_of_ball_and_number_explains_both_ratings(estimates):
    """C within 1 %, C_0 within 2 % (its definition, not the table of the standard), the next pair clearly worse."""
    offenders = {
        name: estimate
        for name, estimate in estimates.items()
        if abs(estimate.dynamic_error) >= 0.01
        or abs(estimate.static_error) >= 0.02
        or estimate.next_misfit <= 1.7 * estimate.misfit
    }
    assert len(estimates) > 70
    assert offenders == {}


def test_the_factor_f0_of_the_catalogue_follows_though_it_is_not_used(estimates):
    """f_0 = C_0/(Z D^2 cos alpha), ISO 76; printed to one decimal, C_0 to three figures: 0.05 + 0.3 %."""
    factors = {}
    for name, row in ROWS.items():
        if row["f0"]:
            estimate = estimates[name]
            angle = radians(float(row["contact_angle_deg"]))
            squares = estimate.balls * (1e3 * estimate.ball_diameter) ** 2 * cos(angle)
            factors[name] = 1e3 * float(row["static_rating_kN"]) / squares, float(row["f0"])
    assert factors
    assert {name: pair for name, pair in factors.items() if abs(pair[0] - pair[1]) > 0.05 + 0.045} == {}


@pytest.mark.parametrize(
    ("row", "balls", "ball_mm", "pitch_mm"),
    [
        ("6205", 9, 7.940, 39.04),  # Case Western Reserve University bearing data centre: 0.3126 and 1.537 inch
        ("6206", 9, 9.525, 46.0),  # bearings.toml: from publications, as the following
        ("6207", 9, 11.12, 53.5),
        ("6208", 9, 12.0, 60.0),
        ("6304", 7, 9.52, 36.01),
        ("7218B", 16, 22.23, 125.26),  # the textbook 218
    ],
)
def test_known_geometries_are_found(row, balls, ball_mm, pitch_mm):
    """Numbers of balls exactly, balls within 1 %, pitch diameters within 0.5 % (docs/user/libraries.md)."""
    found = estimated_bearings.estimate(ROWS[row])
    assert found.balls == balls
    assert found.ball_diameter == pytest.approx(ball_mm * 1e-3, rel=0.01)
    assert found.pitch_diameter == pytest.approx(pitch_mm * 1e-3, rel=0.005)


@pytest.mark.parametrize(("row", "name"), [("6209", "209"), ("7000C", "7000C")])
def test_other_designs_of_a_designation_lie_within_the_range(row, name):
    found, known = estimated_bearings.estimate(ROWS[row]).ranges(), load_catalogue_entry(name)
    assert found["ball_diameter"][0] <= known["ball_diameter_mm"] * 1e-3 <= found["ball_diameter"][1]
    assert found["balls"][0] <= known["balls"] <= found["balls"][1]


def encloses_its_balls(entry):
    ball = entry["ball_diameter_mm"]
    pitch = entry["pitch_diameter_mm"]
    inside = entry["bore_mm"] < pitch - ball and pitch + ball < entry["outside_diameter_mm"]
    return inside and entry["balls"] <= most_balls(ball, pitch)


def test_boundary_dimensions_enclose_the_balls():
    entries = [load_catalogue_entry(name) for name in ESTIMATED]
    assert len(entries) > 80
    assert [entry for entry in entries if not encloses_its_balls(entry)] == []
    assert [entry for entry in entries if "estimated" not in entry["source"]] == []


def guess_and_estimate(entry):
    """Ratios of ball and pitch diameters, difference of the numbers of balls."""
    angle = radians(entry.get("free_contact_angle_deg", 0.0))
    ball, pitch, balls = typical_geometry(entry["bore_mm"] * 1e-3, entry["outside_diameter_mm"] * 1e-3, angle)
    more = 0 if angle == radians(25.0) else balls - entry["balls"]  # 25 degrees: the balls of the 15 degrees
    return 1e3 * ball / entry["ball_diameter_mm"], 1e3 * pitch / entry["pitch_diameter_mm"], more


def test_a_guess_from_the_boundary_dimensions_is_near():
    """Balls -10 to +25 %, numbers -2 to +1: what docs/user/libraries.md says of it."""
    guesses = {name: guess_and_estimate(load_catalogue_entry(name)) for name in ESTIMATED}
    offenders = {
        name: guess
        for name, guess in guesses.items()
        if not (0.89 < guess[0] < 1.26 and abs(guess[1] - 1.0) <= 0.02 and -3 < guess[2] < 2)
    }
    assert offenders == {}


def test_series_and_dimensions_agree():
    """ISO 15: bore numbers 00 to 03 are 10, 12, 15, 17 mm, from 04 on five times the number."""
    with estimated_bearings.RATINGS.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            number = int(row["designation"][2:4])
            assert float(row["bore_mm"]) == (10.0, 12.0, 15.0, 17.0)[number] if number < 4 else 5.0 * number
            same = [other for other in ROWS.values() if other["designation"][1:4] == row["designation"][1:4]]
            for key in ("outside_diameter_mm", "width_mm"):
                assert len({other[key] for other in same}) == 1


def test_ball_sizes_and_clearance_groups():
    assert ball_sizes(6.7e-3, 8.8e-3) == pytest.approx([6.746875e-3, 7.14375e-3, 7.9375e-3, 8.73125e-3])
    assert normal_clearance(40e-3) == pytest.approx((6e-6, 20e-6))
    with pytest.raises(ValueError, match="bore"):
        normal_clearance(0.2)


@pytest.mark.parametrize(
    ("field", "value"), [("bore", -1.0), ("outside_diameter", 0.01), ("contact_angle", 2.0), ("dynamic_rating", 0.0)]
)
def test_impossible_catalogue_data_name_the_field(field, value):
    data = {"bore": 0.03, "outside_diameter": 0.062, "contact_angle": 0.0, "dynamic_rating": 2e4, "static_rating": 1e4}
    with pytest.raises(ValueError, match=field):
        CatalogueData(**{**data, field: value})


def test_no_standard_ball_in_a_thin_section():
    data = CatalogueData(bore=0.1, outside_diameter=0.1005, contact_angle=0.0, dynamic_rating=1e3, static_rating=1e3)
    with pytest.raises(ValueError, match="no room"):
        estimate_geometry(data)


def test_a_thicker_static_rating_asks_for_more_balls():
    """More static capacity at the same dynamic rating is more and smaller balls: D^1.8 Z^(2/3) against D^2 Z."""
    low, high = (
        estimate_geometry(
            CatalogueData(
                bore=0.03, outside_diameter=0.062, contact_angle=pi / 12, dynamic_rating=23e3, static_rating=s
            )
        )
        for s in (14e3, 16e3)
    )
    assert high.balls > low.balls
    assert high.ball_diameter <= low.ball_diameter


def test_a_warning_names_estimates_that_were_not_replaced(recwarn):
    entry = load_catalogue_entry("6305")
    with pytest.warns(UserWarning, match=r"'6305'.*estimated: ball diameter 10\.3187 mm \(9\.5964 to 11\.0411\)"):
        warn_of_estimates("6305", entry)
    with pytest.warns(UserWarning, match="estimated") as caught:
        warn_of_estimates("6305", {**entry, "ball_diameter_mm": 10.0}, ["balls"])
    text = str(caught[0].message)
    assert "pitch diameter" in text
    assert "ball diameter" not in text
    assert "balls" not in text


@pytest.mark.parametrize("name", ["209", "no such bearing"])
def test_nothing_to_warn_of(name, recwarn):
    warn_of_estimates(name, {"ball_diameter_mm": 12.7})
    assert not recwarn.list
