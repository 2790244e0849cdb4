"""A spindle pair, 7008 back to back: where the load goes over the speed.

Centrifugal forces press the balls outwards, so that the load of the outer race grows faster than that of the inner.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

case = oilfilm.load_case("7008_back_to_back")
speeds = np.linspace(1000.0, 16000.0, 7)
runs = [oilfilm.run(case, speed_rpm=float(speed), film_maps="none") for speed in speeds]

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
for race in ("inner", "outer"):
    loads = [[c["load_N"] for c in run.contacts if c["race"] == race] for run in runs]
    axes.fill_between(
        speeds,
        np.min(loads, axis=1),
        np.max(loads, axis=1),
        alpha=0.3,
        label=f"{race} race, all balls",
    )
axes.set(xlabel="speed [r/min]", ylabel="contact load [N]", ylim=0.0)
axes.legend(frameon=False)
figure.savefig("spindle_pair.png")
