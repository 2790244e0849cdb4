"""Oil supply of a case: an inlet film or a flow, what is starved by it and what stays flooded."""

from __future__ import annotations

from dataclasses import replace
from io import StringIO
from math import cos, pi, radians

import pytest
from rich.console import Console

from oilfilm.cases import load_case
from oilfilm.cases.batch.sweep import read_sweep
from oilfilm.cases.format.case import case_from_text, case_of_document
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.bearing import run_case
from oilfilm.cases.runs.contact import run_contact
from oilfilm.cases.runs.heating import self_heated
from oilfilm.ehl.closed_form.starvation import starvation_factors
from oilfilm.postprocess import summary
from oilfilm.postprocess.bearing.torque import decay_group
from oilfilm.postprocess.bearing.write import bearing_table

SURFACE = "[surface]\ninner_ring_roughness_um = 0.2\nouter_ring_roughness_um = 0.2\nball_roughness_um = 0.02\n"
TEXT = (
    """
schema_version = 1
[bearing]
name = "6208"
basic_static_rating_kN = 19.0
inner_ring_material = "bearing steel"
outer_ring_material = "bearing steel"
ball_material = "bearing steel"
bore_mm = 40.0
outside_diameter_mm = 80.0
width_mm = 18.0
[operation]
inner_speed_rpm = 5000.0
radial_load_N = 3000.0
[ehl]
film_maps = "none"
[lubricant]
kinematic_viscosity_mm2_s = 20.0
density_kg_m3 = 870.0
pressure_viscosity_1_GPa = 18.0
"""
    + SURFACE
)


# of a bearing whose oil is all back when the next ball arrives, with as much at its inlets as without a bath
BATH = '[friction]\nlubrication = "oil bath"\n'
TEXT = TEXT.replace("[surface]", "flooded_layer_um = 100.0\n[surface]")


def with_film(layer, text=TEXT, more=""):
    return text.replace("[surface]", f"inlet_film_um = {layer}\n{more}[surface]")


def found(text):
    return summary(run_case(case_from_text(text, "case.toml")))


@pytest.fixture(scope="module")
def flooded():
    return found(TEXT + BATH)


def test_without_a_supply_all_is_flooded_and_said_to_be(flooded):
    assert flooded["case"]["lubricant"]["supply"] == "flooded"
    assert flooded["supply"].pop("kind") == "flooded"
    assert set(flooded["supply"].values()) == {None}
    for contact in flooded["contacts"]:
        assert contact["starved_film_share"] is None
        assert contact["flooded_film_central_um"] == contact["isothermal_film_central_um"]
    assert any(message.startswith("supply: flooded") for message in flooded["messages"])
    assert flooded["torque_N_mm"]["model"] == "integrated"


def test_oil_that_is_not_back_in_time_has_a_layer():
    """SKF's phi_rs of a low bath, 0.93, is the share of the moment behind it; so little missing hardly thins a film."""
    document = found(TEXT)
    supply = document["supply"]
    assert supply["kind"] == "replenishment"
    assert 0.99 < supply["film_share_least"] <= supply["film_share"] < 1.0
    assert supply["torque_N_mm"] is None
    assert any(message.startswith("supply: replenishment") for message in document["messages"])
    loaded = [contact for contact in document["contacts"] if contact["load_N"] > 500.0]
    assert all(0.99 < contact["starved_film_share"] < 1.0 for contact in loaded)


