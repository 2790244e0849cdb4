"""Stiffness of an angular contact bearing over its preload, at three speeds.

With the speed centrifugal forces change the contact angles: the bearing becomes softer along the shaft.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

case = oilfilm.load_case("7008_axial")
preloads = np.linspace(60.0, 600.0, 10)
figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
for speed in (1000.0, 10000.0, 20000.0):
    stiffness = []
    for preload in preloads:
        changed = case.with_values(
            {"operation.inner_speed_rpm": speed, "operation.axial_load_N": float(preload)}
        )
        state = oilfilm.solve_quasistatic(changed.bearing, changed.operation, changed.model)
        stiffness.append(1e-6 * state.stiffness[0, 0])
    axes.plot(preloads, stiffness, label=f"{speed:.0f} r/min")
axes.set(xlabel="axial preload [N]", ylabel="axial stiffness [N/µm]", ylim=0.0)
axes.legend(frameon=False)
figure.savefig("stiffness_over_preload.png")
