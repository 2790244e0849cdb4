"""Friction torque in cases and summaries."""

from __future__ import annotations

from math import exp, pi

import pytest

from oilfilm.bearing.torque.breakdown import NAMES
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.new_case import FirstOperation, case_of_designation
from oilfilm.cases.runs.bearing import run_case
from oilfilm.postprocess import summary
from oilfilm.postprocess.bearing.torque import torque_rows
from oilfilm.postprocess.report.bearing import torque_section

TEXT = """
schema_version = 1
[bearing]
name = "6208"
basic_static_rating_kN = 19.0
inner_ring_material = "bearing steel"
outer_ring_material = "bearing steel"
ball_material = "bearing steel"
bore_mm = 40.0
outside_diameter_mm = 80.0
[lubricant]
kinematic_viscosity_mm2_s = 20.0
density_kg_m3 = 870.0
pressure_viscosity_1_GPa = 18.0
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 2000.0
[ehl]
points = 65
"""


ALL = '[friction]\nmodels = "all"\n'


def torque_of(text):
    """With the models of papers beside the main ones."""
    document = summary(run_of(text))
    return document["torque_N_mm"], document


def run_of(text):
    """Likewise."""
    text = text.replace("[friction]\n", ALL) if "[friction]" in text else text + ALL
    return run_case(case_from_text(text, "case.toml"))


def test_models_of_papers_are_shown_where_they_are_asked_for():
    text = TEXT.replace("points = 65", 'film_maps = "none"')
    case = case_from_text(text, "case.toml")
    document = summary(run_case(case))
    assert tuple(document["torque_N_mm"]["models"]) == ("integrated", "skf", "palmgren", "coulomb")
    assert not any("models.yao" in message for message in document["messages"])
    models, _ = torque_of(text)
    assert set(models["models"]) == set(NAMES)
    shown = document["torque_N_mm"]["models"]
    assert shown == {name: models["models"][name] for name in shown}


@pytest.fixture(scope="module")
def radial_run():
    return run_of(TEXT.replace("points = 65", 'points = 65\nfilms = "solved"'))


@pytest.fixture(scope="module")
def radial(radial_run):
    document = summary(radial_run)
    return document["torque_N_mm"], document


def test_every_model_stands_side_by_side(radial):
    torque, document = radial
    models = torque["models"]
    assert models["skf"]["rolling"] == pytest.approx(47.77, abs=5e-3)  # the unit test of the model itself
    assert models["skf"]["sliding"] == pytest.approx(17.70, abs=5e-3)
    assert torque["model"] == "integrated"
    for name in ("integrated", "pure_rolling_lines", "skf", "houpert", "palmgren"):
        parts = [value for key, value in models[name].items() if key != "total"]
        assert models[name]["total"] == pytest.approx(sum(parts), rel=1e-9)
    for name in ("balanced_lines", "coulomb", "kakuta", "constant_coulomb"):
        assert models[name]["total"] > 0.0
    assert models["skf_lambda"]["total"] > 0.0  # by the typical roughness
    assert models["constant_coulomb"]["total"] == pytest.approx(
        0.07 / torque["coulomb_coefficient"] * models["pure_rolling_lines"]["total"], rel=1e-9
    )
    assert models["yao"]["total"] is None
    assert any(m.startswith("torque_N_mm.models.yao: null") for m in document["messages"])
    assert any("shear of the oil is assumed" in m for m in document["messages"])
    solved = [c for c in document["contacts"] if c["film_origin"] == "solved"]
    # both races of the loaded balls; the outer one of those whose gap the oil does not fill
    loaded, unfilled = (1, 2, 9), (4, 5, 6, 7)
    outer = {(ball, "outer") for ball in (*loaded, *unfilled)}
    assert {(c["ball"], c["race"]) for c in solved} == {(ball, "inner") for ball in loaded} | outer
    assert all(0.0 < c["traction_coefficient"] < 0.05 for c in solved)
    others = {(c["ball"], c["race"]): c for c in document["contacts"] if c not in solved}
    for ball in unfilled:
        assert others.pop((ball, "inner"))["film_origin"] is None
    assert {ball for ball, _ in others} == {3, 8}  # between two films, which fill the gap
    assert len(others) == 4 and all(c["film_origin"] == "atlas" for c in others.values())
    assert all(c["traction_coefficient"] is None for c in document["contacts"] if c not in solved)
    assert any(
        m.startswith("contacts.traction_coefficient: null where no film was solved") for m in document["messages"]
    )


