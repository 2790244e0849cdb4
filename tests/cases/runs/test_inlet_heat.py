"""Films of bearings come with the heat of their inlets: bearings that are not shipped, at and above n d_m 5e5."""

from __future__ import annotations

from dataclasses import replace

import pytest

from oilfilm.cases import run_case
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.postprocess import summary
from oilfilm.postprocess.bearing.contact_quantities import heat_messages

CASE = """
schema_version = 1
[bearing]
name = "{name}"
[lubricant]
name = "iso vg 32"
[surface]
inner_ring_roughness_um = 0.3
outer_ring_roughness_um = 0.3
ball_roughness_um = 0.03
[operation]
inner_speed_rpm = {speed}
{direction}_load_N = {load}
temperature_C = 60.0
[ehl]
film_maps = "none"
"""
MADE = {
    "7014C": {"speed": 20000.0, "direction": "axial", "load": 600.0},
    "6010": {"speed": 15000.0, "direction": "radial", "load": 900.0},
    "7205B": {"speed": 18000.0, "direction": "axial", "load": 400.0},
}


def text(name, **changes):
    return CASE.format(name=name, **{**MADE[name], **changes})


@pytest.mark.parametrize("name", MADE)
def test_every_film_is_printed_with_heat_and_the_isothermal_one_beside(name):
    found = summary(run_case(case_from_text(text(name), name)))
    films = [contact for contact in found["contacts"] if contact["film_minimum_um"] is not None]
    assert films
    for contact in films:
        share = contact["inlet_heat_share"]
        assert contact["inlet_heat_share_low"] < share < contact["inlet_heat_share_high"] < 1.0
        shares = {"central": share, "minimum": contact["inlet_heat_share_minimum"]}
        for film in ("central", "minimum"):
            hot = contact[f"film_{film}_um"]
            assert hot == pytest.approx(shares[film] * contact[f"isothermal_film_{film}_um"])
            parts = [contact[f"film_{film}_{part}_uncertainty_um"] for part in ("mesh", "heat", "oil")]
            assert min(parts) > 0.0
            parts.append(contact[f"film_{film}_pressure_viscosity_uncertainty_um"] or 0.0)
            assert contact[f"film_{film}_uncertainty_um"] == pytest.approx(sum(part**2 for part in parts) ** 0.5)
            assert parts[1] < (0.07 if name != "7014C" else 0.1) * hot  # its L_T is 7
        for kind in ("film", "isothermal_film"):
            assert contact[f"{kind}_minimum_um"] <= contact[f"{kind}_central_um"]
        together = (0.3**2 + 0.03**2) ** 0.5
        assert contact["lambda_ratio"] == pytest.approx(contact["film_minimum_um"] / together)
    heaviest = max(films, key=lambda contact: contact["load_N"])
    assert heaviest["inlet_heat_share"] < 0.9
    assert any("inlet shear heating (included) leaves" in message for message in found["messages"])


def test_a_minimum_film_held_at_the_central_one_is_named():
    films = [film for film in run_case(case_from_text(text("6010"), "6010")).operating if film is not None]
    assert not any("held at the central" in message for message in heat_messages(films))
    held = [replace(films[0], minimum=films[0].central), *films[1:]]
    assert any("minimum films at 1 contacts are held at the central" in message for message in heat_messages(held))


def test_friction_takes_the_film_with_heat():
    results = run_case(case_from_text(text("6010"), "6010"))
    running = [film for film in results.torque.shear.films if film is not None]
    films = [contact for contact in summary(results)["contacts"] if contact["film_central_um"] is not None]
    assert len(running) == len(films)
    for film, contact in zip(running, films, strict=True):
        assert 1e6 * film.central.value == pytest.approx(contact["film_central_um"])
        assert 1e6 * film.isothermal_central == pytest.approx(contact["isothermal_film_central_um"])
        assert 1e6 * film.flooded_central == pytest.approx(contact["flooded_film_central_um"])
        assert film.isothermal_central < film.flooded_central  # by the supply alone
        assert film.asperity_load > film.flooded_asperity_load


def test_a_slow_bearing_keeps_its_films():
    found = summary(run_case(case_from_text(text("6010", speed=100.0), "6010")))
    shares = [contact["inlet_heat_share"] for contact in found["contacts"] if contact["inlet_heat_share"]]
    assert min(shares) > 0.99


def test_no_key_takes_the_heat_away():
    with pytest.raises(CaseError, match="inlet_heating"):
        case_from_text(text("6010") + 'inlet_heating = "none"\n', "6010")


FAST = """
schema_version = 1
bearing = {name = "7014C"}
lubricant = {name = "iso vg 32"}
ehl = {points = 129, film_maps = [0.0, 180.0], film_model = "thermal"}
[operation]
inner_speed_rpm = 20000.0
axial_load_N = 300.0
radial_load_N = 200.0
temperature_C = 60.0
"""


@pytest.mark.slow
def test_fast_films_with_heat_need_no_fallback():
    """Oil that recirculates ahead of them takes heat upstream; without that they fell back on continuation."""
    results = run_case(case_from_text(FAST, "case.toml"))
    solved = [n for n, film in enumerate(results.solutions) if film is not None]
    films = [results.solutions[n] for n in solved]
    # the ball that the elastic contacts leave free rides between two films, which are solved, too
    assert [results.contacts[n].gap is not None for n in solved] == [False, False, True, True]
    assert [film.record.fallbacks for film in films] == [(), (), (), ()]
    assert all(film.converged and film.state.temperature is not None for film in films)
