"""A first film: a steel ball on a glass disc.

The film is nearly uniform in the middle, and a third thinner at the constriction before the outlet. The dotted line is
the pressure of the dry contact after Hertz.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

contact = oilfilm.ContactConditions(
    load=15.0,  # [N]
    radius_x=0.0125,  # of the ball, as the disc is flat [m]
    radius_y=0.0125,
    reduced_modulus=110e9,  # [Pa]
    entrainment_speed=0.09,  # mean of both surfaces [m/s]
    lubricant=oilfilm.Lubricant(viscosity=0.04, pressure_viscosity=20e-9),
)
solution = oilfilm.solve_contact(contact, oilfilm.SolverOptions(points=129))
hertz = oilfilm.hertz_contact(
    contact.load, contact.radius_x, contact.radius_y, contact.reduced_modulus
)
print(
    f"minimum film {1e9 * solution.film_minimum:.1f} nm +- {1e9 * solution.film_minimum_uncertainty:.1f} nm"
)

middle = solution.y.size // 2
x = solution.x / hertz.semi_axis_x
figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.plot(x, 1e-9 * solution.pressure[:, middle], label="pressure")
dry = hertz.pressure * np.sqrt(np.clip(1.0 - x**2, 0.0, None))
axes.plot(x, 1e-9 * dry, "k:", label="dry, after Hertz")
axes.set(
    xlabel="position along the entrainment / semi-axis",
    ylabel="pressure [GPa]",
    xlim=(-2.0, 1.5),
    ylim=0.0,
)
films = axes.twinx()
films.plot(x, 1e9 * solution.film[:, middle], "C3", label="film")
films.set(ylabel="film [nm]", ylim=(0.0, 300.0))
figure.legend(loc="outside upper center", ncols=3, frameon=False)
figure.savefig("first_film.png")
