"""An oil by its data sheet: film and life over the temperature.

Every data sheet has two viscosities and the density. The rest is estimated by the kind of base oil, with ranges.
"""

import matplotlib.pyplot as plt

import oilfilm

case = oilfilm.load_case("6208_life").with_values(
    {
        "lubricant.name": None,
        "lubricant.kinematic_viscosity_40C_mm2_s": 46.0,
        "lubricant.kinematic_viscosity_100C_mm2_s": 7.9,
        "lubricant.density_15C_kg_m3": 830.0,
        "lubricant.base_oil": "PAO",
    }
)
temperatures = [30.0, 45.0, 60.0, 75.0, 90.0]
runs = [oilfilm.run(case, temperature_C=temperature) for temperature in temperatures]
figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.plot(temperatures, [1e6 * run.film_minimum for run in runs], "C0o-")
axes.set(xlabel="temperature [°C]", ylim=0.0)
axes.set_ylabel("thinnest film [µm]", color="C0")
lives = axes.twinx()
hours = [run.summary["life"]["modified_reference_rating_h"] for run in runs]
lives.plot(temperatures, [1e-3 * life for life in hours], "C3s-")
lives.set_ylim(0.0)
lives.set_ylabel("modified reference rating life [1000 h]", color="C3")
figure.savefig("own_oil.png")
