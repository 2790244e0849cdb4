"""Torque over the oil supply: less oil brakes less, and makes thinner films.

The supply in mL/min becomes a layer in front of the contacts. Its thickness decides how much of the flooded film is
left, and how much oil has to be pushed away.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

case = oilfilm.load_case("6208_oil_supply")
supplies = np.geomspace(0.05, 20.0, 8)
runs = [oilfilm.run(case, supply_mL_min=float(supply), film_maps="none") for supply in supplies]

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.semilogx(supplies, [1e3 * run.torque for run in runs], "C0")
axes.set(xlabel="oil supply [mL/min]", ylim=0.0)
axes.set_ylabel("friction torque [N mm]", color="C0")
films = axes.twinx()
films.semilogx(supplies, [1e6 * run.film_minimum for run in runs], "C3")
films.set_ylabel("thinnest film [µm]", color="C3")
films.set_ylim(0.0)
figure.savefig("torque_over_oil_supply.png")
