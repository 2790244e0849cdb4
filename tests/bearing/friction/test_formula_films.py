"""Films that are not solved: of the atlas, and of formulas scaled to it without a step."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from oilfilm.bearing.contacts.contact import hertz_contacts
from oilfilm.bearing.films.unsolved_films import formula_values
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.cases import load_case, run_case
from oilfilm.cases.format.case import case_of_document
from oilfilm.ehl import ViscosityLaw
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.postprocess import summary


def contact(load, speed=8.0, temperature=333.15):
    oil = load_lubricant("iso vg 32", temperature)
    return ContactConditions(
        load=load, radius_x=4.8e-3, radius_y=0.16, reduced_modulus=2.26e11, entrainment_speed=speed, lubricant=oil
    )


def numbers(conditions):
    c = conditions
    arrays = (np.array([value]) for value in (c.load, c.radius_x, c.radius_y, c.reduced_modulus))
    hertz = hertz_contacts(*arrays)[0]
    return formula_values(conditions, (hertz.semi_axis_y, hertz.semi_axis_x))


def test_films_go_on_without_a_step_beyond_the_atlas():
    """Over seven decades of load: no film and no moment jumps where the range of the atlas ends."""
    found = [numbers(contact(load, 1.0)) for load in np.geomspace(0.01, 1e5, 281)]
    edges = [i for i, (a, b) in enumerate(pairwise(found)) if a.atlas is not b.atlas]
    assert len(edges) == 2
    for name in ("central", "ratio", "moment"):
        steps = [np.log(getattr(b, name) / getattr(a, name)) for a, b in pairwise(found)]
        for i in edges:
            beside = steps[i - 1], steps[i + 1]
            assert min(beside) - 0.002 < steps[i] < max(beside) + 0.002
    assert all(one.error <= 0.2 for one in found)
    assert min(one.error for one in found) < 0.01


def test_oils_that_thicken_little_have_the_formulas_alone():
    """Below 8 per GPa the atlas has no contacts; another law is no reason any more."""
    thin = contact(300.0)
    thin = replace(thin, lubricant=replace(thin.lubricant, pressure_viscosity=4e-9, roelands_z=0.5))
    assert numbers(thin).error == 0.2
    assert not numbers(thin).atlas
    barus = contact(300.0)
    barus = replace(barus, lubricant=replace(barus.lubricant, viscosity_law=ViscosityLaw.BARUS))
    assert numbers(barus).error < 0.02
    assert numbers(barus).atlas


def test_a_bearing_without_maps_has_films_of_the_atlas():
    """As the solved ones, within the atlas's bars; and its torque."""
    document = load_case("6208_full_ceramic").document
    none = summary(run_case(case_of_document({**document, "ehl": {"film_maps": "none"}})))
    solved = summary(
        run_case(case_of_document({**document, "ehl": {"film_maps": [0.0, 160.0], "points": 257, "films": "solved"}}))
    )
    heaviest, known = none["contacts"][0], solved["contacts"][0]
    assert (heaviest["film_origin"], known["film_origin"]) == ("atlas", "solved")
    for name in ("central", "minimum"):
        film, bar = (heaviest[f"film_{name}_{end}"] for end in ("um", "uncertainty_um"))
        assert film == pytest.approx(known[f"film_{name}_um"], abs=bar + known[f"film_{name}_uncertainty_um"])
    assert heaviest["points"] is heaviest["pressure_maximum_GPa"] is None
    light = none["contacts"][9]  # of a ball whose gap the oil does not fill
    assert light["race"] == "outer"
    assert light["load_N"] < 20.0 and light["film_origin"] == "atlas"
    known = solved["contacts"][9]
    assert known["film_origin"] == "solved"
    for name in ("flooded_film_central_um", "film_central_um"):  # its bar is that of the law behind a layer
        assert light[name] == pytest.approx(known[name], rel=0.005)
    between = [c for c in none["contacts"] if c["race"] == "inner" and c["load_N"] < 20.0]
    assert [contact["ball"] for contact in between] == [3, 4, 5, 6, 7, 8]
    # two fill their gap, under less load than the atlas has; the oil of the track does not fill that of the others
    filled = [contact["ball"] for contact in between if contact["film_origin"] == "formula"]
    assert filled == [3, 8]
    assert all(0.0 < contact["load_N"] < 0.1 for contact in between if contact["ball"] in filled)
    assert {c["film_origin"] for c in between if c["ball"] not in filled} == {None}
    assert {contact["film_origin"] for contact in none["contacts"] if contact not in between} == {"atlas"}
    assert any("films of the film atlas (film_origin) at 12 contacts" in message for message in none["messages"])
    assert any("films of the film atlas at 12 and of formulas at 2" in message for message in none["messages"])
