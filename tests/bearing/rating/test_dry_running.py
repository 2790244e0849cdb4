"""A bearing that runs dry: friction, heat, wear and flash temperature by hand, and as a case."""

from dataclasses import replace
from math import pi, sqrt

import pytest

import oilfilm
from oilfilm.bearing import contact_conditions
from oilfilm.bearing.contacts.stress import contact_stress
from oilfilm.bearing.friction.coulomb import balanced_friction
from oilfilm.bearing.rating.dry_running import dry_running
from oilfilm.bearing.rating.dry_surface import MM3, list_dry_surfaces, load_dry_surface


@pytest.fixture(scope="module")
def dry():
    case = oilfilm.load_case("6205_ceramic_dry_in_vacuum")
    state = oilfilm.solve_quasistatic(case.bearing, case.operation, case.model)
    return case, state, contact_conditions(state, case.lubricant)


def test_no_contact_has_a_film(dry):
    _, _, contacts = dry
    assert [c.conditions for c in contacts] == [None] * len(contacts)
    assert {c.note for c in contacts if c.hertz} == {"dry running: no film"}


def test_wear_is_the_power_over_the_coefficient(dry):
    case, state, contacts = dry
    mu = case.friction.coefficient
    found = dry_running(state, contacts, case.dry, mu)
    power = balanced_friction(state, contacts, mu).power
    assert found.power.value == pytest.approx(power.sum(), rel=1e-12)
    assert found.wear.value == pytest.approx(6.5e-6 * MM3 * power.sum() / mu, rel=1e-12)
    track = pi * (case.bearing.pitch_diameter - case.bearing.ball_diameter)
    width = 2.0 * max(c.hertz.semi_axis_y for c in contacts if c.hertz and c.race.value == "inner")
    depth = 6.5e-6 * MM3 * power[:, 0].sum() / mu / (track * width)
    assert found.inner_depth.value == pytest.approx(depth, rel=1e-12)


def test_ranges_are_those_of_the_surface(dry):
    case, state, contacts = dry
    found = dry_running(state, contacts, case.dry, 0.08)  # twice the surface's: its range goes with it
    assert found.friction == pytest.approx((0.08, 0.04, 0.12))
    assert found.flash.high == pytest.approx(1.5 * found.flash.value)
    assert found.film_life.low < found.film_life.value < found.film_life.high
    assert dry_running(state, contacts, load_dry_surface("silicon nitride hp"), 0.7).film_life is None


def test_flash_temperature_by_hand(dry):
    """Blok: 1.11 mu w v/[(B_1 + B_2) sqrt(u 2a)]."""
    case, state, contacts = dry
    heaviest = max((c for c in contacts if c.race.value == "inner"), key=lambda c: c.load)
    a, product = heaviest.hertz.semi_axis_x, contact_stress(state, heaviest).pressure_sliding
    inner = case.bearing.pitch_diameter - case.bearing.ball_diameter
    cage = abs(state.orbit_speed[0])
    u = 0.5 * inner * (case.operation.inner_speed - cage)
    wanted = 1.11 * 0.04 * 0.5 * pi * a * product / (sum(heaviest.effusivities) * sqrt(2.0 * a * u))
    assert dry_running(state, contacts, case.dry, 0.04).flash.value == pytest.approx(wanted, rel=0.02)


def test_given_heat_transfer_takes_the_place_of_the_common_one(dry):
    case, state, contacts = dry
    found = dry_running(state, contacts, case.dry, 0.04, 2.0)
    assert found.bulk == pytest.approx(tuple(0.5 * power for power in found.power))


def test_surfaces_have_sources_and_ordered_ranges():
    for surface in map(load_dry_surface, list_dry_surfaces()):
        assert surface.source
        for of in (surface.friction, surface.wear):
            assert of.low <= of.value <= of.high
    assert load_dry_surface("x105crmo17").name == "other"
    assert load_dry_surface("MoS2-film").fed


def test_results_of_a_dry_case():
    results = oilfilm.run_case(oilfilm.load_case("6205_ceramic_dry_in_vacuum"))
    document = oilfilm.summary(results)
    assert document["converged"] is True
    assert document["life"]["basic_reference_rating_h"] is None
    assert {c["film_central_um"] for c in document["contacts"]} == {None}
    torque = document["torque_N_mm"]
    assert torque["total"] == pytest.approx(torque["models"]["coulomb"]["total"], rel=1e-3)
    assert torque["total_range"]["low"] == pytest.approx(0.5 * torque["total"], rel=0.01)
    assert torque["models"]["skf"]["total"] is torque["models"]["palmgren"]["total"] is None
    assert document["dry_running"]["surface"] == "mos2 film"
    text = " ".join(document["messages"])
    assert "life: null, it runs dry" in text
    assert "films, lambda_ratio and what follows from them null" in text
    assert "seizure" in text


def test_dry_and_an_oil_do_not_go_together():
    case = oilfilm.load_case("6205_ceramic_in_water")
    with pytest.raises(oilfilm.CaseError, match="allowed together"):
        case.with_values({"friction.lubrication": "dry"})
    with pytest.raises(oilfilm.CaseError, match="unknown name"):
        oilfilm.load_case("6205_ceramic_dry_in_vacuum").with_values({"friction.dry_surface": "butter"})


def test_a_bare_surface_is_that_of_the_balls():
    case = oilfilm.load_case("6205_ceramic_dry_in_vacuum").with_values({"friction.dry_surface": None})
    assert case.dry.name == "silicon nitride"
    assert case.friction.coefficient == 0.7
    assert replace(case.dry, name="x").fed is False


def test_a_film_that_the_cage_transfers_is_the_friction_of_asperities():
    """Its coefficient stands for that of asperities, its range for that of their part."""
    changes = {"friction.dry_surface": "ptfe film", "friction.boundary_coefficient": None}
    case = oilfilm.load_case("6208_oil_supply").with_values(changes)
    film = load_dry_surface("ptfe film")
    assert case.friction.boundary == film.friction.value
    assert case.dry is None
    part = case.friction.assumptions(case.bearing)["asperity"]
    assert (part.low, part.high) == (0.5, 2.0)
    assert "ptfe film" in part.text
    own = case.with_values({"friction.boundary_coefficient": 0.07})
    assert own.friction.boundary == 0.07
