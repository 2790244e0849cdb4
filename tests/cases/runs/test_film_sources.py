"""[ehl] films: what is solved, what the film atlas gives, and that both tell one story."""

from __future__ import annotations

import numpy as np
import pytest

import oilfilm
from oilfilm.cases.format.case import CaseError, case_from_text
from oilfilm.cases.format.contact import FilmSource
from oilfilm.postprocess import write_results

CASE = """
schema_version = 1
[bearing]
name = "6306"
ring_material = "bearing steel"
ball_material = "bearing steel"
[lubricant]
name = "iso vg 68"
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 1500.0
axial_load_N = 600.0
temperature_C = 60.0
[surface]
inner_ring_roughness_um = 0.05
outer_ring_roughness_um = 0.05
ball_roughness_um = 0.02
[ehl]
"""
# between atlas and solved films of a bearing; the atlas's bars of central films reach 1 %
# largest pressures of light contacts, a tenth of Hertz' and less, are those of rigid bodies
FILM, TORQUE, PRESSURE, LIGHT_PRESSURE = 0.02, 0.01, 0.05, 0.2


def case(*keys):
    return case_from_text(CASE + "\n".join(keys), "case")


@pytest.fixture(scope="module")
def runs():
    sources = ('films = "auto"', 'films = "solved"\ntolerance = 0.02', 'films = "atlas"')
    return {text: oilfilm.run_case(case(text)) for text in sources}


@pytest.fixture(scope="module")
def summaries(runs):
    return [oilfilm.summary(results) for results in runs.values()]


@pytest.mark.parametrize(
    ("keys", "source"),
    [
        ((), "auto"),
        (("points = 129",), "solved"),
        (("tolerance = 0.02",), "solved"),
        (('film_model = "newtonian"',), "auto"),
        (('film_model = "shear-thinning"',), "solved"),
        (('films = "auto"', "points = 129"), "auto"),
        (('films = "atlas"',), "atlas"),
    ],
)
def test_left_out_films_are_solved_where_a_key_asks_for_it(keys, source):
    found = case(*keys)
    assert found.film_source is FilmSource(source)
    assert found.document["ehl"]["films"] == source


@pytest.mark.parametrize(
    "text",
    [
        '{ehl}films = "atlas"\nfilm_model = "thermal"',
        '{lubricant}inlet_film_um = 1.0\n{ehl}films = "atlas"',
        '{ehl}films = "table"',
    ],
)
def test_films_that_the_atlas_does_not_have_are_refused(text):
    layer, _, ehl = text.partition("{ehl}")
    lubricant = layer.replace("{lubricant}", "")
    wanted = CASE.replace('name = "iso vg 68"', f'name = "iso vg 68"\n{lubricant}') + ehl
    with pytest.raises(CaseError, match="ehl"):
        case_from_text(wanted, "case")


def test_the_heaviest_contact_of_each_race_is_solved(summaries):
    auto, solved, atlas = summaries
    for race in ("inner", "outer"):
        contacts = [one for one in auto["contacts"] if one["race"] == race and one["loaded"]]
        heaviest = max(contacts, key=lambda one: one["load_N"])
        assert heaviest["film_origin"] == "solved"
        others = {one["film_origin"] for one in contacts if one["load_N"] < 0.999 * heaviest["load_N"]}
        assert others == {"atlas"}
    assert {one["film_origin"] for one in solved["contacts"] if one["loaded"]} == {"solved"}
    assert {one["film_origin"] for one in atlas["contacts"] if one["loaded"]} == {"atlas"}
    assert auto["converged"] and solved["converged"] and atlas["converged"]


def test_all_sources_tell_one_story(summaries):
    auto, solved, atlas = summaries
    for other in (auto, atlas):
        assert other["torque_N_mm"]["total"] == pytest.approx(solved["torque_N_mm"]["total"], rel=TORQUE)
        for own, one in zip(other["contacts"], solved["contacts"], strict=True):
            if not one["loaded"]:
                continue
            for film in ("central", "minimum"):
                value = one[f"film_{film}_um"]
                bars = one[f"film_{film}_uncertainty_um"] + own[f"film_{film}_uncertainty_um"]
                assert abs(own[f"film_{film}_um"] - value) < bars + 1e-3 * value
            assert own["film_central_um"] == pytest.approx(one["film_central_um"], rel=FILM)
            apart = PRESSURE if one["hertz_pressure_GPa"] > 0.5 else LIGHT_PRESSURE
            assert own["pressure_maximum_GPa"] == pytest.approx(one["pressure_maximum_GPa"], rel=apart)
            assert own["kappa"] == pytest.approx(one["kappa"], rel=2.0 * FILM)


@pytest.mark.slow
def test_fields_of_the_atlas_are_written(runs, tmp_path):
    results = runs['films = "auto"']
    assert write_results(results, tmp_path / "out") == ()
    written = oilfilm.open_results(tmp_path / "out")
    for film, field in zip(results.operating, results.fields, strict=True):
        if film is not None:
            middle = field.film[field.X == 0.0, field.Y == 0.0]
            assert middle == pytest.approx(film.central.value, rel=1e-9)
    names = [f"ball{ball:02d}/{race}" for ball in (1, 2) for race in ("inner", "outer")]
    for name in names:
        assert np.isfinite(written[f"contacts/{name}"]["h"].values).all()
