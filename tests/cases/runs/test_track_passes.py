"""A track of a single contact, pass after pass: case keys, summary, files and picture."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from oilfilm import postprocess
from oilfilm.cases.format.case import case_from_text, load_case
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.contact import run_contact
from oilfilm.ehl import solve_contact
from oilfilm.postprocess import summary
from oilfilm.postprocess.contact.plots import write_contact_plots
from oilfilm.postprocess.contact.write import write_contact_netcdf

MOES = """
schema_version = 1
[contact]
moes_M = 20.0
moes_L = 10.0
[lubricant]
pressure_viscosity_1_GPa = 20.0
roelands_z = 0.68
inlet_film_dimensionless = 0.3
[ehl]
points = 65
"""


@pytest.fixture(scope="module")
def track():
    return run_contact(case_from_text(MOES + "track_passes = 3\ntrack_loss = 0.1\n", "case.toml"))


def test_passes_follow_each_other(track):
    document = summary(track)
    rows = document["passes"]
    assert [row["pass"] for row in rows] == [1, 2, 3]
    assert document["converged"] and all(row["converged"] for row in rows)
    assert all(after["film_share"] < before["film_share"] for before, after in pairwise(rows))
    assert rows[0]["inlet_ratio"] == document["inlet_ratio"]
    assert all(abs(row["oil_kept"] - 1.0) < 2e-3 and row["ridge_ratio"] > 2.0 for row in rows)
    assert rows[0]["film_central_um"] is None  # Moes' groups have no lengths
    assert track.passes[1].inlet == pytest.approx(0.9 * track.passes[0].outlet, rel=1e-12)
    assert any(message.startswith("passes: each contact") for message in document["messages"])


def test_files_of_a_track(track, tmp_path):
    write_contact_netcdf(track, tmp_path / "results.nc", summary(track))
    with postprocess.open_results(tmp_path / "results.nc") as tree:
        node = tree["passes"]
        assert node["outlet_layer"].shape == (3, track.solution.Y.size)
        assert node["inlet_layer"].values[1] == pytest.approx(0.9 * node["outlet_layer"].values[0], rel=1e-12)
        assert node["outlet_layer"].attrs["units"] == "a^2/Rx"
    assert write_contact_plots(track, tmp_path) == ()
    assert (tmp_path / "plots" / "passes.png").stat().st_size > 10_000


def test_a_pass_that_does_not_converge_is_told(monkeypatch):
    calls = []

    def failing(conditions, options):
        calls.append(conditions)
        solution = solve_contact(conditions, options)
        return solution if len(calls) < 2 else replace(solution, converged=False)

    monkeypatch.setattr("oilfilm.cases.format.film_model.solve_contact", failing)
    document = summary(run_contact(case_from_text(MOES + "track_passes = 3\n", "case.toml")))
    assert not document["converged"]
    assert [row["converged"] for row in document["passes"]] == [True, False]
    assert document["passes"][1]["film_share"] is None
    assert any("ended after 2 of 3, not converged" in message for message in document["messages"])


def test_without_a_track_there_are_no_passes():
    document = summary(run_contact(case_from_text(MOES, "case.toml")))
    assert document["passes"] is None
    assert "passes: null, no ehl.track_passes" in document["messages"]


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"inlet_film_dimensionless = 0.3": "", "[ehl]": "[ehl]\ntrack_passes = 3"}, "ehl.track_passes"),
        ({"[ehl]": "[ehl]\ntrack_passes = 1"}, "ehl.track_passes"),
        ({"[ehl]": "[ehl]\ntrack_loss = 0.1"}, "ehl.track_loss"),
        ({"[ehl]": "[ehl]\ntrack_passes = 3\ntrack_added_um = 0.1"}, "ehl.track_added_um"),
        ({"[ehl]": '[ehl]\ntrack_passes = 3\nstarvation = "tabulated"'}, "ehl.starvation"),
        ({"[ehl]": '[ehl]\ntrack_passes = 3\nfilm_model = "shear-thinning"'}, "ehl.film_model"),
        ({"[ehl]": "[ehl]\ntrack_passes = 3", "[lub": "entrainment_angle_deg = 20.0\n[lub"}, "ehl.track_passes"),
    ],
)
def test_a_track_that_cannot_be_is_refused(change, key):
    text = MOES
    for old, new in change.items():
        text = text.replace(old, new)
    with pytest.raises(CaseError, match=key):
        case_from_text(text, "case.toml")


def test_the_shipped_track_is_a_contact_with_lengths():
    case = load_case("ball_on_disc_track")
    assert case.passes.number == 6
    assert case.passes.added == 0.0
