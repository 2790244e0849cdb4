"""Runs: which contacts are solved, how often, and what is kept when a run is stopped. The solver is a stand-in."""

from __future__ import annotations

import dataclasses
import threading
from math import radians
from types import SimpleNamespace

import pytest

from oilfilm import ehl
from oilfilm.bearing import solve_quasistatic
from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.cases import load_case, run_case, run_contact
from oilfilm.cases.format.contact import FilmSource
from oilfilm.cases.runs.bearing import Interrupted
from oilfilm.cases.runs.films import equal_contacts
from oilfilm.postprocess import summary

CASE = "6208_full_ceramic"


def solved_case():
    """The case with all films solved."""
    return dataclasses.replace(load_case(CASE), film_source=FilmSource.SOLVED)


class Solver:
    """Stands in for `oilfilm.ehl.solve_contact`; remembers what it was asked."""

    def __init__(self, stop_after=None):
        self.asked = []
        self.stop_after = stop_after
        self.lock = threading.Lock()

    def __call__(self, conditions, options):
        with self.lock:
            self.asked.append(conditions)
            if self.stop_after is not None and len(self.asked) > self.stop_after:
                raise KeyboardInterrupt
        return SimpleNamespace(conditions=conditions, options=options, converged=True)


@pytest.fixture(autouse=True)
def unsheared(monkeypatch):
    """The stand-in's films have no fields to shear or to conduct heat."""
    monkeypatch.setattr(
        "oilfilm.cases.runs.bearing.contact_tractions",
        lambda _case, _state, contacts, _films, _balanced: (None,) * len(contacts),
    )
    monkeypatch.setattr("oilfilm.cases.runs.bearing._torque", lambda *_: None)
    monkeypatch.setattr("oilfilm.cases.runs.bearing._operating", lambda *_: None)
    monkeypatch.setattr("oilfilm.cases.runs.bearing.solved_films", lambda contacts, _solutions: (None,) * len(contacts))
    monkeypatch.setattr("oilfilm.cases.runs.contact._contact_traction", lambda *_: None)


def replace_solver(monkeypatch, stand_in):
    """Solve films by a stand-in, in runs of bearings and of single contacts."""
    for module in ("oilfilm.cases.format.film_model", "oilfilm.cases.runs.films"):
        monkeypatch.setattr(f"{module}.solve_contact", stand_in)


@pytest.fixture
def solver(monkeypatch):
    stand_in = Solver()
    replace_solver(monkeypatch, stand_in)
    return stand_in


def test_equal_contacts_are_solved_once_and_share_the_solution(solver):
    results = run_case(solved_case(), workers=2)
    # inner and outer at 0 and +-40 degrees, outer at the balls that leave the inner race to the layer of oil
    assert len(solver.asked) == 5
    assert sum(solution is not None for solution in results.solutions) == 10
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        assert (solution is None) == (contact.gap is not None or not contact.loaded)
        assert solution is None or equal_contacts(solution.conditions, contact.conditions)
    assert {contact.ball for contact in results.contacts if contact.gap is not None} == {3, 8}  # between two films
    out_of_load = [(contact.ball, contact.race.value) for contact in results.contacts if not contact.loaded]
    assert out_of_load == [(ball, "inner") for ball in (4, 5, 6, 7)]
    assert len({id(solution) for solution in results.solutions if solution}) == 5
    assert set(results.timing) == {"quasistatic", "contacts", "torque", "strength", "total"}


def film_maps(case, wanted):
    return dataclasses.replace(case, film_maps=wanted)


def solved(results):
    pairs = zip(results.contacts, results.solutions, strict=True)
    return [(contact.ball, contact.race.value) for contact, solution in pairs if solution is not None]


def test_film_maps(solver):
    case = solved_case()
    assert solved(run_case(film_maps(case, "none"))) == []
    assert {ball for ball, _ in solved(run_case(film_maps(case, "loaded")))} == {1, 2, 9}
    chosen = run_case(film_maps(case, (radians(320.0), radians(-320.0), radians(80.0))))
    assert solved(chosen) == [(2, "inner"), (2, "outer"), (9, "inner"), (9, "outer")]
    gaps = [contact.gap for contact in chosen.contacts if contact.ball == 3]  # at 80 degrees, between two films
    assert None not in gaps
    still = run_case(film_maps(case, (0.0,)))
    assert solved(still) == [(1, "inner"), (1, "outer")]
    assert run_case(film_maps(case, "none")).converged


def test_no_films_without_equilibrium(solver, monkeypatch):
    solve = solve_quasistatic

    def fail(*arguments, **named):
        return dataclasses.replace(solve(*arguments, **named), converged=False, message="no equilibrium")

    monkeypatch.setattr("oilfilm.cases.runs.equilibrium.solve_quasistatic", fail)
    results = run_case(solved_case())
    assert solver.asked == []
    assert not results.converged
    assert any("no equilibrium" in message for message in results.messages)


def test_progress_counts_to_the_end(solver):
    seen = []
    run_case(solved_case(), workers=1, progress=lambda done, total, state: seen.append((done, total, state)))
    assert seen[0] == (0, 1, "equilibrium of the bearing")
    assert [done for done, total, state in seen if state == "films"] == [0, 1, 2, 3, 4, 5]