def test_a_thin_inlet_film_starves_films_and_torque():
    """All balls carry load at both races, flooded and starved the same."""
    text = TEXT.replace("radial_load_N", "axial_load_N")
    flooded, document = found(text + BATH), found(with_film(0.2, text) + BATH)
    torque, supply = document["torque_N_mm"], document["supply"]
    assert torque["model"] == "integrated"
    assert torque["replenishment_factor"] == 1.0  # the layer is stated
    assert torque["parts"]["rolling"] < 0.2 * flooded["torque_N_mm"]["parts"]["rolling"]
    assert torque["parts"]["asperity"] > flooded["torque_N_mm"]["parts"]["asperity"]
    assert torque["flooded_isothermal"] == pytest.approx(flooded["torque_N_mm"]["flooded_isothermal"], rel=1e-6)
    assert torque["total"] == supply["torque_N_mm"] < supply["flooded_torque_N_mm"]
    assert supply["flooded_torque_N_mm"] == pytest.approx(flooded["torque_N_mm"]["total"], rel=1e-6)
    assert supply["kind"] == "inlet film"
    assert document["case"]["lubricant"]["supply"] == "starved"
    assert 0.0 < supply["film_share_least"] < supply["film_share"] < 0.6
    known = films_of(flooded)
    assert len(known) == len(films_of(document)) == 18  # all that carry load
    for place, contact in films_of(document).items():
        starved_of(contact, known[place])
    assert supply["lambda_least"] == pytest.approx(min(c["lambda_ratio"] for c in films_of(document).values()))
    for name, model in torque["models"].items():  # all others are the flooded ones
        if name not in ("starved", "integrated"):
            assert model == flooded["torque_N_mm"]["models"][name]
    (told,) = (message for message in document["messages"] if message.startswith("supply: inlet film"))
    assert "films, lambda_ratio, maps, the total" in told
    assert "the other torque models are flooded" in told


def films_of(document):
    return {(c["ball"], c["race"]): c for c in document["contacts"] if c["film_origin"] == "atlas"}


def starved_of(contact, whole, shift=1e-6):
    """Films of a starved contact beside those of the flooded one, its load the same within a shift."""
    share = contact["starved_film_share"]
    load = whole["load_N"]
    assert contact["load_N"] == pytest.approx(load, rel=shift)
    assert contact["film_minimum_um"] <= contact["film_central_um"] < contact["isothermal_film_central_um"]
    at_load = whole["flooded_film_central_um"] * (load / contact["load_N"]) ** 0.09  # the film's law around it
    assert contact["flooded_film_central_um"] == pytest.approx(at_load, rel=1e-6 + 0.01 * shift)
    cold = share * contact["flooded_film_central_um"]
    assert contact["isothermal_film_central_um"] == pytest.approx(cold)
    assert whole["inlet_heat_share"] * cold < contact["film_central_um"] < cold  # a starved inlet has less heat
    left = contact["film_minimum_um"] / whole["film_minimum_um"]
    assert 0.9 * share < left < 1.7 * share
    assert contact["lambda_ratio"] == pytest.approx(left * whole["lambda_ratio"])


def test_a_thin_inlet_film_leaves_no_second_film_to_light_balls(flooded):
    """Flooded, the oil fills the gap of balls out of load and presses them to both races; a thin layer does not."""
    document = found(with_film(0.2) + BATH)
    light = {3, 4, 5, 6, 7, 8}
    whole, left = films_of(flooded), films_of(document)
    assert len(whole) == 18
    assert {place for place in whole if place not in left} == {(ball, "inner") for ball in light}
    for (ball, race), contact in left.items():
        known = whole[ball, race]
        if ball not in light:  # loads shift by what the light balls push the ring
            starved_of(contact, known, shift=0.01)
            continue
        assert contact["load_N"] < known["load_N"]  # that of the ball's own speed is left
        assert contact["load_N"] == pytest.approx(known["load_N"] - whole[ball, "inner"]["load_N"])
        cold = contact["starved_film_share"] * contact["flooded_film_central_um"]
        assert contact["isothermal_film_central_um"] == pytest.approx(cold)
        assert contact["film_central_um"] < 0.2 < known["film_central_um"]
        assert contact["lambda_ratio"] < known["lambda_ratio"]
    for state in (flooded, document):  # the inner contacts together hold the load
        inner = [c for c in state["contacts"] if c["race"] == "inner"]
        held = sum(c["load_N"] * cos(radians(c["azimuth_deg"])) for c in inner)
        assert held == pytest.approx(3000.0, rel=1e-6)
    told = "inner race, balls 3–8: film null, the oil does not fill the gap between ball and race"
    assert told in document["messages"]
    torque, bound = document["torque_N_mm"], flooded["torque_N_mm"]
    assert torque["parts"]["rolling"] < 0.2 * bound["parts"]["rolling"]
    assert torque["flooded_isothermal"] < bound["flooded_isothermal"]  # without the balls between two films
    assert document["supply"]["lambda_least"] == pytest.approx(min(c["lambda_ratio"] for c in left.values()))


