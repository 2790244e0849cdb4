"""Measured profiles of races: files as instruments write them, what is no turn, order 1, the lines of a profile."""

from __future__ import annotations

import json
import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.vibration.form import FormBody, SurfaceForm, waves_of
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.data_tables import turn_profile
from oilfilm.cases.format.rules import CaseError, InvalidKeyError

DEGREES = np.arange(0.0, 360.0, 0.5)
KEY = ("form", "inner_profile")


def height(degrees):
    """[um], order 10 of 0.5 and one of 0.2."""
    return 0.5 * np.cos(np.radians(10 * degrees)) + 0.2 * np.sin(np.radians(23 * degrees))


def text(degrees, heights, row="{:.6f};{:.6f}", head="", decimal="."):
    lines = (row.format(*pair).replace(".", decimal) for pair in zip(degrees, heights, strict=True))
    return head + "\n".join(lines) + "\n"


CENTRED = DEGREES - 180.0
CLOSED = np.append(DEGREES, 360.0)
FILES = {
    "plain.txt": text(DEGREES, height(DEGREES), "{:.6f} {:.6f}"),
    "german.csv": "\ufeff" + text(DEGREES, height(DEGREES), head="Winkel [°];Abweichung [µm]\n", decimal=","),
    "centred.csv": text(CENTRED, height(CENTRED), "{:.6f},{:.6f}", "angle (deg),height (um)\n"),
    "closed.csv": text(CLOSED, height(CLOSED), "{:.6f}\t{:.6f}"),
    "millimetres.csv": text(DEGREES, 1e-3 * height(DEGREES), "{:.6f},{:.9f}", "angle_deg,height_mm\n"),
    "radians.csv": text(np.radians(DEGREES), height(DEGREES), "{:.9f},{:.6f}", "phi [rad],r [um]\n"),
    "backwards.csv": text(DEGREES[::-1], height(DEGREES[::-1])),
    "instrument.prn": text(
        DEGREES, height(DEGREES), head="Roundness tester\nFilter;1-500 upr\nPoints;720\nAngle/deg;Radius/um\n"
    ),
    "rows.json": json.dumps(np.column_stack([DEGREES, height(DEGREES)]).tolist()),
    "names.json": json.dumps({"angle_deg": DEGREES.tolist(), "height_um": height(DEGREES).tolist()}),
    "counts.csv": "Counts;Deviation [nm]\n" + text(5 * np.arange(DEGREES.size), 1e3 * height(DEGREES), "{:d};{:.2f}"),
    "points.csv": "Point no.\tDeviation\n[-]\t[um]\n" + text(np.arange(DEGREES.size), height(DEGREES), "{:d}\t{:.6f}"),
    "commented.txt": "# part 17\n# filter 500 upr\n# angle_rad height_m\n"
    + text(np.radians(DEGREES), 1e-6 * height(DEGREES), "{:.9e} {:.6e}")
    + "# end\n",
    "status.csv": "Nr;Winkel;Radius;Status\n;°;µm;\n"
    + text(DEGREES, 25e3 + height(DEGREES), "7;{:.2f};{:.4f};OK", decimal=","),
    "sections.txt": "[HEADER]\nInstrument=roundness 565\nDate=12.03.2024\nPoints=720\n[DATA]\n"
    + text(DEGREES, height(DEGREES), "{:.2f},{:.5f}")
    + "[END]\n",
    "german.prn": "Formmessplatz\r\nFilter: Gauss 50 %, 1-500 W/U\r\nWinkel\tAbweichung\r\n[Grad]\t[µm]\r\n"
    + text(DEGREES, height(DEGREES), "{:.2f}\t{:.5f}", decimal=","),
    "from_100.csv": text(np.roll(DEGREES, -200), np.roll(height(DEGREES), -200), head="angle deg;height µm\n"),
    "inches.csv": text(DEGREES, 1.0 + height(DEGREES) / 25400.0, "{:.2f},{:.9f}", "Angle (deg),Radius (in)\n"),
    "records.json": json.dumps([{"angle_deg": a, "height_nm": 1e3 * height(a)} for a in DEGREES]),
    "heights.txt": "height [nm]\n" + "\n".join(f"{1e3 * h:.4f}" for h in height(DEGREES)),
}


