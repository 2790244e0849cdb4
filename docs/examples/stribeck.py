"""Stribeck's curve of a bearing: torque over speed, from mixed to full film.

At low speed asperities carry part of the load. As the speed grows, the film grows and their share falls; the rolling
resistance of the oil rises instead.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

case = oilfilm.load_case("6208_mixed_film")
speeds = np.geomspace(10.0, 6000.0, 12)
runs = [oilfilm.run(case, speed_rpm=float(speed), film_maps="none") for speed in speeds]
parts = [run.summary["torque_N_mm"]["models"]["integrated"] for run in runs]

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.semilogx(speeds, [1e3 * run.torque for run in runs], "k", label="total")
for name in ("rolling", "asperity", "curvature"):
    axes.semilogx(speeds, [part.get(name) or 0.0 for part in parts], label=name)
axes.set(xlabel="speed of the inner ring [r/min]", ylabel="friction torque [N mm]", ylim=0.0)
axes.legend(frameon=False)
figure.savefig("stribeck.png")