def test_ample_oil_is_the_flooded_limit():
    document = found(with_film(1000.0) + '[friction]\nmodels = "all"\n')
    shares = {contact["starved_film_share"] for contact in document["contacts"]} - {None}
    assert shares == {1.0}
    assert document["supply"]["torque_N_mm"] == pytest.approx(document["supply"]["flooded_torque_N_mm"], rel=1e-12)
    assert document["torque_N_mm"]["models"]["starved"]["rolling"] == pytest.approx(
        document["torque_N_mm"]["models"]["houpert"]["hydrodynamic"], rel=1e-12
    )
    assert any(message.startswith("supply: ample") for message in document["messages"])


def test_the_word_flooded_keeps_the_total(flooded):
    document = found(with_film(0.2, more='supply = "flooded"\n') + BATH)
    assert document["torque_N_mm"]["total"] == flooded["torque_N_mm"]["total"]
    assert document["torque_N_mm"]["model"] == "integrated"
    assert document["supply"]["film_share"] < 0.6
    assert document["contacts"] == flooded["contacts"]  # and with it their films
    assert any("keeps films and total flooded" in message for message in document["messages"])


def test_solved_films_are_what_a_supply_takes_its_share_of():
    """Both films converged; far from scarce the solved ones stay, and the integrated torque stands beside."""
    ehl = 'points = 65\nstarvation = "none"\nfilm_maps = [0.0]'
    text = TEXT.replace('film_maps = "none"', ehl).replace("radial_load_N", "axial_load_N")
    document = found(with_film(50.0, text))
    solved, formula = document["contacts"][0], document["contacts"][2]
    for one, origin in ((solved, "solved"), (formula, "atlas")):
        assert one["film_origin"] == origin
        assert 0.99 < one["starved_film_share"] < 1.0
        assert one["isothermal_film_central_um"] == pytest.approx(one["flooded_film_central_um"], rel=2e-3)
    assert any("solved for 2, else formulas" in message for message in document["messages"])


def test_a_flow_tells_its_films_and_the_oil_in_the_cavity():
    document = found(TEXT + "[friction]\nsupply_mL_min = 0.6\n")
    supply = document["supply"]
    assert supply["kind"] == "flow"
    assert 0.0 < supply["film_share_least"] <= supply["film_share"] < 1.0
    assert supply["lambda_least"] > 0.0
    assert 0.0 < supply["oil_fraction"] < 0.1
    torque = document["torque_N_mm"]
    assert torque["model"] == "integrated"
    assert torque["total"] < torque["flooded_isothermal"]
    assert torque["parts"]["drag"] > 0.0
    assert supply["torque_N_mm"] < supply["flooded_torque_N_mm"]


@pytest.mark.parametrize(("flow", "told"), [(0.001, True), (1000.0, False)])
def test_a_life_by_the_viscosity_of_oil_that_does_not_come_is_a_warning(flow, told):
    """A film of a thousandth of the flooded one, kappa 1.5 and a_ISO of clean oil beside it were no word's worth."""
    text = TEXT.replace("density_kg_m3", "contamination_factor = 0.5\ndensity_kg_m3")
    document = found(text + f"[friction]\nsupply_mL_min = {flow}\n")
    assert any("those of flooded inlets" in message for message in document["warnings"]) is told


def test_a_flow_of_nothing_is_refused():
    """It ended in a division by zero, or in a torque of nan."""
    with pytest.raises(CaseError, match="supply_mL_min: found 0"):
        found(TEXT + "[friction]\nsupply_mL_min = 0.0\n")


def test_a_typical_roughness_stands_for_one_that_is_not_given(flooded):
    document = found(with_film(0.2).replace(SURFACE, ""))
    assert document["torque_N_mm"]["parts"]["rolling"] < 0.2 * flooded["torque_N_mm"]["parts"]["rolling"]
    assert document["supply"]["film_share"] < 0.6
    assert document["supply"]["lambda_least"] > 0.0
    assert document["torque_N_mm"]["models"]["starved"]["total"] > 0.0
    assert any("rms roughness assumed, typical: races 0.05 um (0.02 to 0.15)" in one for one in document["messages"])


def test_at_rest_nothing_is_starved():
    document = found(with_film(0.2).replace("5000.0", "0.0"))
    assert document["supply"].pop("kind") == "inlet film"
    assert set(document["supply"].values()) == {None}
    assert any(message.startswith("supply: null") for message in document["messages"])


