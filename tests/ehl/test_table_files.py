"""Tables as instruments and people write them: separators, decimal signs, units, JSON, npy; their faults."""

from __future__ import annotations

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.foreign_files import DamagedFileError
from oilfilm.ehl.table_files import Quantity, columns_of, read_table, table_of_text

WANTED = (Quantity("speed_rpm", ("speed", "drehzahl", "rpm", "n")), Quantity("torque_N_mm", ("torque", "moment")))
PLAIN = np.array([[500.0, 10.5], [1000.0, 12.5], [2000.0, 15.25]])
TEXTS = {
    "plain": "500 10.5\n1000 12.5\n2000 15.25\n",
    "commas": "speed [rpm],torque [N mm]\n500,10.5\n1000,12.5\n2000,15.25\n",
    "decimal commas": "\ufeffDrehzahl [1/min];Reibmoment [Nmm]\r\n500;10,5\r\n1000;12,5\r\n2000;15,25\r\n",
    "tabs, decimal commas": "n / (r/min)\tM / (N mm)\n500,0\t10,5\n1000,0\t12,5\n2000,0\t15,25\n",
    "units below": "speed;torque\nrpm;N·mm\n500;10.5\n1000;12.5\n2000;15.25\n",
    "keys": "torque_N_mm,speed_rpm\n10.5,500\n12.5,1000\n15.25,2000\n",
    "remark": "speed [1/min];load [N];torque [N cm]\n# test rig 3\n#\n500;400;1,05\n1000;400;1,25\n2000;400;1,525\n",
    "comments": "% rig 3\n# speed_rpm torque_N_mm\n500 10.5\n# again\n1000 12.5\n2000 15.25\n",
    "another unit": "speed (Hz),torque (mNm)\n",
    "instrument": "Rig;3\nDate;2024-05-01\nPoints;3\n\nSpeed (rpm);Torque (N mm);Remark\n500;10.5;ok\n1000;12.5;ok\n"
    "2000;15.25;warm\n[END]\n",
    "pounds": "Speed (rpm),Torque (lb-in)\n"
    + "".join(f"{n!r},{m / 112.98482902761671!r}\n" for n, m in PLAIN.tolist()),
    "centimetres": "RPM,Torque (N·cm)\n500,1.05\n1000,1.25\n2000,1.525\n",
    "units after a blank": "speed rpm;torque N m\n500;0.0105\n1000;0.0125\n2000;0.01525\n",
    "quoted decimal commas": '"speed [rpm]","torque [N mm]"\n"500","10,5"\n"1000","12,5"\n"2000","15,25"\n',
    "dates": "Datum;Drehzahl [1/min];Reibmoment [Nmm]\n" + "12.03.2024;{};{}\n" * 3,
    "quotes": '"speed [rpm]","torque [N mm]"\n"500","10.5"\n"1000","12.5"\n"2000","15.25"\n',
}
TEXTS["dates"] = TEXTS["dates"].format(500, "10,5", 1000, "12,5", 2000, "15,25")
TEXTS["another unit"] = "speed (rps),torque (mNm)\n" + "".join(f"{n / 60.0!r},{m!r}\n" for n, m in PLAIN.tolist())


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
def test_texts(tmp_path, text, encoding):
    path = tmp_path / "measured.csv"
    if encoding == "cp1252":
        text = text.removeprefix("\ufeff")
    path.write_bytes(text.encode(encoding))
    columns = columns_of(read_table(path), WANTED)
    assert_allclose(columns["speed_rpm"] * 30.0 / np.pi, PLAIN[:, 0])
    assert_allclose(columns["torque_N_mm"], 1e-3 * PLAIN[:, 1])


@pytest.mark.parametrize(
    "document",
    [
        PLAIN.tolist(),
        {"speed_rpm": PLAIN[:, 0].tolist(), "torque_N_mm": PLAIN[:, 1].tolist()},
        [{"speed [rpm]": n, "torque [N mm]": m} for n, m in PLAIN.tolist()],
        {"columns": ["speed", "torque"], "units": {"speed": "rpm", "torque": "N mm"}, "data": PLAIN.tolist()},
    ],
)
def test_json(tmp_path, document):
    path = tmp_path / "measured.json"
    path.write_text(json.dumps(document))
    assert_allclose(columns_of(read_table(path), WANTED)["torque_N_mm"], 1e-3 * PLAIN[:, 1])


@pytest.mark.parametrize("document", [{}, {"speed_rpm": [500.0, 1000.0], "torque_N_mm": [10.5]}])
def test_columns_are_of_one_length(tmp_path, document):
    path = tmp_path / "measured.json"
    path.write_text(json.dumps(document))
    with pytest.raises(DamagedFileError, match="no columns of one length"):
        read_table(path)


