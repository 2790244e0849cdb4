"""A starved contact: the film over the layer of oil in front of it.

A thick layer gives the flooded film. A thin one passes the contact without loss: half of it leaves on each
surface. Error bars are those of the solver.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

layers = np.geomspace(0.03, 3.0, 7)  # [um]
runs = [
    oilfilm.run("ball_on_disc_starved", inlet_film_um=float(layer), points=129).summary
    for layer in layers
]

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
for key, name in (("film_central", "central film"), ("film_minimum", "minimum film")):
    films, bars = ([run[f"{key}{end}"] for run in runs] for end in ("_um", "_uncertainty_um"))
    axes.errorbar(layers, films, bars, fmt="o-", capsize=3, label=name)
axes.axhline(
    runs[-1]["flooded_film_central_um"], color="k", linestyle=":", label="flooded, central"
)
axes.plot(layers, layers, "0.6", label="as thick as the layer")
axes.set(
    xscale="log", xlabel="layer of oil at the inlet [µm]", ylabel="film [µm]", ylim=(0.0, 0.09)
)
axes.legend(frameon=False, fontsize="small", loc="upper right")
figure.savefig("starved_contact.png")