def test_the_shaft_feeds_what_the_films_turn_into_heat(radial):
    """Balls in traction equilibrium: to 1e-6 of the heat; under the hypothesis the balance is far off, and is told."""
    torque, document = radial
    balance = torque["power_balance"]
    assert balance["traction_equilibrium"]
    assert balance["imbalance"] == pytest.approx(0.0, abs=1e-6)
    given = balance["heat_W"] + balance["resisted_W"]
    assert balance["shaft_W"] == pytest.approx(given, rel=1e-6)
    assert abs(balance["hypothesis_imbalance"]) > 1.0
    speed = 3000.0 * 2.0 * pi / 60.0
    of_contacts = torque["total"] - torque["parts"]["cage"]
    assert sum(torque["per_ball_N_mm"]) == pytest.approx(of_contacts, rel=1e-9)
    assert 1e-3 * of_contacts * speed == pytest.approx(balance["heat_W"], rel=1e-9)
    assert max(torque["per_ball_N_mm"]) == torque["per_ball_N_mm"][0]
    assert any("balls in traction equilibrium" in message for message in document["messages"])


def test_the_total_has_inlet_heating_and_replenishment_and_the_bound_stands_beside(radial, radial_run):
    torque, document = radial
    films = radial_run.torque.shear.films
    shear, filled = torque["inlet_shear_heating_factor"], torque["replenishment_factor"]
    assert 0.9 < shear < 1.0
    # SKF's formula by hand: n = 3000, nu = 20, d + D = 120, a low oil bath
    assert filled == pytest.approx(exp(-3e-8 * 20.0 * 3000.0 * 120.0 * (3.1 / 80.0) ** 0.5))
    whole = torque["flooded_isothermal"]
    assert torque["total"] < whole
    parts = torque["parts"]
    assert sum(parts.values()) == pytest.approx(torque["total"])
    # the layer of a track is that of its heaviest contact: it leaves this one its share, of light ones less
    for film in films[:2]:
        least = film.heated_moment * filled
        assert least < film.rolling_fraction < least + 0.006  # a starved inlet has less heat
    fractions = [film.rolling_fraction for film in films if film is not None]
    assert max(fractions[4:-2]) < 0.9 < min(fractions[:4])
    # what is taken away, but for the motion of the balls that changes with it: 0.09 % of the torque on 65 points
    moments = [(film.flooded_moment, film.rolling_moment) for film in films if film is not None]
    flooded, left = (sum(part) for part in zip(*moments, strict=True))
    taken = parts["rolling"] * (flooded / left - 1.0)
    assert taken > parts["rolling"] * (1.0 / (shear * filled) - 1.0)
    assert whole - torque["total"] == pytest.approx(taken, abs=0.002 * whole)
    assert any("law of solved contacts" in message and "low oil bath" in message for message in document["messages"])


def test_a_stated_bath_replenishes_wholly_and_grease_least(radial):
    base = TEXT.replace("points = 65", 'film_maps = "none"')
    totals = []
    for name in ("oil bath", "low oil bath", "grease"):
        torque, _ = torque_of(base + f'[friction]\nlubrication = "{name}"\n')
        totals.append(torque["total"])
        assert torque["replenishment_factor"] <= 1.0
    assert totals == sorted(totals, reverse=True)
    assert torque["replenishment_factor"] == pytest.approx(radial[0]["replenishment_factor"] ** 2)


