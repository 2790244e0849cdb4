"""`oilfilm verify`: its checks, its output and its exit codes."""

from __future__ import annotations

import json
from math import nan

import pytest
from typer.testing import CliRunner
from verification.contacts import race_6208
from verification.elements import CONTACTS as COMPARED

from oilfilm.cases.cli.main import app
from oilfilm.cases.runs import verification
from oilfilm.cases.runs.verification import CONTACTS, Check, checks, film_checks


def call(*arguments):
    return CliRunner().invoke(app, ["verify", *arguments])


def test_the_quick_verification_holds():
    result = call("--quick", "--json")
    assert result.exit_code == 0, result.output
    document = json.loads(result.stdout)
    assert document["converged"] and not document["messages"]
    assert len(document["checks"]) == 4 + 2 * len(CONTACTS)
    assert all(check["passed"] for check in document["checks"])


def test_the_terminal_shows_every_check(monkeypatch):
    made_up = [Check(name="one", value=1.0, least=0.0, most=2.0)]
    monkeypatch.setattr(verification, "checks", lambda *, quick: iter(made_up))
    result = call()
    assert result.exit_code == 0
    assert "one" in result.stdout and "0 to 2" in result.stdout and "yes" in result.stdout
    assert call("-q").stdout == ""


def test_a_statement_that_does_not_hold_ends_with_code_1(monkeypatch):
    made_up = [
        Check(name="order", value=1.2, least=1.7, most=2.3),
        Check(name="unknown", value=nan, least=0.0, most=1.0),
        Check(name="limit", value=1.0, least=0.0, most=2.0),
    ]
    monkeypatch.setattr(verification, "checks", lambda *, quick: iter(made_up))
    result = call("--json")
    assert result.exit_code == 1
    assert not json.loads(result.stdout)["converged"]
    assert "these statements do not hold:\n  order: 1.2, wanted 1.7 to 2.3" in result.stderr
    assert "unknown: nan" in result.stderr and "limit" not in result.stderr


def test_a_film_that_did_not_converge_is_no_number(monkeypatch):
    """A wrong reference and a failed solve are both seen."""
    solution = verification._solution(CONTACTS[0], 129)
    assert all(check.passed for check in film_checks(CONTACTS[0], solution))
    object.__setattr__(solution, "converged", False)
    assert not any(check.passed for check in film_checks(CONTACTS[0], solution))


def test_the_references_are_those_of_the_laboratory():
    """Same contacts as in the comparison of finite elements with multigrid, whose page has the films."""
    named = {contact.name: contact for contact in COMPARED}
    for ours in CONTACTS[:2]:
        assert ours.conditions == named[ours.name].conditions and ours.domain == named[ours.name].box
    assert CONTACTS[2].conditions == race_6208(300.0)


@pytest.mark.slow
def test_the_fine_verification_holds():
    assert all(check.passed for check in checks())
