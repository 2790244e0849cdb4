"""Heat in the film: how much of it inlet shear heating takes, over the speed.

Oil that is sheared in front of the contact is warm when it enters, and makes a thinner film.
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
axes.legend(frameon=False)
figure.savefig("heat_in_the_film.png")
