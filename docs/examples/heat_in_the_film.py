"""Heat in the film: how much inlet shear heating reduces the film, over the speed.

The oil is sheared in front of the contact. It is warm when it enters and forms a thinner film.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

case = oilfilm.load_case("6208_oil_temperature")
speeds = np.geomspace(500.0, 12000.0, 7)
films = {"isothermal": [], "with heat": []}
for speed in speeds:
    inner = [
        c
        for c in oilfilm.run(case, speed_rpm=float(speed), film_maps="none").contacts
        if c["race"] == "inner"
    ]
    contact = max(inner, key=lambda contact: contact["load_N"])
    films["isothermal"].append(contact["isothermal_film_central_um"])
    films["with heat"].append(contact["film_central_um"])

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
for name, values in films.items():
    axes.loglog(speeds, values, "o-", label=name)
axes.set(xlabel="speed [r/min]", ylabel="central film of the heaviest contact [µm]")
axes.minorticks_off()
for ticks, axis in (([500, 1000, 2000, 5000, 10000], axes.xaxis), ([0.1, 0.2, 0.5], axes.yaxis)):
    axis.set_ticks(ticks, list(map(str, ticks)))
axes.legend(frameon=False)
figure.savefig("heat_in_the_film.png")
