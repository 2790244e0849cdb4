"""Friction constants of a simulation are those of [friction]; their earlier keys are read for one version."""

import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.document import validate_text
from oilfilm.cases.format.dynamics import simulated_friction
from oilfilm.cases.format.shipped import find_case

NEW = find_case("7008_radial").read_text(encoding="utf-8")
BY_LAW = "traction_maximum = 0.05\ntraction_maximum_slide = 0.03\ntraction_limit = 0.03\n"
EARLIER = "friction_maximum = 0.05\nfriction_maximum_slide = 0.03\nfriction_limit = 0.03\n"
OLD = (
    NEW.replace(f"[friction]\n{BY_LAW}", "")
    .replace("[dynamics]\n", f"[dynamics]\n{EARLIER}")
    .replace("friction.traction_", "dynamics.friction_")
)


def messages(text):
    with pytest.raises(CaseError) as caught:
        validate_text(text, "case.toml")
    return list(caught.value.messages)


def line_of(text, key):
    return 1 + next(i for i, line in enumerate(text.splitlines()) if line.startswith(key))


def test_earlier_keys_give_the_same_case_with_a_message():
    old, new = case_from_text(OLD, "case.toml"), case_from_text(NEW, "case.toml")
    assert "dynamics.friction_limit" in OLD
    assert old.document == new.document
    assert simulated_friction(old.file.friction) == simulated_friction(new.file.friction)
    notes = [message for message in old.warnings if message not in new.warnings]
    assert [note.partition(":")[0] for note in notes] == [
        f"dynamics.friction_{name}" for name in ("maximum", "maximum_slide", "limit")
    ]
    assert "is now friction.traction_maximum," in notes[0]


def test_a_key_by_both_its_names_is_refused():
    text = NEW.replace("[dynamics]\n", "[dynamics]\nfriction_limit = 0.02\n")
    (message,) = messages(text)
    place = f"case.toml:{line_of(text, 'friction_limit')}: dynamics.friction_limit: "
    assert message.startswith(f"{place}found together with friction.traction_limit")


def test_faults_of_an_earlier_key_have_its_line():
    for value, allowed in (("2.0", "a number >= 0 and <= 1"), ("0.06", "below traction_maximum = 0.05")):
        text = OLD.replace("friction_limit = 0.03", f"friction_limit = {value}")
        (message,) = messages(text)
        place = f"case.toml:{line_of(text, 'friction_limit')}: dynamics.friction_limit: "
        assert message.startswith(f"{place}found {float(value):g}")
        assert message.endswith(allowed)


def test_an_earlier_coefficient_counts_for_coulombs_law_only():
    """That of the torque models stays what it is where the simulation has another law."""
    text = NEW.replace("[dynamics]\n", "[dynamics]\nfriction_coefficient = 0.07\n")
    assert case_from_text(text, "case.toml").friction.coefficient is None
    coulomb = text.replace("[dynamics]\n", '[dynamics]\nfriction = "coulomb"\n')
    assert case_from_text(coulomb, "case.toml").friction.coefficient == 0.07


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
