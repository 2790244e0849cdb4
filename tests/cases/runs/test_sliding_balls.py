"""Light loads at high speed: balls that drag of the oil holds back are said to slide, and a motion that friction
cannot keep up is named as what did not converge.
"""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from oilfilm.cases.cli.main import app


@pytest.fixture
def sliding(tmp_path, monkeypatch):
    """Exit code and messages of a hybrid spindle bearing at 10 N a ball, the cavity so full of oil."""
    monkeypatch.chdir(tmp_path)
    CliRunner().invoke(app, "init own --bearing HC7010C --speed 20000 --radial 0 --axial 200".split())
    text = (tmp_path / "own.toml").read_text(encoding="utf-8")
    text = text.replace('temperature = "self-heated"\n', "").replace('"all"', '"none"').replace("70.0", "80.5")
    heat = "heat_transfer_W_K", "ambient_C"  # without its balance, which has an end of its own
    text = "\n".join(line for line in text.splitlines() if not any(key in line for key in heat))

    def run(oil_fraction):
        filled = text.replace('"oil air"', f'"oil jet"\noil_fraction = {oil_fraction}')
        assert filled.count(f"oil_fraction = {oil_fraction}") == 1
        (tmp_path / "own.toml").write_text(filled, encoding="utf-8")
        answer = CliRunner().invoke(app, ["run", "own", "-o", "out"])
        return answer.exit_code, " ".join(answer.stderr.split())

    return run


def test_the_lag_of_sliding_balls_is_said(sliding):
    """By 4.8 % with 0.12 of the cavity filled; without oil in the cavity nothing is said."""
    code, messages = sliding(0.12)
    assert code == 0
    assert "their orbits are 4.8% slower than by 'half and half'" in messages
    assert "orbits are" not in sliding(0.0)[1]


def test_balls_that_nothing_drives_are_named_as_what_did_not_converge(sliding):
    """So they are from 0.16 of the cavity on."""
    code, messages = sliding(0.2)
    assert code == 1
    reasons = messages.partition("the results are flagged:")[2]
    assert "not converged: the inner race can drive no ball against drag and rolling resistance" in reasons
    assert "geometry is estimated" not in reasons
    assert "can drive no ball" not in messages.partition("the results are flagged:")[0]
