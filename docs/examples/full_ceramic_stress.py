"""Stress in a full-ceramic bearing: pressure and tension of each contact.

A ceramic does not yield; it breaks by tension, which is largest at the edge of the contact ellipse.
"""

import matplotlib.pyplot as plt

import oilfilm

frame = oilfilm.run("6208_full_ceramic", film_maps="none").to_dataframe()
loaded = frame[frame.load_N > 0.0]
print(
    loaded[["ball", "race", "load_N", "hertz_pressure_GPa", "edge_tension_GPa"]].to_string(
        index=False
    )
)

figure, (pressures, tensions) = plt.subplots(1, 2, figsize=(7.5, 3.4), layout="constrained")
for race, contacts in loaded.groupby("race"):
    pressures.plot(contacts.azimuth_deg, contacts.hertz_pressure_GPa, "o", label=f"{race} race")
    tensions.plot(contacts.azimuth_deg, contacts.edge_tension_GPa, "o", label=f"{race} race")
pressures.set(xlabel="azimuth of the ball [°]", ylabel="Hertz pressure [GPa]", ylim=0.0)
tensions.set(xlabel="azimuth of the ball [°]", ylabel="tension at the edge [GPa]", ylim=0.0)
pressures.legend(frameon=False)
figure.savefig("full_ceramic_stress.png")
