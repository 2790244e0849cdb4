"""Life, fits and temperatures in case files and in the summary."""

from __future__ import annotations

from dataclasses import replace

import pytest

from oilfilm.cases import load_case, run_case
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.postprocess import summary
from oilfilm.postprocess.bearing.summary import duty_cycle_rows, rating_rows

CASE = """\
schema_version = 1
[bearing]
name = "6208"
[lubricant]
viscosity_mPa_s = 26.1
pressure_viscosity_1_GPa = 18.0
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 3000.0
[ehl]
film_maps = "none"
"""
WARM = "[temperatures]\ninner_ring_C = 60.0\nouter_ring_C = 50.0\nball_C = 55.0\n"


def case(text):
    return case_from_text(text, "case.toml")


def faults(text):
    with pytest.raises(CaseError) as caught:
        case(text)
    return str(caught.value)


@pytest.fixture(scope="module")
def life():
    return summary(run_case(load_case("6208_life")))


def test_life_in_the_summary(life):
    block = life["life"]
    assert block["modified_reference_rating_Mrev"] == pytest.approx(
        block["a_iso"] * block["basic_reference_rating_Mrev"]
    )
    expected = (1e3 * block["basic_dynamic_rating_kN"] / block["dynamic_equivalent_load_N"]) ** 3
    assert block["basic_reference_rating_Mrev"] == pytest.approx(expected)
    assert life["clearance"]["operating_um"] == pytest.approx(13.0)
    assert life["clearance"]["initial_um"] is None
    assert any(message.startswith("clearance: ") for message in life["messages"])


def test_a_ceramic_bearing_has_no_life_and_says_so():
    results = run_case(load_case("6208_full_ceramic_warm"))
    found = summary(results)
    assert rating_rows(results)["rating life"].startswith("none: the standards rate rings of hardened bearing steel")
    keys = ("basic_reference_rating_Mrev", "modified_reference_rating_Mrev", "a_iso", "kappa")
    assert [found["life"][key] for key in keys] == [None] * 4
    assert any(message.startswith("life: null, the standards rate rings of") for message in found["messages"])


def test_the_equilibrium_has_the_operating_clearance():
    warm = load_case("6208_full_ceramic_warm")
    assert warm.bearing.diametral_clearance == warm.clearance.operating < warm.clearance.initial
    assert warm.document["bearing"]["diametral_clearance_um"] == pytest.approx(1e6 * warm.clearance.initial)
    found = summary(run_case(warm))["clearance"]
    changes = ("inner_fit_um", "outer_fit_um", "thermal_um", "centrifugal_um")
    assert found["initial_um"] + sum(found[key] for key in changes) == pytest.approx(found["operating_um"])


def test_ratings_and_angle_of_the_case():
    text = CASE.replace(
        'name = "6208"', 'name = "6208"\nbasic_dynamic_rating_kN = 32.5\nnominal_contact_angle_deg = 5.0'
    )
    found = summary(run_case(case(text)))["life"]
    assert found["basic_dynamic_rating_kN"] == pytest.approx(32.5)
    assert found["nominal_contact_angle_deg"] == pytest.approx(5.0)
    assert load_case("hirano_7000C").rating.nominal_contact_angle == pytest.approx(0.2617994)


def test_shaft_and_housing_follow_their_rings():
    seats = "[fit]\ninner_ring_interference_um = 10.0\nhousing_outside_diameter_mm = 120.0\n"
    same = WARM + "shaft_C = 60.0\nhousing_C = 50.0\n"
    one, two = case(CASE + seats + WARM), case(CASE + seats + same)
    assert one.clearance == two.clearance
    assert one.clearance.mounted < one.clearance.initial
    hot = case(CASE + seats + WARM + "shaft_C = 90.0\n")
    assert hot.clearance.operating < one.clearance.operating
    assert set(one.document["materials"]) == {"bearing steel"}


def test_nothing_changes_at_the_reference():
    at_20 = "[temperatures]\ninner_ring_C = 20.0\nouter_ring_C = 20.0\nball_C = 20.0\n"
    slow = case(CASE.replace("3000.0\nradial", "0.0\nradial") + "[fit]\n" + at_20)
    assert slow.clearance.operating == slow.clearance.mounted == slow.clearance.initial


