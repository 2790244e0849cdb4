"""Which size? Film, torque and life of four bearings of one series under the same load.

A larger one has thicker films, a longer life and more friction.
"""

import matplotlib.pyplot as plt

import oilfilm

names = ["6204", "6206", "6208", "6210"]
runs = [
    oilfilm.run(name, speed_rpm=3000, radial_N=1200, temperature="given", temperature_C=60.0)
    for name in names
]
figure, axes = plt.subplots(1, 3, figsize=(8.0, 3.0), layout="constrained")
axes[0].plot(names, [1e6 * run.film_minimum for run in runs], "o")
axes[1].plot(names, [1e3 * run.torque for run in runs], "o")
axes[2].plot(names, [run.summary["life"]["modified_reference_rating_h"] for run in runs], "o")
for panel, label in zip(
    axes, ("thinnest film [µm]", "torque [N mm]", "modified life [h]"), strict=True
):
    panel.set_ylabel(label)
    panel.set_ylim(0.0)
figure.savefig("sizes_compared.png")
