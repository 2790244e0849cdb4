"""Blocks of points that are drawn at random: laws, correlations, designs, and what their results tell."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy import stats

from oilfilm.cases.batch.engine import run_batch
from oilfilm.cases.batch.results import load_results, write_batch
from oilfilm.cases.batch.samples import unit_sample
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.postprocess.batch.summary import batch_summary, batch_table
from oilfilm.postprocess.report.batch import uncertainty

from .test_batch import HEAD, HerePool, messages

QUICK = HEAD + '[fixed]\n"ehl.film_maps" = "none"\n'
LOAD, SPEED = '"operation.radial_load_N"', '"operation.inner_speed_rpm"'


def drawn(text):
    """Values of the load, as given, of all points."""
    sweep = sweep_from_text(QUICK + text, "sweep.toml")
    return np.array([[point.given[key] for key in sweep.keys] for point in sweep.points])


LAWS = {
    "{ normal = [1500.0, 200.0] }": stats.norm(1500.0, 200.0),
    "{ lognormal = [1500.0, 0.2] }": stats.lognorm(0.2, scale=1500.0),
    "{ triangular = [1000.0, 1200.0, 2000.0] }": stats.triang(0.2, loc=1000.0, scale=1000.0),
    "{ truncated_normal = [1500.0, 500.0, 1000.0, 2000.0] }": stats.truncnorm(-1, 1, loc=1500.0, scale=500.0),
    "{ uniform = [1000.0, 2000.0] }": stats.uniform(1000.0, 1000.0),
    "[1000.0, 2000.0]": stats.uniform(1000.0, 1000.0),
}


@pytest.mark.parametrize(("law", "exact"), LAWS.items())
@pytest.mark.parametrize("method", ["sobol", "latin hypercube"])
def test_laws(law, exact, method):
    """Every stratum of the law holds one point: no share is further from its own than 1/n."""
    found = np.sort(drawn(f'[sample]\nmethod = "{method}"\nsamples = 64\n{LOAD} = {law}\n').ravel())
    shares = exact.cdf(found)
    assert np.abs(shares - (np.arange(64) + 0.5) / 64).max() < 0.6 / 64


def test_correlations_are_those_of_the_normal_scores():
    text = f"[sample]\nsamples = 512\ncorrelations = [[{LOAD}, {SPEED}, -0.7]]\n"
    text += f"{LOAD} = {{ normal = [1500.0, 200.0] }}\n{SPEED} = {{ normal = [8000.0, 500.0] }}\n"
    assert np.corrcoef(drawn(text).T)[0, 1] == pytest.approx(-0.7, abs=0.05)


def test_a_seed_gives_the_same_points():
    text = f"[sample]\nsamples = 8\n{LOAD} = [400.0, 3000.0]\n"
    assert (drawn(text) == drawn(text)).all()
    assert (drawn(text) != drawn(text.replace("samples", "seed = 7\nsamples"))).any()
    assert unit_sample("random", 2, 5, 7).shape == (5, 2)


WRONG = {
    f"[sample]\nsamples = 8\n{LOAD} = {{ normal = [1500.0, -2.0] }}\n": "allowed: [first, last], or one of",
    f"[sample]\nsamples = 8\n{LOAD} = {{ gamma = [1.0, 2.0] }}\n": "gamma",
    f"[sample]\nsamples = 8\n{LOAD} = {{ triangular = [3.0, 2.0, 4.0] }}\n": "triangular = [first, mode, last]",
    f'[sample]\nmethod = "sobol"\nsamples = 60\n{LOAD} = [1.0, 2.0]\n': "found 60; allowed: a power of 2, as 64",
    "[sample]\nsamples = 8\n": "no keys",
    f"[sample]\nsamples = 8\ncorrelations = [[{LOAD}, {SPEED}, 0.5]]\n{LOAD} = [1.0, 2.0]\n": "two keys of this block",
    f"[sobol_indices]\nsamples = 6\n{LOAD} = [1.0, 2.0]\n": "found 6; allowed: a power of 2",
    f"[morris]\nlevels = 5\n{LOAD} = [1.0, 2.0]\n": "levels",
}


@pytest.mark.parametrize(("text", "told"), WRONG.items())
def test_what_is_wrong_with_a_block_is_told(text, told):
    assert any(told in message for message in messages(QUICK + text))


def test_correlations_that_cannot_be_are_told():
    text = '[sample]\nsamples = 8\n"operation.radial_load_N" = [1.0, 2.0]\n"operation.inner_speed_rpm" = [1.0, 2.0]\n'
    text += '"operation.temperature_C" = [30.0, 50.0]\n'
    pairs = [(LOAD, SPEED, 0.9), (LOAD, '"operation.temperature_C"', 0.9), (SPEED, '"operation.temperature_C"', -0.9)]
    rows = ", ".join(f"[{a}, {b}, {r}]" for a, b, r in pairs)
    text = text.replace("samples = 8\n", f"samples = 8\ncorrelations = [{rows}]\n")
    assert any("no distribution has all of these correlations" in message for message in messages(QUICK + text))


@pytest.mark.slow
def test_designs_are_in_the_summary(tmp_path):
    """The load decides the largest load, the speed nearly nothing of it; bands say from how many points."""
    keys = f"{LOAD} = [400.0, 3000.0]\n{SPEED} = [5000.0, 5500.0]\n"
    text = f'[sample]\nmethod = "sobol"\nsamples = 8\n{keys}[morris]\ntrajectories = 2\n{keys}'
    text += f"[sobol_indices]\nsamples = 4\n{keys}"
    results = load_results(run_batch(sweep_from_text(QUICK + text, "sweep.toml"), tmp_path / "out", HerePool))
    assert len(results.points) == 8 + 2 * 3 + 4 * 4
    write_batch(results, tmp_path / "out")
    document = json.loads((tmp_path / "out" / "summary.json").read_text())
    effects = document["morris"]["results"]["load_maximum_N"]
    assert effects["operation.radial_load_N"]["mean_magnitude"] > 500.0
    assert effects["operation.inner_speed_rpm"]["mean_magnitude"] < 50.0
    indices = document["sobol_indices"]["results"]["load_maximum_N"]
    assert indices["operation.inner_speed_rpm"]["total"] < 0.01 < indices["operation.radial_load_N"]["total"]
    band = document["bands"]["load_maximum_N"]
    assert band["points"] == 8
    assert band["q50_low"] <= band["q50"] <= band["q50_high"]
    assert band["q95_high"] is None  # eight points do not bound it
    assert "Sobol indices from 16 points" in uncertainty(batch_summary(results))
    assert len(batch_table(batch_summary(results)).renderables) >= 5


@pytest.mark.slow
def test_indices_of_a_design_with_gaps_are_null_with_the_reason(tmp_path, monkeypatch):
    from oilfilm.cases.batch.compute import failure

    original = HerePool.submit

    def submit(self, block):
        future = original(self, block)
        if len(self.handed_out) == 2:
            future.set_result = None
            future._result = (failure(block[0].key, "failed", "no equilibrium"),)
        return future

    monkeypatch.setattr(HerePool, "submit", submit)
    text = QUICK + f"[sobol_indices]\nsamples = 4\n{LOAD} = [400.0, 3000.0]\n"
    results = load_results(run_batch(sweep_from_text(text, "sweep.toml"), tmp_path / "out", HerePool))
    found = batch_summary(results)["sobol_indices"]["results"]["load_maximum_N"]
    assert found == "null, 1 of 12 points have no result"
