"""How sure is the film? Quantiles over what is not known exactly.

Clearance, viscosity and load are drawn from their ranges; each draw is a point of a batch.
"""

import math
import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import oilfilm
from oilfilm.cases.batch import LocalPool
from oilfilm.postprocess.batch.store import stored_summaries

SWEEP = """
case = "6208_full_ceramic"
[fixed]
"ehl.film_maps" = "none"
[latin_hypercube]
samples = 60
seed = 1
"bearing.diametral_clearance_um" = [8.0, 18.0]
"lubricant.viscosity_mPa_s" = [20.0, 32.0]
"operation.radial_load_N" = [2500.0, 3500.0]
"""
Path("unsure.toml").write_text(SWEEP)
if __name__ == "__main__":  # the workers are processes that read this file, too
    shutil.rmtree("unsure", ignore_errors=True)
    oilfilm.run_batch(oilfilm.read_sweep("unsure.toml"), Path("unsure"), lambda: LocalPool(2))
    films = []
    for _, summary in stored_summaries("unsure"):
        films.append(
            min(contact["film_minimum_um"] or math.inf for contact in summary["contacts"])
        )
    print("quantiles of 5, 50 and 95 % [um]:", np.quantile(films, [0.05, 0.5, 0.95]).round(3))
    figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
    axes.ecdf(films)
    axes.set(xlabel="thinnest film [µm]", ylabel="share of the draws with a thinner one")
    figure.savefig("batch_quantiles.png")
