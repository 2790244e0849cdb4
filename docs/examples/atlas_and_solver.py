"""The film atlas and the solver: the same film in a thousandth of the time.

The atlas is a table of solved films with an error of its own. It reports contacts outside its range.
"""

from dataclasses import replace
from time import perf_counter

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

oil = oilfilm.Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
contact = oilfilm.ContactConditions(
    load=60.0,
    radius_x=0.004,
    radius_y=0.06,
    reduced_modulus=230e9,
    entrainment_speed=1.0,
    lubricant=oil,
)
speeds = np.geomspace(0.5, 10.0, 13)
oilfilm.atlas_films(contact)  # reads the atlas
start = perf_counter()
atlas = [
    oilfilm.atlas_films(replace(contact, entrainment_speed=speed)).central for speed in speeds
]
between = perf_counter()
few = speeds[::4]
solved = [oilfilm.solve_contact(replace(contact, entrainment_speed=speed)) for speed in few]
took = (between - start) / speeds.size, (perf_counter() - between) / few.size
print(f"a film by the atlas {1e3 * took[0]:.2f} ms, solved {took[1]:.1f} s")

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
values, bars = (
    1e6 * np.array([getattr(film, name) for film in atlas]) for name in ("value", "uncertainty")
)
axes.loglog(speeds, values, label="atlas")
axes.fill_between(speeds, values - bars, values + bars, alpha=0.3, label="its error")
axes.loglog(few, [1e6 * solution.film_central for solution in solved], "ko", label="solved")
axes.set(xlabel="entrainment speed [m/s]", ylabel="central film [µm]")
axes.minorticks_off()
for ticks, axis in (([0.5, 1, 2, 5, 10], axes.xaxis), ([0.1, 0.2, 0.5, 1], axes.yaxis)):
    axis.set_ticks(ticks, list(map(str, ticks)))
axes.legend(frameon=False)
figure.savefig("atlas_and_solver.png")