def test_arrays(tmp_path):
    np.save(tmp_path / "a.npy", PLAIN)
    np.save(tmp_path / "b.npy", PLAIN[:2].T)
    np.savez(tmp_path / "c.npz", speed_rpm=PLAIN[:, 0], torque_N_mm=PLAIN[:, 1])
    for name in ("a.npy", "c.npz"):
        assert_allclose(columns_of(read_table(tmp_path / name), WANTED)["torque_N_mm"], 1e-3 * PLAIN[:, 1])
    np.save(tmp_path / "d.npy", np.array([{}], dtype=object), allow_pickle=True)
    with pytest.raises(DamagedFileError):
        read_table(tmp_path / "d.npy")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "no rows of numbers"),
        ("a,b\nc,d\n", "no rows of numbers"),
        ("1 2\n3 x\n5 6\n", "line 2, column 2: found 'x'; allowed: a number"),
        ("s;t\n1;2\n3;4;5\n6;7\n", "line 3 has 3 entries, the others have 2"),
        ("s [rpm];t [N mm]\n1;2\n3;1.2.3\n6;7\n", "line 3, column 2 (t [N mm]): found '1.2.3'"),
        ("s [rpm];t\n500;1,5\n1.000;2,5\n", "line 3, column 1 (s [rpm]): found '1.000'; allowed: a number, without a"),
        ("s [rpm];t\n500;1\n1.000;2\n", "line 3, column 1 (s [rpm]): found '1.000'; allowed: a number, without a"),
        ('s [rpm],t\n"500",1\n"1,000",2\n', "line 3, column 1 (s [rpm]): found '1,000'"),
        ("s;t\n500;#DIV/0!\n600;2\n700;3\n", "line 2, column 2 (t): found '#DIV/0!'"),
        ("s;t\n500;1e400\n600;2\n", "line 2, column 2 (t): found '1e400'"),
    ],
)
def test_faults_have_line_and_column(text, expected):
    with pytest.raises(DamagedFileError) as caught:
        table_of_text(text, "a.csv")
    assert expected in str(caught.value)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("speed [rpm],film [um]\n1,2\n3,4\n", "no column torque_N_mm; its columns: speed [rpm], film [um]"),
        ("speed [rpm],torque [N]\n1,2\n3,4\n", "column torque [N]: the unit is none of torque_N_mm"),
        ("1\n2\n", "1 columns without header; allowed: speed_rpm, torque_N_mm"),
        ("speed [rpm],torque up [Nm],torque down [Nm]\n1,2,3\n4,5,6\n", "each of which may be torque_N_mm"),
    ],
)
def test_columns_that_are_not_there(text, expected):
    with pytest.raises(DamagedFileError) as caught:
        columns_of(table_of_text(text, "a.csv"), WANTED)
    assert expected in str(caught.value)


@pytest.mark.parametrize("content", [b"PK\x03\x04 a workbook", b"\xd0\xcf\x11\xe0 an old one"])
def test_a_workbook_is_told(tmp_path, content):
    path = tmp_path / "a.xlsx"
    path.write_bytes(content)
    with pytest.raises(DamagedFileError, match="its sheet saved as CSV"):
        read_table(path)


def test_infinite_entries_are_refused(tmp_path):
    np.save(tmp_path / "a.npy", np.where(PLAIN == 12.5, np.inf, PLAIN))
    with pytest.raises(DamagedFileError, match=r"row 2: .* is infinite"):
        columns_of(read_table(tmp_path / "a.npy"), WANTED)


def test_a_column_goes_to_the_quantity_that_names_it_first():
    wanted = (Quantity("radial_N", ("radial", "load"), needed=False), Quantity("axial_N", ("axial",), needed=False))
    found = columns_of(table_of_text("axial load [kN];speed\n1;5\n2;6\n", "a.csv"), wanted)
    assert {key: values.tolist() for key, values in found.items()} == {"axial_N": [1000.0, 2000.0]}


def test_times_of_day_are_seconds_and_left_out_entries_nan():
    table = table_of_text("time;load [kN]\n2024-01-01 23:59:50;1\n2024-01-02 00:00:10;\n", "a.csv")
    assert_allclose(np.diff(table.columns[0].values), 20.0)
    assert np.isnan(table.columns[1].values[1])


@pytest.mark.parametrize(("text", "line"), [("1 x\n2 3\n4 5\n6 7\n", 1), ("1 2\n2 3\n4 5\n6\n", 4)])
def test_a_damaged_row_at_an_end_is_none_of_the_instrument(text, line):
    with pytest.raises(DamagedFileError, match=f"line {line}"):
        table_of_text(text, "a.csv")


def test_thousands_are_told_not_taken_for_words():
    with pytest.raises(DamagedFileError, match=r"line 2, column 1: found '1\.000,5'"):
        table_of_text("a;b\n1.000,5;2\n2.000,5;3\n", "a.csv")