def orders(profile):
    return 2.0 * abs(np.fft.rfft(profile)) / profile.size


@pytest.mark.parametrize("name", [*FILES, "pairs.npy"])
def test_files_as_instruments_write_them(tmp_path, name):
    path = tmp_path / name
    if name.endswith(".npy"):
        np.save(path, np.column_stack([DEGREES, height(DEGREES)]))
    else:
        path.write_text(FILES[name], encoding="utf-8")
    found = orders(turn_profile(KEY, str(path), eccentric=False))
    assert_allclose(found[[10, 23]], [0.5e-6, 0.2e-6], rtol=2e-3)
    assert np.delete(found, [10, 23])[:100].max() < 1e-9


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [
        (DEGREES[:361], "cover 180 of 360 deg"),
        (np.radians(DEGREES), "a turn in radians, which the header has to say"),
        (np.arange(0.0, 720.0), "cover 719 of 360 deg"),
        (np.append(DEGREES[:200], DEGREES[400:]), "a gap from 99.5 to 200 deg"),
        (np.append(DEGREES, 10.0), "row 721: the angle does not rise"),
        (DEGREES[:5], "5 rows"),
    ],
)
def test_what_is_no_turn_is_refused(tmp_path, degrees, expected):
    path = tmp_path / "part.csv"
    path.write_text(text(degrees, height(degrees)))
    with pytest.raises(InvalidKeyError) as caught:
        turn_profile(KEY, str(path), eccentric=False)
    assert expected in str(caught.value)


def test_a_point_that_was_not_measured_is_refused(tmp_path):
    """Instruments write 9999 and the like."""
    path = tmp_path / "spike.csv"
    path.write_text(text(DEGREES, np.where(DEGREES == 7.0, 9999.0, height(DEGREES))))
    with pytest.raises(InvalidKeyError, match="beside the mean"):
        turn_profile(KEY, str(path), eccentric=False)


def test_a_part_off_centre_and_a_jump_are_told(tmp_path):
    path = tmp_path / "off.csv"
    path.write_text(text(DEGREES, height(DEGREES) + 20.0 * np.cos(np.radians(DEGREES - 30.0))))
    with pytest.warns(UserWarning, match="order 1 of 20 um, the part off the centre"):
        centred = turn_profile(KEY, str(path), eccentric=False)
    assert orders(centred)[1] < 1e-12
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert_allclose(orders(turn_profile(KEY, str(path), eccentric=True))[1], 20e-6, rtol=1e-4)
    path.write_text(text(CLOSED, 1e-2 * CLOSED))
    with pytest.warns(UserWarning, match=r"does not close, by 3\.6 um at 0 deg"):
        turn_profile(KEY, str(path), eccentric=True)


def test_a_profile_shows_at_the_frequencies_of_its_orders():
    even = 2.0 * np.pi / 4096 * np.arange(4096)
    form = SurfaceForm(profiles={FormBody.INNER: 0.5e-6 * np.cos(10 * even + 0.3) + 0.1e-6 * np.cos(7 * even)})
    waves = waves_of(form, FormBody.INNER)
    assert [(wave.order, round(1e6 * wave.amplitude, 6)) for wave in waves] == [(7, 0.1), (10, 0.5)]
    assert waves[1].phase == pytest.approx(0.3)


CASE = """
schema_version = 1
[bearing]
name = "6208"
[lubricant]
name = "iso vg 32"
[operation]
inner_speed_rpm = 6000.0
radial_load_N = 200.0
"""


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        ("[form]\ninner_profile = 'FILE'\n", "form.inner_profile: "),
        ("[form]\nouter_profile = 'FILE'\n", "form.outer_profile: "),
        ("[support]\nfrequency_response = 'FILE'\n", "support.frequency_response: "),
    ],
)
def test_files_are_judged_with_the_case(tmp_path, table, expected):
    """`oilfilm validate`, and every run, opens what a case names."""
    path = tmp_path / "half.csv"
    for content in (None, text(DEGREES[:361], height(DEGREES[:361]))):
        if content is not None:
            path.write_text(content)
        with pytest.raises(CaseError) as caught:
            case_from_text(CASE + table.replace("FILE", str(path)), "case.toml")
        assert expected in str(caught.value)
