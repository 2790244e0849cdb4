"""Fields of a run with xarray: pressure and film of one contact from `results.nc`.

The tree has a group for each contact; fields are read from the disk when they are used.
"""

import matplotlib.pyplot as plt

import oilfilm

oilfilm.run("6208_full_ceramic", points=65, film_maps=[0.0]).write("fields_results")
with oilfilm.open_results("fields_results") as results:
    contact = results["contacts/ball01/inner"].to_dataset().load()
contact = contact.assign_coords(x=1e3 * contact["x"], y=1e3 * contact["y"])  # [mm]
print(contact)

figure, axes = plt.subplots(1, 2, figsize=(8.0, 3.4), layout="constrained")
(1e-9 * contact["P"]).plot(ax=axes[0], x="x", cbar_kwargs={"label": "pressure [GPa]"})
(1e6 * contact["h"]).plot(ax=axes[1], x="x", vmax=2.0, cbar_kwargs={"label": "film [µm]"})
for axis in axes:
    axis.set(
        xlim=(-0.4, 0.25),
        ylim=(-3.0, 3.0),
        xlabel="along the entrainment [mm]",
        ylabel="across [mm]",
    )
figure.savefig("fields_in_xarray.png")
