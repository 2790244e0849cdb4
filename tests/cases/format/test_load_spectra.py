"""Load spectra: states with their shares, durations, courses over time that are counted by levels; their faults."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.format.case import case_from_text

CASE = """\
schema_version = 1
load_spectrum = 'FILE'
[bearing]
name = "6208"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 1500.0
radial_load_N = 2000.0
[ehl]
film_maps = "none"
"""
SHARES = "Anteil [%];Radiallast [kN];Drehzahl [1/min]\n10;3,0;1500\n20;2,0;1500\n30;1,0;3000\n40;0,0;1500\n"


def states_of(tmp_path, content, name="spectrum.csv"):
    path = tmp_path / name
    path.write_text(content, encoding="utf-8")
    case = case_from_text(CASE.replace("FILE", str(path)), "case.toml")
    note = next(note for note in case.warnings if note.startswith("load_spectrum"))
    return [
        (s.time_share, s.case.operation.force[1], s.case.operation.inner_speed * 30 / np.pi) for s in case.load_cases
    ], note


@pytest.mark.parametrize(
    "content",
    [
        SHARES,
        "share,radial_load_N,inner_speed_rpm\n0.1,3000,1500\n0.2,2000,1500\n0.3,1000,3000\n0.4,0,1500\n",
        "speed (rpm)\tFr (N)\tduration (h)\n1500\t3000\t1\n1500\t2000\t2\n3000\t1000\t3\n1500\t0\t4\n",
        "turns;load [kN];speed [rpm]\n1000;3;1500\n2000;2;1500\n6000;1;3000\n4000;0;1500\n",
        "share;load [kN];speed [rpm]\n10;3;1500\n20;2;1500\n30;1;3000\n40;0;1500\n",
    ],
)
def test_states_by_share_or_duration(tmp_path, content):
    found, _ = states_of(tmp_path, content)
    expected = [(0.1, 3000.0, 1500.0), (0.2, 2000.0, 1500.0), (0.3, 1000.0, 3000.0), (0.4, 0.0, 1500.0)]
    assert np.allclose(found, expected)


def test_a_course_is_counted_by_levels_with_its_damage(tmp_path):
    """Shares sum to 1, the mean of P^3 over the turns stays, time without load stays apart."""
    time = np.arange(0.0, 600.0, 0.2)
    load = np.where(time < 400.0, 2e3 * np.sin(time / 30.0) ** 2, 0.0)
    speed = np.where(time < 200.0, 1000.0, 3000.0)
    rows = "".join(f"{t:.1f},{p:.6f},{n:.0f}\n" for t, p, n in zip(time, load, speed, strict=True))
    found, note = states_of(tmp_path, "time [s],radial load [N],speed [rpm]\n" + rows)
    share, force, turning = np.array(found).T
    assert "counted into" in note
    assert len(found) < 40
    assert share.sum() == pytest.approx(1.0)
    assert np.sum(share * turning * force**3) == pytest.approx(np.mean(speed * load**3), rel=1e-3)
    assert share[force < 1.0].sum() == pytest.approx(1.0 / 3.0, abs=0.01)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("share;load [N]\n0.1;3\n0.2;2\n", "sum to 0.3; allowed: a sum of 1, or of 100 %"),
        ("turns;load [N];speed [rpm]\n10;3;0\n10;2;5\n", "turns or a speed of 0"),
        ("share;speed [rpm]\n0.5;3\n0.5;2\n", "no column of a load"),
        ("time [s];load [N]\n0;3\n2;2\n1;2\n", "row 3: the time does not rise"),
        ("share;load [um]\n0.5;3\n0.5;2\n", "the unit is none of radial_load_N"),
        ("share;load [N]\n0.5;3\n0.5;x\n", "line 3, column 2 (load [N]): found 'x'"),
        ("share;load [N]\n0.5;3\n0.5;\n", "line 3: no radial_load_N"),
        ("share;load [N];temperature [C]\n0.5;3;40\n0.5;3;1400\n", "found 1400.0"),
    ],
)
def test_faults(tmp_path, content, expected):
    with pytest.raises(CaseError) as caught:
        states_of(tmp_path, content)
    assert expected in str(caught.value)
    assert "case.toml:2: load_spectrum: " in str(caught.value)


def test_beside_load_cases_or_without_its_file(tmp_path):
    both = CASE.replace("FILE", "a.csv") + "[[load_cases]]\nshare = 1.0\n"
    with pytest.raises(CaseError, match="found together with load_cases"):
        case_from_text(both, "case.toml")
    with pytest.raises(CaseError, match="cannot be read"):
        case_from_text(CASE.replace("FILE", str(tmp_path / "none.csv")), "case.toml")