def test_balls_that_their_inner_contact_cannot_drive_are_driven_by_the_cage():
    """50 N axial, 400 N radial: a few carry some newtons at the inner race, less than the oil's resistance takes."""
    text = TEXT.replace("inner_speed_rpm = 3000.0", "inner_speed_rpm = 9000.0")
    torque, document = torque_of(text.replace("radial_load_N = 2000.0", "radial_load_N = 400.0\naxial_load_N = 50.0"))
    assert torque["power_balance"]["traction_equilibrium"]
    assert torque["power_balance"]["imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert any("driven by the cage" in message for message in document["messages"])
    assert abs(torque["models"]["integrated"]["sliding"]) < 0.02 * torque["total"]


def test_asperities_of_rough_surfaces_rub():
    surface = "[surface]\ninner_ring_roughness_um = 0.5\nouter_ring_roughness_um = 0.5\nball_roughness_um = 0.1\n"
    torque, _ = torque_of(TEXT + surface)
    models = torque["models"]
    assert models["integrated"]["asperity"] > 0.0
    assert models["skf_lambda"]["sliding"] > models["skf"]["sliding"]
    assert models["skf_lambda"]["rolling"] == models["skf"]["rolling"]
    assert torque["power_balance"]["imbalance"] == pytest.approx(0.0, abs=1e-6)


def test_parts_that_a_friction_law_does_not_know_are_null_with_the_reason():
    law = '[friction]\ntraction = "four constants"\ntraction_maximum = 0.05\ntraction_maximum_slide = 0.03\n'
    surface = "[surface]\ninner_ring_roughness_um = 0.5\nouter_ring_roughness_um = 0.5\nball_roughness_um = 0.1\n"
    text = TEXT.replace("points = 65", 'film_maps = "none"') + law + "traction_limit = 0.03\n" + surface
    torque, document = torque_of(text)
    models, messages = torque["models"], document["messages"]
    assert torque["power_balance"]["traction_equilibrium"]
    assert models["integrated"]["curvature"] > 0.0
    for key in ("integrated.rolling", "integrated.asperity"):
        name, part = key.split(".")
        assert models[name][part] is None
        assert any(message.startswith(f"torque_N_mm.models.{key}: null, the friction law") for message in messages)
    assert any(m.startswith("torque_N_mm.models.skf_lambda: null, the friction law") for m in messages)


def test_factors_of_the_case_go_before_those_of_the_libraries():
    more = "[friction]\npalmgren_viscous_factor = 1.0\npalmgren_load_factor = 0.001\nfull_film_coefficient = 0.04\n"
    text = TEXT.replace("points = 65", 'film_maps = "none"') + more + "as_printed = true\n"
    torque, _ = torque_of(text)
    models = torque["models"]
    assert models["palmgren"]["load"] == pytest.approx(0.001 * 2000.0 * 60.0)
    assert models["palmgren"]["viscous"] == pytest.approx(1e-7 * 60000.0 ** (2 / 3) * 60.0**3)
    assert torque["coulomb_coefficient"] == pytest.approx(0.04, abs=1e-4)
    assert models["skf_as_printed"]["sliding"] == pytest.approx(0.5 * models["skf"]["sliding"])


def test_rolling_resistance_of_the_film_is_that_of_the_formula_within_a_half(radial):
    models = radial[0]["models"]
    assert models["integrated"]["rolling"] == pytest.approx(models["houpert"]["hydrodynamic"], rel=0.5)


def test_the_five_terms_with_their_inputs():
    more = "[friction]\nhysteresis_loss = 0.007\noil_fraction = 0.05\n[cage]\npocket_friction = 0.1\n"
    torque, _ = torque_of(TEXT + more)
    five = torque["models"]["yao"]
    assert all(five[part] is not None for part in ("ME", "MD", "MS", "MC", "ML"))
    assert five["ME"] > 0.0
    assert five["MS"] == 0.0
    assert torque["models"]["integrated"]["drag"] > 0.0


@pytest.mark.slow
def test_torque_over_the_supply_has_a_minimum():
    """Below it asperities, above it rolling resistance and churning; at more speed the same supply starves more."""
    base = TEXT.replace("points = 65", 'film_maps = "none"').replace("radial_load_N = 2000.0", "radial_load_N = 3000.0")
    base += "[surface]\ninner_ring_roughness_um = 0.2\nouter_ring_roughness_um = 0.2\nball_roughness_um = 0.02\n"
    flows, rubbed = (0.1, 0.3, 0.6, 1.0, 1.6, 3.0, 10.0), []
    for speed in (5000.0, 10000.0):
        totals = []
        for flow in flows:
            text = base.replace("3000.0\nradial", f"{speed}\nradial") + f"[friction]\nsupply_mL_min = {flow}\n"
            models = torque_of(text)[0]["models"]
            totals.append(models["starved"]["total"])
            assert sum(v for k, v in models["starved"].items() if k != "total") == pytest.approx(totals[-1])
            if flow == 0.6:
                rubbed.append(models["starved"]["asperity"])
        assert 0 < totals.index(min(totals)) < len(flows) - 1
    assert rubbed[0] < rubbed[1]


def test_without_film_maps_the_torque_is_that_of_films_without_a_solve(radial):
    """The model stays; within a tenth of that of the solved films and what their 65 points leave open."""
    torque, document = torque_of(TEXT.replace("points = 65", 'film_maps = "none"'))
    assert torque["model"] == radial[0]["model"] == "integrated"
    assert torque["total"] == torque["models"]["integrated"]["total"]
    solved = [c for c in radial[1]["contacts"] if c["rolling_moment_N_mm"] is not None]
    open_part = max(c["rolling_moment_uncertainty_N_mm"] / c["rolling_moment_N_mm"] for c in solved)
    assert 0.0 < open_part < 0.5
    open_part *= radial[0]["parts"]["rolling"]
    assert torque["total"] == pytest.approx(radial[0]["total"], abs=0.1 * torque["total"] + open_part)
    # balls 4 to 7 have a film at the outer race only
    assert any("films of the film atlas at 14 of 14 contacts" in message for message in document["messages"])
    assert all(c["traction_coefficient"] is None for c in document["contacts"])


def test_contact_seals_stand_beside_the_total_that_counts_them(tmp_path):
    """Open bearings have no such words."""
    text = TEXT.replace("points = 65", 'film_maps = "none"')
    for sealed in (True, False):
        results = run_case(case_from_text(text + f"[friction]\nsealed = {str(sealed).lower()}\n", "case.toml"))
        torque = summary(results)["torque_N_mm"]
        words = f", {torque['parts']['seal']:.4g} of it the contact seals" if sealed else "contact seals"
        assert (words in torque_rows(results)["friction torque"]) is sealed
        assert (words in torque_section(torque, tmp_path)) is sealed


def test_a_large_share_of_churning_stands_beside_the_total(tmp_path):
    """At 20 000 r/min a sixteenth of oil in the cavity makes a fifth of the torque, as the numbers themselves say."""
    text = TEXT.replace("points = 65", 'film_maps = "none"').replace("3000.0", "20000.0")
    results = run_case(case_from_text(text + "[friction]\noil_fraction = 0.06\n", "case.toml"))
    document = summary(results)
    torque = document["torque_N_mm"]
    share = torque["parts"]["drag"] / torque["total"]
    assert share > 0.2
    assert f", {share:.0%} of it churning" in torque_rows(results)["friction torque"]
    assert f", {share:.0%} of it churning" in torque_section(torque, tmp_path)
    note = next(message for message in document["messages"] if "% of it is churning" in message)
    assert "friction.oil_fraction, as the case gives it" in note
    assert f"half as much oil takes {0.5 * torque['parts']['drag']:.3g} N mm off" in note
    slow = run_case(case_from_text(text.replace("20000.0", "500.0"), "case.toml"))
    assert "churning" not in torque_rows(slow)["friction torque"]


def test_at_rest_nothing_rubs():
    torque, document = torque_of(TEXT.replace("inner_speed_rpm = 3000.0", "inner_speed_rpm = 0.0"))
    assert torque["total"] is None
    assert any("do not turn" in m for m in document["messages"])


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ('[cage]\npocket_friction = 0.1\nguided_by = "outer ring"\n', "cage.land_diameter_mm: missing"),
        ("[friction]\ncoefficient = 2.0\n", "friction.coefficient: found 2.0"),
    ],
)
def test_bad_friction(more, expected):
    with pytest.raises(CaseError, match=expected):
        case_from_text(TEXT + more, "case.toml")