def test_the_terminal_tells_the_supply():
    from rich.console import Console

    from oilfilm.postprocess.bearing.write import bearing_table

    console = Console(width=80)
    with console.capture() as capture:
        results = run_case(case_from_text(with_film(0.2), "case.toml"))
        console.print(bearing_table(results))
    text = capture.get()
    torque = summary(results)["torque_N_mm"]
    total, low, high = torque["total"], torque["total_range"]["low"], torque["total_range"]["high"]
    assert low < total < high
    assert f"{total:.4g} N mm (integrated films; {low:.4g} to {high:.4g})" in text
    assert "inlet film: loaded films" in text


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (with_film(0.2) + "[friction]\nsupply_mL_min = 1.0\n", "found together with friction.supply_mL_min"),
        (TEXT.replace("[surface]", 'supply = "starved"\n[surface]'), "lubricant.supply: found"),
        (with_film(-1.0), "lubricant.inlet_film_um: found -1"),
    ],
)
def test_bad_supply(text, expected):
    with pytest.raises(CaseError, match=expected):
        case_from_text(text, "case.toml")


CONTACT = """
schema_version = 1
[contact]
load_N = 15.0
radius_x_mm = 12.5
radius_y_mm = 12.5
reduced_modulus_GPa = 110.0
entrainment_speed_m_s = 0.09
[ehl]
points = 65
[lubricant]
viscosity_mPa_s = 40.0
pressure_viscosity_1_GPa = 20.0
density_kg_m3 = 870.0
"""


def contact(text):
    """With a share by formula where there is a layer."""
    if "inlet_film_um" in text:
        text = text.replace("points = 65", 'points = 65\nstarvation = "none"')
    return summary(run_contact(case_from_text(text, "case.toml")))


def test_a_single_contact_at_an_inlet_film():
    """The law of starvation beside the flooded film; ample oil leaves all of it."""
    flooded = contact(CONTACT)
    assert flooded["starved_film_share"] is None
    assert any("supply is flooded" in message for message in flooded["messages"])
    ample = contact(CONTACT + "inlet_film_um = 1e4\n")
    assert ample["starved_film_share"] == pytest.approx(1.0, abs=1e-12)
    assert ample["starved_film_central_um"] == pytest.approx(flooded["film_central_um"], rel=1e-12)
    assert ample["film_central_um"] == flooded["film_central_um"]
    assert any("starved_film_... alone" in message for message in ample["messages"])
    even = contact(CONTACT + f"inlet_film_um = {packed(flooded)!r}\n")
    shares = starvation_factors(flooded["moes_M"], flooded["moes_L"], 1.0, 1.0)
    assert even["starved_film_share"] == pytest.approx(shares.central.value, rel=2e-3)
    left = shares.minimum.value * flooded["film_minimum_um"]
    assert even["starved_film_minimum_um"] == pytest.approx(left, rel=2e-3)


def packed(document):
    """Flooded film at ambient density [um]."""
    pressure = document["hertz_pressure_GPa"]
    return (1.0 + 0.6 * pressure / (1.0 + 1.7 * pressure)) * document["film_central_um"]


def test_the_law_is_taken_as_the_oil_meets_the_ellipse():
    """The same ellipse entrained along its short and its long axis."""
    wide = CONTACT.replace("radius_y_mm = 12.5", "radius_y_mm = 125.0") + "inlet_film_um = 0.1\n"
    along, across = (contact(text) for text in (wide, wide.replace("[ehl]", "entrainment_angle_deg = 90.0\n[ehl]")))
    m, l = along["moes_M"], along["moes_L"]
    by_law = starvation_factors(m, l, 0.1, 0.1 / packed(along)).central.value
    assert along["starved_film_share"] == pytest.approx(by_law, rel=5e-3)
    by_law = starvation_factors(m * 0.1**1.25, l * 0.1**0.25, 10.0, 0.1 / packed(across)).central.value
    assert across["starved_film_share"] == pytest.approx(by_law, rel=5e-3)


def by_law(layer, more="", points=65):
    return solved(layer, more, points).replace('"solved"', '"tabulated"')


