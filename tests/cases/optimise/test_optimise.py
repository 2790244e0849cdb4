"""Optimisation: the surrogate, what is asked for, and a search through the batch."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm.cases import CaseError
from oilfilm.cases.cli.main import app
from oilfilm.cases.cli.optimise import optimisation_table
from oilfilm.cases.optimise import study as study_module
from oilfilm.cases.optimise.results import write_optimisation
from oilfilm.cases.optimise.search import (
    Observations,
    confirmation_messages,
    first_designs,
    fitted,
    improvement,
    next_designs,
    pareto_front,
    scalar_goal,
    search_designs,
)
from oilfilm.cases.optimise.study import Design, OptimisationResult, read_study

from ..batch.test_batch import HerePool

SEED = 7_193
STUDY = """
case = "6208_full_ceramic"
[fixed]
"ehl.film_maps" = "none"
[vary]
"bearing.diametral_clearance_um" = [8.0, 18.0]
"lubricant.viscosity_mPa_s" = [15.0, 40.0]
[goal]
minimise = "torque_N_mm"
[constraints]
"film_minimum_um" = { least = 0.35 }
[search]
designs = 6
first = 4
together = 1
[proof]
"operation.temperature_C" = 41.0
"""


def told(positions, goals, constraints=None):
    """Designs without noise."""
    none = np.zeros((len(positions), 0))
    constraints = none if constraints is None else constraints
    return Observations(positions, goals, np.zeros_like(goals), constraints, np.zeros_like(constraints))


def test_the_surrogate_meets_exact_values_and_not_noisy_ones():
    rng = np.random.default_rng(SEED)
    positions = first_designs(2, 25, SEED)
    values = np.sin(4.0 * positions[:, 0]) + positions[:, 1] ** 2
    exact = fitted(positions, values, np.zeros(25))
    mean, deviation = exact.predict(positions)
    assert mean == pytest.approx(values, abs=1e-4)
    assert deviation.max() < 1e-2
    other = rng.random((200, 2))
    mean, deviation = exact.predict(other)
    error = np.abs(mean - np.sin(4.0 * other[:, 0]) - other[:, 1] ** 2)
    assert error.mean() < 0.02 and (error < 4.0 * deviation + 1e-3).mean() > 0.9
    noisy = fitted(positions, values + 0.1 * rng.standard_normal(25), np.full(25, 0.1))
    assert np.abs(noisy.predict(positions)[0] - values).mean() < 0.08  # nearer than the noise


def test_the_search_finds_the_least_of_branins_function():
    """0.397887 in three places (Dixon and Szego 1978), with a constraint that leaves one of them."""
    positions = first_designs(2, 10, SEED)

    def branin(u):
        x, y = 15.0 * u[:, 0] - 5.0, 15.0 * u[:, 1]
        bowl = (y - 5.1 / (4.0 * np.pi**2) * x**2 + 5.0 / np.pi * x - 6.0) ** 2
        return bowl + 10.0 * (1.0 - 1.0 / (8.0 * np.pi)) * np.cos(x) + 10.0

    for k in range(12):
        goals, limits = branin(positions)[:, None], (positions[:, 0] - 0.3)[:, None]  # x below -0.5
        positions = np.vstack([positions, next_designs(told(positions, goals, limits), 2, SEED + k)])
    met = positions[:, 0] <= 0.3
    assert branin(positions)[met].min() < 0.42
    assert branin(positions)[~met].size < 15  # it does not look where the constraint is not met


def test_several_goals_are_one_by_weights_and_their_front_is_what_nothing_betters():
    goals = np.array([[0.0, 1.0], [1.0, 0.0], [0.5, 0.4], [0.6, 0.6], [0.5, 0.4]])
    assert pareto_front(goals).tolist() == [True, True, True, False, True]
    value, noise = scalar_goal(goals, np.full_like(goals, 0.1), np.random.default_rng(SEED))
    assert value.argmax() in (0, 1) and (noise > 0.0).all()


@pytest.mark.slow
def test_a_search_is_the_same_in_one_piece_and_resumed(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(STUDY)
    study = read_study(path)
    whole = search_designs(study, tmp_path / "whole", HerePool, False, lambda *_: None)
    with pytest.raises(KeyboardInterrupt):
        search_designs(study, tmp_path / "part", lambda: HerePool(stop_after=3), False, lambda *_: None)
    part = search_designs(study, tmp_path / "part", HerePool, True, lambda *_: None)
    for found, name in ((whole, "whole"), (part, "part")):
        write_optimisation(found, tmp_path / name)
    same = [(tmp_path / name / "designs.csv").read_bytes() for name in ("whole", "part")]
    assert same[0] == same[1]
    assert len(whole.designs) == 6
    assert whole.designs[0].values["bearing.diametral_clearance_um"] == 13.0  # the case itself
    best = whole.designs[whole.front[0] - 1]
    assert best.numbers["torque_N_mm"] <= min(d.numbers["torque_N_mm"] for d in whole.designs if d.feasible)
    gain = improvement(whole)
    assert whole.confirmed[0][0] == "case"
    assert gain["best"] < gain["case"] and gain["error"] is None and gain["proved"] is None
    told_words = list(confirmation_messages(whole))
    assert told_words[0].startswith("improvement.proved: null, torque_N_mm has no error bar; ehl.points in [proof]")
    assert len(told_words) == 1
    assert len(optimisation_table(whole).renderables) >= 4


def proof_of(tmp_path, fine, coarse=None, error=0.0, study=STUDY):
    """A study of one goal whose proof has these torques [N mm] of the case and design 2."""
    (tmp_path / "study.toml").write_text(study)
    study = read_study(tmp_path / "study.toml")

    def designs(torques):
        return [
            Design(
                number=k + 1,
                values={},
                numbers={"torque_N_mm": torque, "film_minimum_um": 0.6},
                errors={"torque_N_mm": error},
                feasible=torque is not None,
            )
            for k, torque in enumerate(torques)
        ]

    def named(torques):
        return tuple(zip(("case", "design 2"), designs(torques), strict=True))

    both = tuple(designs((100.0, 90.0)))
    return OptimisationResult(
        study=study, designs=both, front=(2,), confirmed=named(fine), coarse=named(coarse) if coarse else ()
    )


def test_a_gain_is_proved_where_half_the_nodes_change_it_less(tmp_path):
    gain = improvement(proof_of(tmp_path, (103.0, 93.0), (99.0, 90.0)))
    assert gain["error"] == pytest.approx(1.0) and gain["proved"] and gain["share"] == pytest.approx(10.0 / 103.0)
    assert not improvement(proof_of(tmp_path, (103.0, 93.0), (99.0, 100.0)))["proved"]
    assert improvement(proof_of(tmp_path, (103.0, 93.0), (99.0, 90.0), error=3.0))["error"] == pytest.approx(18.0**0.5)


def test_a_goal_that_is_to_be_large_gains_by_what_it_grows(tmp_path):
    """The same numbers exchanged: share and error as of a goal that is to be small."""
    large = STUDY.replace("minimise", "maximise")
    gain = improvement(proof_of(tmp_path, (93.0, 103.0), (90.0, 99.0), study=large))
    assert gain["share"] == pytest.approx(10.0 / 93.0) and gain["error"] == pytest.approx(1.0) and gain["proved"]
    loss = improvement(proof_of(tmp_path, (103.0, 93.0), (99.0, 90.0), study=large))
    assert loss["share"] == pytest.approx(-10.0 / 103.0) and not loss["proved"]


def test_why_there_is_no_gain_is_told(tmp_path):
    found = proof_of(tmp_path, (103.0, None))
    assert improvement(found) is None
    assert (
        next(confirmation_messages(found))
        == "improvement: null, none of design 2 converges and meets the constraints in the proof"
    )
    found = proof_of(tmp_path, (None, 90.0))
    assert next(confirmation_messages(found)) == "improvement: null, the case has no torque_N_mm in the proof"


def test_a_search_that_was_misled_is_told(tmp_path):
    told_words = list(confirmation_messages(proof_of(tmp_path, (103.0, 90.5), (103.0, 90.5))))
    assert told_words == ["case: torque_N_mm 100 in the search, 103 proved (2.9% off)"]


def test_a_robust_goal_is_a_quantile_over_the_scatter(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(STUDY.replace("first = 4", "first = 2").replace("designs = 6", "designs = 4"))
    plain = read_study(path)
    scattered = "[goal]\nscatter_samples = 3\nquantile = 0.9\n"
    text = path.read_text().replace("[goal]\n", scattered)
    path.write_text(text + '[scatter]\n"bearing.diametral_clearance_um" = { normal = [0.0, 2.0] }\n')
    robust = read_study(path)
    points = robust.sweep([[13.0, 26.1]]).points
    clearances = [point.given["bearing.diametral_clearance_um"] for point in points]
    assert len(set(clearances)) == 3 and np.mean(clearances) == pytest.approx(13.0, abs=1.0)
    assert len(plain.sweep([[13.0, 26.1]]).points) == 1


@pytest.mark.parametrize(("goal", "share"), [("minimise", 0.9), ("maximise", 0.1)])
def test_a_robust_number_is_that_of_the_bad_side(goal, share, tmp_path, monkeypatch):
    """Large of what is to be small, small of what is to be large; a limit at the side where it is broken."""
    text = STUDY.replace("minimise", goal).replace("[goal]\n", "[goal]\nscatter_samples = 3\nquantile = 0.9\n")
    path = tmp_path / "study.toml"
    path.write_text(text + '[scatter]\n"bearing.diametral_clearance_um" = { normal = [0.0, 2.0] }\n')
    torques, films = [90.0, 100.0, 130.0], [0.3, 0.5, 0.8]
    rows = [{"torque_N_mm": torque, "film_minimum_um": film} for torque, film in zip(torques, films, strict=True)]
    given = dict.fromkeys(("bearing.diametral_clearance_um", "lubricant.viscosity_mPa_s"), 13.0)
    points = [SimpleNamespace(converged=True, values=given, row=row, message="") for row in rows]
    monkeypatch.setattr(study_module, "point_numbers", lambda point: point.row)
    monkeypatch.setattr(study_module, "point_error", lambda row, head, unit: None)
    study = read_study(path)
    (design,) = study_module.designs_of(study, points, 0)
    assert design.numbers["torque_N_mm"] == pytest.approx(np.quantile(torques, share))
    assert design.numbers["film_minimum_um"] == pytest.approx(np.quantile(films, 0.1))
    assert not design.feasible  # 0.34 um of at least 0.35


WRONG = {
    STUDY.replace('"torque_N_mm"', '"torqe_N_mm"'): "did you mean 'torque_N_mm'",
    STUDY.replace("[8.0, 18.0]", "[18.0, 8.0]"): "allowed: [first, last], two numbers",
    STUDY.replace('minimise = "torque_N_mm"\n', ""): "needed: minimise or maximise",
    STUDY.replace('"film_minimum_um" = { least', '"film_minimm_um" = { least'): "did you mean 'film_minimum_um'",
    STUDY.replace("designs = 6", "designs = 1"): "search.designs: found 1",
}


@pytest.mark.parametrize(("text", "told_words"), WRONG.items())
def test_what_is_wrong_with_a_file_is_told(text, told_words, tmp_path):
    (tmp_path / "study.toml").write_text(text)
    with pytest.raises(CaseError) as caught:
        read_study(tmp_path / "study.toml")
    assert any(told_words in message for message in caught.value.messages), caught.value.messages


def test_a_file_that_is_not_there(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    answer = CliRunner().invoke(app, ["optimise", "6208_torqe"])
    assert answer.exit_code == 2
    assert "did you mean '6208_torque'" in answer.stderr
