"""[[rows]] in case files, in a run and in the summary."""

from __future__ import annotations

import io

import numpy as np
import pytest
from rich.console import Console

from oilfilm.cases import load_case, run_case
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.postprocess import summary
from oilfilm.postprocess.bearing.plots import write_bearing_plots
from oilfilm.postprocess.bearing.write import bearing_table
from oilfilm.postprocess.scene.vtk import bodies

CASE = """\
schema_version = 1
[bearing]
name = "7008"
[lubricant]
viscosity_mPa_s = 26.1
pressure_viscosity_1_GPa = 18.0
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 300.0
[ehl]
film_maps = "none"
"""
LEFT = '[[rows]]\naxial_position_mm = -7.5\nloaded_by = "+x"\npreload_N = 200.0\n'
RIGHT = '[[rows]]\naxial_position_mm = 7.5\nloaded_by = "-x"\npreload_N = 200.0\n'


def faults(text):
    with pytest.raises(CaseError) as caught:
        case_from_text(text, "case.toml")
    return str(caught.value)


@pytest.fixture(scope="module")
def pair():
    return run_case(case_from_text(CASE + LEFT + RIGHT, "case.toml"))


def test_a_pair_in_the_summary(pair, tmp_path):
    found = summary(pair)
    assert found["converged"]
    assert [block["row"] for block in found["rows"]] == [1, 2]
    assert [block["axial_position_mm"] for block in found["rows"]] == [-7.5, 7.5]
    assert found["rows"][0]["offset_um"] == pytest.approx(-found["rows"][1]["offset_um"])
    assert sum(block["force_N"][1] for block in found["rows"]) == pytest.approx(300.0)
    assert [ball["row"] for ball in found["balls"]] == [1] * 18 + [2] * 18
    assert len({(contact["ball"], contact["race"]) for contact in found["contacts"]}) == 72
    assert any("mean over 2 rows" in message for message in found["messages"])
    assert write_bearing_plots(pair, tmp_path) == ()


def test_a_tandem_pair_is_told_that_it_does_not_preload_itself():
    tandem = CASE.replace("[ehl]", "axial_load_N = 500.0\n[ehl]") + LEFT + RIGHT.replace("-x", "+x")
    found = case_from_text(tandem, "case.toml")
    assert any("rows.preload_N: nothing presses back where all rows" in message for message in found.warnings)
    free = case_from_text(tandem.replace("preload_N = 200.0\n", ""), "case.toml")
    assert not any("presses back" in message for message in free.warnings)
    loads = [run_case(one).quasistatic.inner_load for one in (found, free)]
    np.testing.assert_allclose(*loads, rtol=1e-6)
    pair = case_from_text(CASE + LEFT + RIGHT, "case.toml")
    assert not any("presses back" in message for message in pair.warnings)


def test_a_single_row_is_listed_too():
    found = summary(run_case(case_from_text(CASE, "case.toml")))
    assert len(found["rows"]) == 1
    assert found["rows"][0]["cage_speed_rpm"] == found["cage_speed_rpm"]
    assert found["rows"][0]["force_N"] == pytest.approx(found["ring"]["force_N"], abs=1e-9)


def test_bodies_of_both_rows(pair):
    single = bodies(run_case(case_from_text(CASE, "case.toml")))
    for name, surface in bodies(pair).items():
        assert len(surface.points) == 2 * len(single[name].points)
        assert surface.points[:, 0].min() < -6e-3 < 6e-3 < surface.points[:, 0].max()


def test_the_terminal_tells_where_a_row_begins(pair):
    def lines(results):
        console = Console(width=80, record=True, file=io.StringIO())
        console.print(bearing_table(results))
        return [line.strip() for line in console.export_text().splitlines()]

    assert [line for line in lines(pair) if line in ("row 1", "row 2")] == ["row 1", "row 2"]
    assert "row 1" not in lines(run_case(case_from_text(CASE, "case.toml")))


def test_preload_is_set_with_the_clearance_as_delivered():
    warm = "[temperatures]\ninner_ring_C = 60.0\nouter_ring_C = 50.0\nball_C = 55.0\n"
    cold, hot = (case_from_text(CASE + LEFT + RIGHT + more, "case.toml") for more in ("", warm))
    assert cold.rows == hot.rows
    assert hot.bearing.diametral_clearance < cold.bearing.diametral_clearance


def test_films_of_both_rows_by_azimuth():
    """The azimuth of a ball names those of every row."""
    case = load_case("7008_back_to_back")
    from oilfilm.bearing import contact_conditions, solve_quasistatic
    from oilfilm.cases.runs.films import wanted_contacts

    state = solve_quasistatic(case.bearing, case.operation, case.model, rows=case.rows)
    contacts = contact_conditions(state, case.lubricant)
    wanted, _ = wanted_contacts(case, state, contacts)
    chosen = [contact for contact, conditions in zip(contacts, wanted, strict=True) if conditions is not None]
    assert [(contact.row, contact.ball) for contact in chosen] == [(1, 1), (1, 1), (2, 19), (2, 19)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (CASE + LEFT + RIGHT + "preload_um = 3.0\n", "rows.1.preload_um: found together with preload_N"),
        (CASE + LEFT + RIGHT.replace("7.5", "-2.0"), "at least a ball diameter, 7 mm"),
        (CASE + LEFT.replace('"+x"', '"x"'), "rows.0.loaded_by"),
        (CASE + LEFT.replace("preload_N", "preload_kN"), "preload_N"),
        (CASE + "[[rows]]\n", "rows.0.axial_position_mm"),
        (CASE + LEFT.replace("200.0", "1e7"), "preload_force"),
        (CASE + LEFT + "[slip]\nspeeds_rpm = [1e3, 2e3]\naxial_loads_N = [1.0, 2.0]\n", "slip maps of a single row"),
        (CASE.replace('"none"', "[5.0]") + LEFT, "where no ball is"),
    ],
)
def test_bad_rows_are_told(text, expected):
    assert expected in faults(text)


def test_azimuths_of_a_turned_row_are_known():
    text = CASE.replace('"none"', "[5.0]") + LEFT + RIGHT + "first_ball_azimuth_deg = 5.0\n"
    assert case_from_text(text, "case.toml").rows[1].first_ball_azimuth == pytest.approx(0.0872665)