def test_carreau_needs_its_constants():
    text = TEXT.replace("[operation]", 'rheology = "carreau-yasuda"\n[operation]')
    with pytest.raises(CaseError, match="carreau_modulus_MPa: missing"):
        case_from_text(text, "case.toml")
    full = text.replace("[operation]", "carreau_modulus_MPa = 7.0\ncarreau_exponent = 0.46\n[operation]")
    assert case_from_text(full, "case.toml").rheology.carreau_modulus == 7.0e6


@pytest.mark.slow
def test_range_of_a_slow_bearing_has_sharing_and_roughness():
    """A 6304 at 100 r/min, whose films part the surfaces only in part; the same at 6000 r/min has no such range."""
    document, slow, fast = rough_states()
    assert set(slow.ranges) == {"hysteresis", "cage", "drag", "inlet heat", "load sharing", "roughness"}
    for name in ("load sharing", "roughness"):
        assert slow.ranges[name].low < -0.05 * slow.total
        assert slow.ranges[name].high > 0.05 * slow.total
    assert slow.ranges["hysteresis"].high == pytest.approx(slow.models["integrated"].components["hysteresis"])
    assert fast.ranges["inlet heat"].high == -fast.ranges["inlet heat"].low > 0.0
    assert "load sharing" not in fast.ranges
    ends = document["total_range"]
    less = sum((document["total"] - part["low"]) ** 2 for part in ends["parts"].values()) ** 0.5
    assert ends["low"] == pytest.approx(document["total"] - less)
    assert ends["low"] < document["total"] < ends["high"]