def test_own_materials_inherit_from_the_library_of_the_same_name():
    own = '[materials."bearing steel"]\nyoungs_modulus_GPa = 210.0\npoisson_ratio = 0.3\ndensity_kg_m3 = 7800.0\n'
    material = case(CASE + own).bearing.ball_material
    assert material.kind.value == "bearing steel"
    assert material.thermal_expansion == pytest.approx(12e-6)
    other = case(CASE + own + 'kind = "other"\nthermal_expansion_um_m_K = 5.0\n').bearing.ball_material
    assert other.kind.value == "other"
    assert other.thermal_expansion == pytest.approx(5e-6)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (CASE + "[fit]\nouter_ring_interference_um = 5.0\n", "fit.housing_outside_diameter_mm"),
        (CASE + "[fit]\nshaft_bore_mm = 40.0\n", "less than the bore of the bearing, 40 mm"),
        (CASE + "[fit]\nhousing_outside_diameter_mm = 80.0\n", "more than the outside diameter of the bearing, 80 mm"),
        (CASE + '[fit]\nshaft_material = "bearing stel"\n', "bearing steel"),
        (CASE + "[temperatures]\ninner_ring_C = 60.0\nouter_ring_C = 50.0\n", "temperatures.ball_C"),
        (CASE + WARM.replace("ball_C", "balls_C"), "ball_C"),
        (CASE.replace("[lubricant]", "[lubricant]\ncontamination_factor = 1.5"), "lubricant.contamination_factor"),
        (CASE + WARM.replace("60.0", "900.0"), "diametral_clearance"),
        (CASE + WARM + "cage_C = 70.0\n", "bearing.cage_material: missing; needed with temperatures.cage_C"),
        (CASE.replace('"6208"', '"6208"\ncage_material = "PA67"') + WARM + "cage_C = 70.0\n", "did you mean 'pa66'"),
        (CASE.replace('"6208"', '"209"') + "[fit]\ninner_ring_interference_um = 5.0\n", "bearing.bore_mm"),
    ],
)
def test_bad_input_is_told(text, expected):
    assert expected in faults(text)


def test_clearances_of_a_warm_cage():
    """The summary has their change on the land and in the pockets, and tells a land without clearance."""
    lands = '[cage]\nguided_by = "outer ring"\nland_diameter_mm = 69.0\nland_clearance_um = 100.0\n'
    text = CASE.replace('"6208"', '"6208"\ncage_material = "PA66"') + WARM + "cage_C = 70.0\n"
    found = summary(run_case(case(text + lands)))
    ball, cage, ring = 12e3 * 12e-6 * 35.0, 100e-6 * 50.0, 12e-6 * 30.0
    assert found["clearance"]["cage_pocket_change_um"] == pytest.approx(12e3 * cage - ball, rel=1e-9)
    assert found["clearance"]["cage_land_change_um"] == pytest.approx(0.5 * 69e3 * (ring - cage), rel=1e-9)
    left = f"no clearance left on its land, 100 um less {-found['clearance']['cage_land_change_um']:.3g} um"
    assert any(left in message for message in found["messages"])
    free = summary(run_case(case(text)))
    assert free["clearance"]["cage_land_change_um"] is None
    assert any("cage_land_change_um null, no ring guides the cage" in message for message in free["messages"])


def test_a_material_without_expansion():
    gunmetal = 'shaft_material = "gunmetal"\n'
    own = "[materials.gunmetal]\nyoungs_modulus_GPa = 100.0\npoisson_ratio = 0.34\ndensity_kg_m3 = 8500.0\n"
    assert "'gunmetal' has no thermal_expansion" in faults(CASE + "[fit]\n" + gunmetal + WARM + own)


def test_equal_results_with_and_without_an_idle_table():
    """A [fit] that holds nothing and a bearing at rest leave the loads as they are."""
    still = CASE.replace("inner_speed_rpm = 3000.0", "inner_speed_rpm = 0.0")
    one, two = (run_case(case(text)).quasistatic for text in (still, still + "[fit]\n"))
    assert (one.inner_load == two.inner_load).all()
    assert replace(one.bearing, name="") == replace(two.bearing, name="")