def test_films_of_a_bearing_by_the_law():
    """Untold the law; flooded films beside, the rolling moment less."""
    document = found(by_law(0.2))
    default = found(by_law(0.2).replace('starvation = "tabulated"\n', ""))
    assert default["case"]["ehl"]["starvation"] == "tabulated"
    assert default["contacts"] == document["contacts"]
    assert document["torque_N_mm"]["model"] == "integrated"
    flooded = found(by_law(0.2).replace('"tabulated"', '"none"'))
    integrated = [one["torque_N_mm"]["models"]["integrated"] for one in (document, flooded)]
    # the law acts on the moment in the box of the film, or on that of the oil up to the layer of a flooded inlet
    assert integrated[0]["rolling"] == pytest.approx(integrated[1]["rolling"], rel=0.2)
    for one, other in zip(document["contacts"], flooded["contacts"], strict=True):
        if one["film_central_um"] is None:
            continue
        assert one["flooded_film_central_um"] == other["flooded_film_central_um"]
        assert one["film_central_um"] < min(one["flooded_film_central_um"], 0.2)
        assert one["film_minimum_um"] <= one["film_central_um"]
        # beside a flooded film the oil's density is that at Hertz' pressure, which light contacts do not reach
        rel = 0.02 if one["load_N"] > 100.0 else 0.2
        assert other["film_central_um"] == pytest.approx(one["film_central_um"], rel=rel)
        assert one["film_central_uncertainty_um"] > 0.0
        assert one["meniscus_position"] is None and 0.0 < one["rolling_moment_ratio"] < 0.5
    assert any("law of starvation" in message for message in document["messages"])


def test_groups_have_no_inlet_film():
    text = (
        "schema_version = 1\n[contact]\nmoes_M = 20.0\nmoes_L = 10.0\n[lubricant]\nviscosity_mPa_s = 20.0\n"
        "pressure_viscosity_1_GPa = 18.0\ninlet_film_um = 1.0\n"
    )
    with pytest.raises(CaseError, match=r"found together with contact\.moes_M"):
        case_from_text(text, "case.toml")


def points(sweep, **wanted):
    """Cases of a shipped sweep at given values of its keys' last parts, in the order of the sweep."""
    for point in read_sweep(sweep).points:
        values = {key.rpartition(".")[2]: value for key, value in point.values.items()}
        if all(values[key] == value for key, value in wanted.items()):
            yield case_of_document(point.document)


@pytest.mark.slow
def test_the_sweep_over_the_supply_has_a_minimum_under_the_largest_load():
    cases = points("6208_over_oil_supply", radial_load_N=3000.0, inner_speed_rpm=5000.0)
    torques = [summary(run_case(case))["torque_N_mm"]["total"] for case in cases]
    assert 0 < torques.index(min(torques)) < len(torques) - 1


@pytest.mark.slow
def test_the_sweep_over_the_inlet_film_ends_flooded():
    shares, torques = [], []  # [-], [N mm]
    for case in points("6208_over_inlet_film", radial_load_N=900.0):
        supply = summary(run_case(case))["supply"]
        shares.append(supply["film_share"])
        torques.append(supply["torque_N_mm"] / supply["flooded_torque_N_mm"])
    assert shares == sorted(shares)
    assert shares[0] < 0.2
    assert 0.99 < shares[-1] < 1.0  # five to ten times what the films take along
    assert 0.7 < torques[-1] < 1.0  # the thick films under balls that carry centrifugal force alone are starved yet


def test_a_sweep_draws_supply_and_temperature_a_line_for_each_load_and_speed():
    """Films over the flooded ones have a line for each of the eight combinations of load and speed, named beside."""
    from matplotlib.figure import Figure

    from oilfilm.postprocess.batch.plots import draw_batch, quantities
    from oilfilm.postprocess.batch.results import BatchPoint, BatchResults, result_names, varied_keys

    assert {"supply.film_share", "supply.lambda_least", "self_heating.temperature_C"} <= set(result_names("run"))
    sweep = read_sweep("6208_over_oil_supply")
    assert len(sweep.points) == 72
    share = {"contacts": [], "torque_N_mm": {"total": 50.0}}
    made_up = tuple(
        BatchPoint(
            number=p.number,
            block=p.block,
            values=p.values,
            case=p.resolved,
            key=p.key,
            resumed=False,
            status="done",
            message=None,
            summary=share | {"converged": True, "supply": {"film_share": p.values["friction.supply_mL_min"] / 2.0}},
        )
        for p in sweep.points
    )
    results = BatchResults(
        version="0", title="", case=sweep.case, sweep="", keys=sweep.keys, points=made_up, plot=sweep.plot
    )
    figure = Figure(layout="constrained")
    draw_batch(figure, results, list(varied_keys(results).values()), quantities(results))
    right = figure.axes[1]
    assert right.get_ylabel() == "film share [-]"
    lines = [line for line in right.get_lines() if len(line.get_xdata()) == 9]
    assert len(lines) == 8
    assert all(list(line.get_ydata()) == [x / 2.0 for x in line.get_xdata()] for line in lines)
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "radial load [N]" in texts
    assert len([text for text in texts if text.replace(".", "").isdigit()]) == 6  # four loads, two speeds


