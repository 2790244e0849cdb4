"""Traction of squalane over the slide-roll ratio, at three pressures.

A little sliding shears the film like a Newtonian oil; more of it thins the oil, until the stress no longer grows.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

ratios = np.geomspace(0.001, 0.5, 8)
figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
for load in (4.6, 18.8, 80.8):
    runs = [
        oilfilm.run(
            "squalane_ball_on_disc", load_N=load, slide_roll_ratio=float(ratio), points=65
        ).summary
        for ratio in ratios
    ]
    pressure = runs[0]["hertz_pressure_GPa"]
    axes.semilogx(
        ratios, [run["traction_coefficient"] for run in runs], "o-", label=f"{pressure:.1f} GPa"
    )
axes.set(xlabel="slide-roll ratio", ylabel="traction coefficient", ylim=0.0)
axes.legend(frameon=False, title="Hertz pressure")
figure.savefig("traction_curve.png")