def rough_states():
    """Summary and torque of a case as `oilfilm init` writes it, slow, and the torque of a fast one."""
    results = []
    for speed in (100.0, 6000.0):
        text = case_of_designation("6304", FirstOperation(speed=speed, radial_load=2000.0))
        text = text.replace('film_maps = "all"', 'film_maps = "none"').replace('temperature = "self-heated"', "")
        results.append(run_case(case_from_text(text, "case.toml")))
    return summary(results[0])["torque_N_mm"], *(one.torque for one in results)


@pytest.mark.slow
def test_balls_that_left_the_load_zone_are_named():
    """A 6306 C3 at 800 N radial, 150 N axial turns more easily than at 100 N: five balls ride between two films."""
    text = case_of_designation("6306 C3", FirstOperation(speed=1500.0, radial_load=800.0, axial_load=150.0))
    text = text.replace('film_maps = "all"', 'film_maps = "none"').replace('temperature = "self-heated"', "")
    document = summary(run_case(case_from_text(text, "case.toml")))
    (told,) = (message for message in document["messages"] if "have left the load zone" in message)
    each = document["torque_N_mm"]["per_ball_N_mm"]
    assert "balls 3–7 have left" in told
    assert f"{min(each):.3g} to {max(each[2:7]):.3g} N mm each" in told
    assert 3.0 * max(each[2:7]) < min(each[7], *each[:2])