@pytest.mark.slow
def test_more_supply_rubs_less_and_a_hundred_times_as_much_oil_cools():
    """Fig. 5 of Yao et al. (2022), 5000 r/min, 900 N: films fill and rub less; only the other oil cools by far."""
    alone = list(points("6208_self_heating_over_supply", radial_load_N=900.0, inner_speed_rpm=5000.0))
    cooled = list(points("6208_self_heating_with_cooling_oil"))
    first, last, cold_first, cold_last = (
        self_heated(case).balance.temperature for case in (alone[0], alone[-1], cooled[0], cooled[-1])
    )
    assert first - 8.0 < last < first - 3.0
    assert cold_last < cold_first < last - 3.0


def solved(layer, more="", points=257):
    ehl = f'film_maps = "all"\nstarvation = "solved"\npoints = {points}\n{more}'
    return with_film(layer).replace('film_maps = "none"\n', ehl)


@pytest.mark.slow
def test_films_of_a_bearing_solved_behind_a_layer():
    """Each of them its own, and the total torque is that of these films."""
    document = found(solved(0.2))
    assert document["converged"] and document["torque_N_mm"]["total"] is not None
    assert document["torque_N_mm"]["model"] == "integrated"
    loaded = [c for c in document["contacts"] if c["film_central_um"] is not None]
    assert len(loaded) >= 6
    for contact in loaded:
        share = contact["isothermal_film_central_um"] / contact["flooded_film_central_um"]
        assert contact["film_central_um"] < contact["isothermal_film_central_um"]
        assert contact["starved_film_share"] == pytest.approx(share)
        assert share < 1.03 * contact["inlet_ratio"] and contact["film_central_um"] < 0.2
        assert 0.0 < contact["rolling_moment_ratio"] < 1.0 and contact["meniscus_position"] < -0.9
    unsolved = [c for c in document["contacts"] if c["film_central_um"] is None]
    assert all(c["flooded_film_central_um"] is c["inlet_ratio"] is None for c in unsolved)
    assert any("films solved behind it" in message for message in document["messages"])
    flooded_films = found(solved(0.2).replace('"solved"', '"none"'))
    assert flooded_films["torque_N_mm"]["flooded_isothermal"] > document["torque_N_mm"]["total"]
    # films and rolling moments by the formulas of starvation
    assert flooded_films["torque_N_mm"]["total"] == pytest.approx(document["torque_N_mm"]["total"], rel=0.15)


@pytest.mark.slow
def test_the_same_layer_three_ways():
    """Films solved behind it, by the law, and flooded with the law's beside: one bound, one kappa, one film shown."""
    ways = [solved(0.2, points=129).replace('"solved"', f'"{how}"') for how in ("solved", "tabulated", "none")]
    results = [run_case(case_from_text(way, "case.toml")) for way in ways]
    documents = [summary(one) for one in results]
    behind, by_law, beside = documents
    torques = [document["torque_N_mm"] for document in documents]
    flooded = beside["torque_N_mm"]["flooded_isothermal"]
    assert [one["flooded_isothermal"] for one in torques] == pytest.approx([flooded] * 3)
    assert [one["total"] for one in torques] == pytest.approx([by_law["torque_N_mm"]["total"]] * 3, rel=0.1)
    flooded = beside["supply"]["flooded_torque_N_mm"]
    assert [one["supply"]["flooded_torque_N_mm"] for one in documents] == pytest.approx([flooded] * 3)
    assert behind["supply"]["torque_N_mm"] == behind["torque_N_mm"]["total"] < 0.5 * flooded
    for own, other in zip(by_law["contacts"], beside["contacts"], strict=True):
        if own["film_central_um"] is not None and own["resolved"]:
            # the law beside takes the oil of the flooded film to be as dense as under Hertz' pressure
            close = 1e-3 if own["load_N"] > 100.0 else 0.12
            assert own["film_central_um"] == pytest.approx(other["film_central_um"], rel=close)
            assert own["kappa"] == pytest.approx(own["lambda_ratio"] ** 1.3)  # not starved a second time
            assert other["kappa"] == pytest.approx(other["lambda_ratio"] ** 1.3)
            assert abs(own["damping_ratio"]) < min(0.1, own["damping_ratio_uncertainty"])
    least = min(contact["lambda_ratio"] for contact in beside["contacts"] if contact["starved_film_share"])
    assert f"{least:.3g}" in printed(results[2])


