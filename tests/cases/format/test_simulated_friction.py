"""Friction constants of a simulation are those of [friction]."""

from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.document import validate_text
from oilfilm.cases.format.dynamics import simulated_friction
from oilfilm.cases.format.shipped import find_case

NEW = find_case("7008_radial").read_text(encoding="utf-8")


def test_a_simulation_fills_in_what_is_left_out():
    case = case_from_text(NEW.replace("traction_maximum_slide = 0.03\n", ""), "case.toml")
    assert simulated_friction(case.file.friction)["traction_maximum_slide"] == 0.03


def test_two_laws_of_friction_are_noted():
    text = NEW.replace("[friction]", '[friction]\ntraction = "coulomb"\ncoefficient = 0.05')
    (note,) = validate_text(text, "case.toml").notes
    assert 'friction.traction = "coulomb" in traction equilibrium' in note
    assert 'dynamics.friction = "four constants" in the simulation' in note
    assert note in case_from_text(text, "case.toml").warnings
    assert not validate_text(NEW.replace("[friction]", '[friction]\ntraction = "four constants"'), "case.toml").notes