ROUGH = "[surface]\ninner_ring_roughness_um = 0.1\nouter_ring_roughness_um = 0.1\nball_roughness_um = 0.05\n"


def test_kappa_of_the_solved_film_stands_beside_that_of_the_viscosity():
    """The smallest of all lambda ratios decides, to the power the case gives."""
    text = CASE.replace("[lubricant]", "[lubricant]\ncontamination_factor = 0.5")
    text = text.replace('"none"', "[0.0]\npoints = 257") + ROUGH + "kappa_exponent = 1.1\n"
    found = summary(run_case(case(text)))
    ratios = [contact["lambda_ratio"] for contact in found["contacts"] if contact["resolved"]]
    assert len(ratios) == 2
    block = found["life"]
    assert block["kappa_film"] == pytest.approx(min(ratios) ** 1.1)
    assert block["kappa"] == pytest.approx(summary(run_case(case(CASE)))["life"]["kappa"])
    film, plain = block["modified_reference_rating_film_Mrev"], block["modified_reference_rating_Mrev"]
    assert film / plain == pytest.approx(block["a_iso_film"] / block["a_iso"])
    kappas = [contact["kappa"] for contact in found["contacts"] if contact["film_origin"] == "solved"]
    assert kappas == pytest.approx([ratio**1.1 for ratio in ratios])
    assert block["modified_reference_rating_contacts_h"] is None
    assert any("loaded contacts without a resolved film: 2 at the inner race" in m for m in found["messages"])


@pytest.mark.slow
def test_life_with_the_film_of_each_contact():
    """A third of the balls is loaded; the life lies above that of the thinnest film for all, its ends enclose it."""
    text = CASE.replace("[lubricant]", "[lubricant]\ncontamination_factor = 0.5")
    text = text.replace('film_maps = "none"', "points = 257") + ROUGH
    results = run_case(case(text))
    block = summary(results)["life"]
    low, life, high = (block[f"modified_reference_rating_contacts_{end}h"] for end in ("low_", "", "high_"))
    assert low < life < high
    assert life == pytest.approx(1e6 * block["modified_reference_rating_contacts_Mrev"] / 3000.0 / 60.0)
    assert block["modified_reference_rating_contacts_Mrev"] > block["modified_reference_rating_film_Mrev"]
    assert block["a_iso_contacts"] < 50.0


def test_without_film_there_is_no_kappa_of_it():
    found = summary(run_case(case(CASE + ROUGH)))
    assert [found["life"][key] for key in ("kappa_film", "a_iso_film", "modified_reference_rating_film_Mrev")] == [
        None
    ] * 3
    assert any("kappa_film" in message for message in found["messages"])


def test_a_shoulder_that_cuts_the_ellipse_is_told():
    """A shoulder barely above the raceway cuts the heaviest ellipses at the inner race; that of the outer one, not
    given, is estimated, and no ellipse reaches it.
    """
    found = summary(run_case(case(CASE.replace('name = "6208"', 'name = "6208"\ninner_shoulder_diameter_mm = 48.3'))))
    loaded = [contact for contact in found["contacts"] if contact["loaded"]]
    rings = {race: [c for c in loaded if c["race"] == race] for race in ("inner", "outer")}
    worst = min(rings["inner"], key=lambda contact: contact["shoulder_distance_ratio"])
    assert worst["truncated"] and worst["truncated_length_share"] > 0.0 and worst["shoulder_distance_ratio"] < 1.0
    assert worst["truncated_pressure_GPa"] > worst["hertz_pressure_GPa"] > worst["pressure_at_shoulder_GPa"]
    assert not any(contact["shoulder_estimated"] for contact in rings["inner"])
    assert all(contact["shoulder_estimated"] and not contact["truncated"] for contact in rings["outer"])
    told = next(m for m in found["messages"] if "shoulder of the inner ring cuts the ellipse" in m)
    assert f"at ball {worst['ball']} {worst['truncated_length_share']:.1%} of its length" in told
    assert "those of the uncut ellipse" in told
    assert any("shoulder diameters are estimated, outer" in message for message in found["messages"])
    assert all(contact["shear_maximum_GPa"] < 0.33 * contact["hertz_pressure_GPa"] for contact in loaded)