def printed(results):
    """The terminal's table."""
    console = Console(width=80, record=True, file=StringIO())
    console.print(bearing_table(results))
    return console.export_text()


@pytest.mark.parametrize(
    ("text", "key"),
    [
        (TEXT.replace('film_maps = "none"', 'starvation = "solved"'), "ehl.starvation"),
        (solved(0.0), "lubricant.inlet_film_um"),
        (solved(0.2, "certify = true\n"), "ehl.certify"),
        (solved(0.2, 'film_model = "shear-thinning"\n'), "ehl.starvation"),
        (solved(0.2).replace('"solved"', '"flooded"'), "ehl.starvation"),
        (with_film(0.2).replace("inlet_film_um", "inlet_film_dimensionless"), "lubricant.inlet_film_dimensionless"),
    ],
)
def test_a_layer_that_cannot_be_solved_is_refused(text, key):
    with pytest.raises(CaseError) as refusal:
        case_from_text(text, "case.toml")
    assert key in str(refusal.value)


def test_balls_of_next_to_no_load_do_not_run_away():
    """At 1 r/min centrifugal force presses with 1e-8 N: no film, and nothing that holds the ball but the cage."""
    case = load_case("6208_oil_supply")
    slow = replace(case.operation, inner_speed=2.0 * pi / 60.0, force=(100.0, 1000.0, 0.0))
    torque = run_case(replace(case, operation=slow)).torque
    assert torque.total == pytest.approx(torque.starved.total, rel=0.3)


def test_a_flow_gives_a_band_and_the_films_after_it_stops():
    """The ends of the band enclose the numbers at the share given; the decay begins at the film of the supply."""
    document = load_case("6208_oil_supply").document
    changed = {**document["friction"], "supply_decay_s": 10.0, "supply_track_share": 0.3}
    results = run_case(case_of_document({**document, "friction": changed}))
    found = summary(results)
    supply, decay = found["supply"], found["decay"]
    assert decay_group(results).variables["film_fraction"][1][-1] == decay["final_share"]  # as it is written
    assert (supply["track_share_low"], supply["track_share_high"]) == (0.1, 0.5)
    assert supply["film_share_low"] < supply["film_share"] < supply["film_share_high"]
    assert supply["lambda_least_low"] < supply["lambda_least"] < supply["lambda_least_high"]
    assert any("a band" in message for message in found["messages"])
    assert (decay["ball"], decay["race"], decay["loss"]) == (1, "inner", 0.028)
    assert 0.0 < decay["half_time_s"] < 1.0
    assert decay["final_share"] == 0.0


@pytest.mark.parametrize("solved", [False, True])
def test_a_band_of_no_width_is_the_torque(solved):
    """Both ends are of the model and the films of the total, also where those were solved behind their layers."""
    document = load_case("6208_oil_supply").document
    ends = {f"supply_track_share_{end}": 0.3 for end in ("least", "most")}
    changed = {**document, "friction": {**document["friction"], "supply_track_share": 0.3, **ends}}
    if solved:
        changed["ehl"] = {"film_maps": [0.0], "points": 129, "starvation": "solved"}
    with pytest.raises(CaseError, match="supply_track_share_least"):
        case_of_document(changed)
    changed["friction"] |= {"supply_track_share_most": 0.3 + 1e-12}
    found = summary(run_case(case_of_document(changed)))
    total, supply = found["torque_N_mm"]["total"], found["supply"]
    assert found["torque_N_mm"]["model"] == "integrated"
    assert supply["torque_N_mm"] == total
    assert supply["torque_low_N_mm"] == total
    assert supply["torque_high_N_mm"] == pytest.approx(total, rel=0.02 if solved else 1e-8)  # law beside solution
    assert supply["flooded_torque_N_mm"] > 1.2 * total
    wide = {**changed, "friction": {**changed["friction"], **ends, "supply_track_share_most": 0.6}}
    band = summary(run_case(case_of_document(wide)))["supply"]
    assert abs(band["torque_high_N_mm"] / total - 1.0) > 0.05