def test_a_stopped_run_keeps_the_finished_films(monkeypatch):
    replace_solver(monkeypatch, Solver(stop_after=2))
    with pytest.raises(Interrupted) as stop:
        run_case(solved_case(), workers=1)
    results = stop.value.results
    assert 0 < len(solved(results)) < 6  # two of five
    assert any("interrupted" in message for message in results.messages)
    assert (results.torque, results.heating) == (None, None)
    document = summary(dataclasses.replace(results, solutions=(None,) * len(results.contacts)))
    reasons = [message for message in document["messages"] if message.startswith(("torque_N_mm:", "self_heating"))]
    assert reasons == []  # the run was stopped, nothing was looked at


def test_a_run_stopped_at_once_has_nothing_to_keep(monkeypatch):
    replace_solver(monkeypatch, Solver(stop_after=0))
    with pytest.raises(Interrupted) as stop:
        run_case(solved_case(), workers=1)
    assert stop.value.results is None


def test_equality_is_to_1e9_relative():
    lubricant = ehl.Lubricant(viscosity=0.03, pressure_viscosity=2e-8)
    contact = ehl.ContactConditions(
        load=15.0, radius_x=0.01, radius_y=0.02, reduced_modulus=2e11, entrainment_speed=1.0, lubricant=lubricant
    )
    assert equal_contacts(contact, dataclasses.replace(contact, load=15.0 * (1 + 1e-12), spin=1e-12))
    assert not equal_contacts(contact, dataclasses.replace(contact, radius_x=0.01 * (1 + 1e-8)))
    assert not equal_contacts(contact, dataclasses.replace(contact, spin=1e-3))
    assert not equal_contacts(contact, dataclasses.replace(contact, lubricant=dataclasses.replace(lubricant, name="x")))


def test_a_single_contact(solver):
    results = run_contact(load_case("ball_on_disc"))
    assert results.solution.conditions.load == 15.0
    assert results.converged


def test_a_warning_of_the_library_reaches_the_results(solver, tmp_path):
    from oilfilm.cases.format.shipped import shipped_cases

    text = shipped_cases()["ball_on_disc"].read_text()
    text = text.replace(
        "viscosity_mPa_s = 40.0\npressure_viscosity_1_GPa = 20.0\ndensity_kg_m3 = 870.0", 'name = "iso vg 32"'
    )
    text = text.replace("[contact]", "[contact]\ntemperature_C = 200.0").replace("points = 257", "points = 65")
    (tmp_path / "hot.toml").write_text(text[: text.index("assumed")] + text[text.index("[contact]") :])
    results = run_contact(load_case(tmp_path / "hot.toml"))
    assert any("outside 20.0 to 100.0 C" in message for message in results.messages)


def test_the_lambda_ratio_of_a_case_with_roughness():
    """h_min over the rms roughness of race and ball, sqrt(0.03^2 + 0.04^2) = 0.05 um."""
    from oilfilm.postprocess.bearing.contact_quantities import lambda_ratio

    surface = {"inner_ring_roughness_um": 0.03, "outer_ring_roughness_um": 0.0, "ball_roughness_um": 0.04}
    inner = SimpleNamespace(race=SimpleNamespace(value="inner"))
    outer = SimpleNamespace(race=SimpleNamespace(value="outer"))
    film = 0.2e-6
    assert lambda_ratio(inner, film, surface) == pytest.approx(4.0)
    assert lambda_ratio(outer, film, surface) == pytest.approx(5.0)
    assert lambda_ratio(inner, None, surface) is None
    assert lambda_ratio(inner, film, None) is None


def test_films_say_what_heat_in_the_inlet_leaves():
    """At 10000 r/min the share of each film by the law of solved films; the assumed properties of an oil are named."""
    plain = load_case("6208_full_ceramic")
    plain = dataclasses.replace(plain, film_maps="none")
    oil = load_lubricant("mil-l-23699", 343.15)  # within the film atlas, with properties of its own
    case = dataclasses.replace(plain, lubricant=oil)
    results = run_case(case)
    contacts = [contact for contact in summary(results)["contacts"] if contact["inlet_heat_share"] is not None]
    assert contacts
    running = [film for film in results.operating if film is not None]
    assert [one["inlet_heat_share"] for one in contacts] == [film.heat.central.value for film in running]
    assert all(one["film_central_oil_uncertainty_um"] == 0.0 for one in contacts)
    shares = [one[key] for one in contacts for key in ("inlet_heat_share", "inlet_heat_share_minimum")]
    text = next(
        message for message in summary(results)["messages"] if "inlet shear heating (included) leaves" in message
    )
    assert f"leaves {min(shares):.2g} to {max(shares):.2g} of the isothermal films" in text
    assert "assumed" not in text
    known = summary(run_case(plain))
    assert any("the oil's assumed conductivity 0.137 W/mK +- 10 %" in text for text in known["messages"])
    assert min(one["film_central_oil_uncertainty_um"] for one in known["contacts"] if one["film_central_um"]) > 0.0