@pytest.mark.parametrize(("key", "value"), [("inner_shoulder_diameter_mm", 47.0), ("outer_shoulder_diameter_mm", 73.0)])
def test_shoulders_beyond_the_groove_are_refused(key, value):
    assert key in faults(CASE.replace('name = "6208"', f'name = "6208"\n{key} = {value}'))


@pytest.mark.parametrize(
    ("load", "expected"),
    [
        ("6000.0", "L10h {basic:.0f} h, modified L10mh {modified:.0f} h (a_ISO {a_iso:.3g})"),
        ("900.0", "L10h {basic:.0f} h, modified L10mh > {long} h (a_ISO 50, its limit)"),
        ("300.0", "L10h > {long} h, modified L10mh > {long} h (a_ISO 50, its limit)"),
    ],
)
def test_the_terminal_has_life_without_powers_of_ten(load, expected):
    """Hours to three figures, the modified ones with their a_ISO; beyond a million hours that alone."""
    text = CASE.replace("radial_load_N = 3000.0", f"radial_load_N = {load}")
    results = run_case(case(text.replace("[lubricant]", "[lubricant]\ncontamination_factor = 0.5")))
    block = summary(results)["life"]
    lives = {name: block[f"{name}_reference_rating_h"] for name in ("basic", "modified")}
    for name, life in lives.items():
        assert (life > 1e6) == (f"{{{name}:" not in expected)
    shown = {name: float(f"{life:.3g}") for name, life in lives.items()}
    row = rating_rows(results)["rating life"]
    assert row == expected.format(**shown, a_iso=block["a_iso"], long="1\N{NO-BREAK SPACE}000\N{NO-BREAK SPACE}000")
    assert "e+" not in row


CYCLE = "[[load_cases]]\nshare = 0.4\nradial_load_N = 5000.0\n[[load_cases]]\nshare = 0.6\ninner_speed_rpm = 1000.0\n"


def test_life_in_hours(life):
    """852 million revolutions at 6000 r/min."""
    block = life["life"]
    for name in ("basic", "modified"):
        revolutions = 1e6 * block[f"{name}_reference_rating_Mrev"]
        assert block[f"{name}_reference_rating_h"] == pytest.approx(revolutions / 6000.0 / 60.0)
    assert life["load_cases"] == []
    assert set(life["duty_cycle"].values()) == {None}
    assert any(message.startswith("duty_cycle: null") for message in life["messages"])


def test_the_cycle_is_the_sum_of_its_cases_run_alone():
    """Each load case gives what the case gives with its keys in [operation]; so does the cycle, by hand."""
    text = CASE.replace("[lubricant]", "[lubricant]\ncontamination_factor = 0.5")
    found = summary(run_case(case(text + CYCLE)))
    alone = [
        summary(run_case(case(text.replace("3000.0\n[ehl]", "5000.0\n[ehl]")))),
        summary(run_case(case(text.replace("rpm = 3000.0", "rpm = 1000.0")))),
    ]
    keys = ("basic_reference_rating_h", "modified_reference_rating_h", "a_iso", "kappa", "dynamic_equivalent_load_N")
    for block, single in zip(found["load_cases"], alone, strict=True):
        assert [block[key] for key in keys] == pytest.approx([single["life"][key] for key in keys])
        assert block["torque_N_mm"] == pytest.approx(single["torque_N_mm"]["total"])
        assert block["torque_model"] == "integrated" and block["converged"]
    turned = [0.4 * 3000.0, 0.6 * 1000.0]
    for name in ("basic", "modified"):
        lives = [single["life"][f"{name}_reference_rating_Mrev"] for single in alone]
        expected = sum(turned) / sum(part / life for part, life in zip(turned, lives, strict=True))
        assert found["duty_cycle"][f"{name}_reference_rating_Mrev"] == pytest.approx(expected)
    power = sum(share * block["power_W"] for share, block in zip((0.4, 0.6), found["load_cases"], strict=True))
    assert found["duty_cycle"]["energy_per_hour_kJ"] == pytest.approx(3.6 * power)


