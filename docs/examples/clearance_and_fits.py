"""From fits to clearance: how the load zone changes with the clearance in operation.

A large clearance puts the load on few balls; a preload presses all of them.
"""

import matplotlib.pyplot as plt

import oilfilm

case = oilfilm.load_case("6208_life")
figure, axes = plt.subplots(
    figsize=(5.0, 4.2), subplot_kw={"projection": "polar"}, layout="constrained"
)
for clearance in (-10.0, 0.0, 20.0, 60.0):
    changed = case.with_values({"bearing.diametral_clearance_um": clearance})
    state = oilfilm.solve_quasistatic(changed.bearing, changed.operation, changed.model)
    azimuth = [*changed.bearing.azimuths, changed.bearing.azimuths[0]]
    axes.plot(azimuth, [*state.inner_load, state.inner_load[0]], label=f"{clearance:.0f} µm")
axes.set_theta_zero_location("N")
axes.set_rgrids([500.0, 1000.0, 1500.0], angle=160.0)  # where no ball is loaded
axes.legend(title="clearance", frameon=False, loc="lower left", bbox_to_anchor=(1.0, 0.6))
axes.set_title("load of the balls [N]")
figure.savefig("clearance_and_fits.png")
