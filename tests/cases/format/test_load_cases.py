"""[[load_cases]]: keys in the place of those of [operation], shares, and faults at the load case's own lines."""

from __future__ import annotations

import pytest

from oilfilm.cases import CaseError, load_case
from oilfilm.cases.format.case import case_from_text

CASE = """\
schema_version = 1
[bearing]
name = "6208"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 6000.0
radial_load_N = 2000.0
axial_load_N = 300.0
temperature_C = 60.0
[ehl]
film_maps = "none"
[[load_cases]]
share = 0.25
[[load_cases]]
share = 0.75
"""


def case(keys="", text=CASE):
    """The case with keys in its last load case."""
    return case_from_text(text + keys, "case.toml")


def faults(keys, text=CASE):
    with pytest.raises(CaseError) as caught:
        case(keys, text)
    return list(caught.value.messages)


def test_keys_left_out_are_those_of_operation():
    found = case("inner_speed_rpm = 1000.0\naxial_load_N = 0.0\n")
    first, last = (state.case for state in found.load_cases)
    assert [state.time_share for state in found.load_cases] == [0.25, 0.75]
    assert first.operation == found.operation
    assert last.operation.force == (0.0, 2000.0, 0.0)
    assert last.operation.inner_speed == pytest.approx(104.719755)
    assert last.operation.temperature == found.operation.temperature
    assert last.load_cases == ()


def test_a_force_replaces_the_loads_of_operation():
    found = case("force_N = [1.0, 2.0, 3.0]\nmoment_N_mm = [0.0, 500.0]\n")
    assert found.load_cases[1].case.operation.force == (1.0, 2.0, 3.0)
    assert found.load_cases[1].case.operation.moment == (0.0, 0.5)
    back = CASE.replace("radial_load_N = 2000.0\naxial_load_N = 300.0", "force_N = [1.0, 2.0, 3.0]")
    assert case("radial_load_N = 7.0\n", back).load_cases[1].case.operation.force == (0.0, 7.0, 0.0)


def test_each_load_case_has_its_oil_and_its_clearance():
    """Oil at its temperature, centrifugal growth at its speed; shares are scaled to a sum of 1."""
    text = CASE.replace("[ehl]", "[fit]\ninner_ring_interference_um = 10.0\n[ehl]").replace("0.25", "0.255")
    found = case("temperature_C = 90.0\ninner_speed_rpm = 20000.0\n", text)
    first, last = (state.case for state in found.load_cases)
    assert last.lubricant.viscosity < 0.5 * first.lubricant.viscosity
    assert last.clearance.centrifugal < first.clearance.centrifugal < 0.0
    assert sum(state.time_share for state in found.load_cases) == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize(
    ("keys", "text", "line", "expected"),
    [
        ("", CASE.replace("0.75", "0.5"), 13, "load_cases: found shares that sum to 0.75; allowed: a sum of 1"),
        ("", CASE.replace("share = 0.75", ""), 15, "load_cases.1.share: missing; needed: a number > 0 and <= 1"),
        ("", CASE.replace("0.75", "75"), 16, "load_cases.1.share: found 75; allowed: a number > 0 and <= 1"),
        ("inner_sped_rpm = 1.0\n", CASE, 17, "unknown key; did you mean 'inner_speed_rpm'?"),
        ("temperature_C = 450.0\n", CASE, 17, "load_cases.1.temperature_C: found 450.0; allowed with an oil of"),
        ('displacement_um = [1.0, "free", "free"]\n', CASE, 17, "found a displacement along x together with a load"),
        ("force_N = [1.0, 2.0, 3.0]\nradial_load_N = 5.0\n", CASE, 18, "found together with force_N"),
        ('moment_N_mm = [0.0, 1.0]\ntilt = "held"\n', CASE, 18, 'found "held" together with a moment'),
    ],
)
def test_bad_input_is_told_at_the_load_case(keys, text, line, expected):
    found = faults(keys, text)
    assert any(message.startswith(f"case.toml:{line}: ") and expected in message for message in found), found
    assert len(found) == 1


def test_a_table_in_place_of_a_list():
    head = CASE.partition("[[load_cases]]")[0]
    found = faults("", head + "[load_cases]\nx = 1\n")
    assert found == ["case.toml:13: load_cases: found a table; allowed: a list"]


def test_a_fault_of_operation_is_told_once():
    text = CASE.replace("radial_load_N = 2000.0", "radial_load_N = 2000.0\nforce_N = [1.0, 2.0, 3.0]")
    assert [message.partition(": ")[0] for message in faults("", text)] == ["case.toml:8", "case.toml:10"]


def test_whole_tables_lists_and_the_title_are_values_of_a_case():
    """A key without a dot stood in a table of its own: "title: found a table; allowed: text"."""
    case = load_case("6208_duty_cycle").with_values({"load_cases": [{"share": 1.0}], "title": "another"})
    assert case.title == "another" and len(case.document["load_cases"]) == 1
    with pytest.raises(CaseError, match="nonsense: unknown"):
        case.with_values({"nonsense": 1.0})