def test_a_load_case_without_equilibrium_is_told():
    """A load beyond all measure: the run is not converged, and says which load case."""
    found = summary(run_case(case(CASE + CYCLE.replace("5000.0", "1e8"))))
    assert not found["converged"]
    assert [block["converged"] for block in found["load_cases"]] == [False, True]
    assert any(message.startswith("load case 1: equilibrium not converged: ") for message in found["messages"])
    assert found["duty_cycle"]["basic_reference_rating_h"] is None


def test_a_clearance_next_to_none_has_no_sign():
    results = run_case(case(CASE + WARM))
    none = replace(results, clearance=replace(results.clearance, operating=-4e-8))
    assert rating_rows(none)["clearance"].endswith("mounted, 0.0 operating")


def test_a_load_beyond_the_static_rating_is_told():
    """C_0 of a 6208 is 17.9 kN; of a duty cycle the state that has it is named, and the terminal has its S_0."""
    told = "life: S_0 = 0.746, beyond the static rating"
    over = summary(run_case(case(CASE.replace("radial_load_N = 3000.0", "radial_load_N = 24000.0"))))
    assert any(message.startswith(told) for message in over["messages"])
    results = run_case(case(CASE + CYCLE.replace("5000.0", "24000.0")))
    found = summary(results)["messages"]
    assert [message.startswith(f"load case 1: {told}") for message in found].count(True) == 1
    assert not any(message.startswith(told) for message in found)
    assert duty_cycle_rows(results)["safety of the cycle"] == "S_0 0.746, the smallest"


@pytest.mark.slow
def test_what_the_operation_tells_is_not_told_again_of_each_load_case():
    """Also where a load case finds its own temperature, and its case is made anew with it."""
    oil = CASE.replace("viscosity_mPa_s = 26.1\npressure_viscosity_1_GPa = 18.0", 'name = "iso vg 32"')
    oil = oil.replace('"6208"', '"6209-2Z C3"')
    warm = oil.replace("[ehl]", 'temperature = "self-heated"\n[friction]\nheat_transfer_W_K = 0.6\n[ehl]')
    messages = summary(run_case(case(warm + CYCLE)))["messages"]
    assert sum("internal geometry is estimated" in message for message in messages) == 1
    assert [message.split(",")[0] for message in messages if message.startswith("load case 2: ")] == [
        "load case 2: operation.temperature: computed at 36.0 C"
    ]


@pytest.mark.slow
def test_load_cases_warm_themselves_or_keep_a_temperature_of_their_own():
    """With operation.temperature = "self-heated" each load case has its own balance, as it has alone."""
    oil = CASE.replace("viscosity_mPa_s = 26.1\npressure_viscosity_1_GPa = 18.0", 'name = "iso vg 32"')
    warm = oil.replace("[ehl]", 'temperature = "self-heated"\n[friction]\nheat_transfer_W_K = 0.6\n[ehl]')
    cycle = CYCLE + "[[load_cases]]\nshare = 0.4\ntemperature_C = 55.0\n"
    found = summary(run_case(case(warm + cycle.replace("0.6", "0.2"))))
    temperatures = [block["temperature_C"] for block in found["load_cases"]]
    assert temperatures[2] == pytest.approx(55.0)
    slow = summary(run_case(case(warm.replace("rpm = 3000.0", "rpm = 1000.0"))))
    assert temperatures[1] == pytest.approx(slow["case"]["operation"]["temperature_C"], abs=1e-3)
    assert temperatures[0] > temperatures[1] + 10.0


def test_a_shielded_bearing_is_greased_for_life():
    text = CASE.replace('name = "6208"', 'name = "6208-2Z"') + '[friction]\nlubrication = "grease"\n'
    rows = rating_rows(run_case(case(text)))
    assert rows["grease for life"] == "5780 h"
    assert "relubrication" not in rows
    rows = rating_rows(run_case(case(text.replace("6208-2Z", "6208-Z"))))
    assert rows["relubrication"] == "every 5780 h"


def test_relubrication_only_with_grease():
    text = CASE.replace('name = "6208"', 'name = "6208"\nbore_mm = 40.0')
    found = summary(run_case(case(text + '[friction]\nlubrication = "grease"\n')))
    assert found["life"]["relubrication_interval_h"] == pytest.approx(5778.65, abs=0.1)
    assert any("lithium grease" in message for message in found["messages"])
    assert summary(run_case(case(text)))["life"]["relubrication_interval_h"] is None
