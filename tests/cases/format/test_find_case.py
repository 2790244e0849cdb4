"""How a name finds its case: the user's own file, with or without .toml, then the shipped ones."""

from __future__ import annotations

import shutil

import pytest
from typer.testing import CliRunner

from oilfilm.cases.cli.main import app
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shipped import find_case, shipped_cases


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_own_case_is_found_by_its_name(here):
    shutil.copy(find_case("6208_life"), here / "motor6205.toml")
    for name in ("motor6205", "motor6205.toml", str(here / "motor6205")):
        assert find_case(name).samefile(here / "motor6205.toml")
    answer = CliRunner().invoke(app, ["validate", "motor6205"])
    assert answer.exit_code == 0
    assert "motor6205: valid" in answer.output


def test_a_dot_in_a_name_is_no_suffix(here):
    shutil.copy(find_case("6208_life"), here / "motor.v2.toml")
    assert find_case("motor.v2").name == "motor.v2.toml"


def test_a_copy_of_a_shipped_case_is_the_same_case(here):
    shutil.copy(find_case("6208_life"), here / "6208_life.toml")
    assert find_case("6208_life").read_bytes() == shipped_cases()["6208_life"].read_bytes()


def test_two_cases_of_one_name_are_not_confused(here):
    text = find_case("6208_life").read_text(encoding="utf-8")
    (here / "6208_life.toml").write_text(text.replace("3000.0", "2000.0"), encoding="utf-8")
    with pytest.raises(CaseError, match=r"differ; write 6208_life\.toml for the file"):
        find_case("6208_life")
    assert find_case("6208_life.toml").samefile(here / "6208_life.toml")


def test_a_sweep_names_the_case_beside_it(here):
    (here / "part").mkdir()
    shutil.copy(find_case("6208_life"), here / "part" / "mine.toml")
    lines = ('case = "mine"', "[sweep]", '"operation.radial_load_N" = [1000.0, 2000.0]')
    (here / "part" / "loads.toml").write_text("\n".join(lines), encoding="utf-8")
    answer = CliRunner().invoke(app, ["validate", "part/loads"])
    assert answer.exit_code == 0, answer.output
