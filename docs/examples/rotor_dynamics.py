"""Bearing coefficients for a rotor code: stiffness over speed in the axes of ROSS.

With ROSS installed, `ross.BearingElement(n=3, **table)` is the bearing of the rotor's node 3.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm
from oilfilm.bearing import stiffness_over_speed
from oilfilm.postprocess.stiffness.results import ross_table

case = oilfilm.load_case("7008_combined")
speeds = np.linspace(50.0, 2000.0, 12)  # [rad/s]
study = stiffness_over_speed(case.bearing, case.operation, speeds, case.model)
table = ross_table(study)

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
for name in ("kxx", "kyy", "kzz"):
    axes.plot(table["speed"], 1e-6 * table[name], label=name)
axes.set(xlabel="speed [rad/s]", ylabel="stiffness [N/µm]", ylim=0.0)
axes.legend(frameon=False, title="axes of ROSS, z along the shaft")
figure.savefig("rotor_dynamics.png")