@pytest.mark.parametrize("oil", [1.0, 0.25, 0.0])
def test_a_land_that_runs_dry(oil):
    """Oil shears by Petroff on its share, the rest rubs under weight and play; the power balances."""
    document = load_case("6208_oil_supply").document
    land = {"land_oil_share": oil, "land_friction": 0.2, "mass_g": 12.0, "pocket_friction": 0.0}
    found = summary(run_case(case_of_document({**document, "cage": {**document["cage"], **land}})))
    assert found["power_balance"]["relative_error"] < 1e-6
    speed = 2.0 * pi / 60.0
    inner, cage = 5000.0 * speed, found["cage_speed_rpm"] * speed
    viscous = 0.0261 * 2.0 * pi * 0.034**3 * 0.006 / 200e-6 * cage * oil
    rub = 0.2 * (1.0 - oil) * 0.034 * 0.012 * (9.80665 + 200e-6 * cage**2)
    wanted = 1e3 * (viscous + rub) * cage / inner
    assert found["torque_N_mm"]["parts"]["cage"] == pytest.approx(wanted, rel=0.02)  # the balls slip


@pytest.mark.parametrize(
    ("land", "key"),
    [
        ({"land_oil_share": 0.5}, "cage.land_friction"),
        ({"land_oil_share": 0.5, "land_friction": 0.1}, "cage.mass_g"),
        ({"land_oil_share": 0.5, "land_friction": 0.1, "mass_g": 9.0, "guided_by": "balls"}, "cage.land_oil_share"),
    ],
)
def test_what_a_dry_land_needs(land, key):
    document = load_case("6208_oil_supply").document
    cage = {**document["cage"], **land}
    with pytest.raises(CaseError, match=key):
        case_of_document({**document, "cage": {k: v for k, v in cage.items() if k in land or k in document["cage"]}})


def test_a_dry_land_belongs_to_a_cage_with_pockets():
    """Without the pockets' friction no cage brakes a quasi-static bearing: the key would be without effect."""
    document = load_case("6208_oil_supply").document
    cage = {k: v for k, v in document["cage"].items() if k != "pocket_friction"}
    dry = {"land_oil_share": 0.5, "land_friction": 0.1, "mass_g": 9.0}
    with pytest.raises(CaseError, match=r"cage\.land_oil_share"):
        case_of_document({**document, "cage": {**cage, **dry}})


@pytest.mark.parametrize("name", ["supply_track_share_least", "supply_track_share_most"])
def test_a_band_needs_a_flow(name):
    with pytest.raises(CaseError, match=name):
        case_from_text(TEXT + f"[friction]\n{name} = 0.2\n", "case")


@pytest.mark.parametrize("starvation", ["solved", None])
def test_no_film_solved_behind_a_layer_is_said(starvation):
    """`film_maps = "none"` leaves nothing to be solved: the films are those of formulas, and a message says so."""
    document = load_case("6208_oil_supply").document
    changed = {**document["ehl"]} | ({"starvation": starvation} if starvation else {})
    found = summary(run_case(case_of_document({**document, "ehl": changed})))
    told = [message for message in found["messages"] if "solves no film here" in message]
    assert len(told) == (1 if starvation else 0)


@pytest.mark.parametrize("flow", [0.6, 500.0])
def test_a_cavity_full_of_oil_is_said(flow):
    document = load_case("6208_oil_supply").document
    changed = {**document["friction"], "supply_mL_min": flow}
    found = summary(run_case(case_of_document({**document, "friction": changed})))
    assert any("counts as full" in message for message in found["messages"]) == (found["supply"]["oil_fraction"] >= 1.0)
    assert (found["supply"]["oil_fraction"] >= 1.0) == (flow > 100.0)
