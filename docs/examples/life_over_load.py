"""Rating life over the load, compared with the cube law of the catalogue.

The modified life accounts for the film, by the viscosity ratio, and for the cleanliness of the oil.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

case = oilfilm.load_case("6208_life")
loads = np.geomspace(1000.0, 10000.0, 7)
lives = [oilfilm.run(case, radial_N=float(load)).summary["life"] for load in loads]
reference = np.array([life["basic_reference_rating_h"] for life in lives])

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.loglog(loads, reference, "o-", label="basic, by the loads of the balls")
axes.loglog(loads, [life["modified_reference_rating_h"] for life in lives], "s-", label="modified")
axes.loglog(loads, reference[3] * (loads[3] / loads) ** 3, "k:", label="cube law")
axes.set(xlabel="radial load [N]", ylabel="life of 90 % of the bearings [h]")
axes.legend(frameon=False)
figure.savefig("life_over_load.png")
