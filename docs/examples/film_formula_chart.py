"""Films of all point contacts in one chart: by a formula of fifty coefficients.

Dimensionless, after Moes: each line is a contact of one oil and speed under growing load.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

loads = np.geomspace(7.0, 160.0, 60)
figure, axes = plt.subplots(figsize=(6.0, 3.8), layout="constrained")
for number, oil in enumerate((0.0, 5.0, 10.0, 20.0)):
    central, minimum = oilfilm.film_formula(loads, oil, 0.1)
    axes.loglog(loads, central, f"C{number}", label=f"L = {oil:g}")
    axes.loglog(loads, minimum, f"C{number}--")
axes.set(xlabel="load parameter A", ylabel="film / (R √2U)")
axes.minorticks_off()
for ticks, axis in (([10, 20, 50, 100], axes.xaxis), ([1, 2, 5], axes.yaxis)):
    axis.set_ticks(ticks, list(map(str, ticks)))
figure.legend(loc="outside right center", frameon=False, title="full: central\ndashed: minimum")
figure.savefig("film_formula_chart.png")
