"""Steel, hybrid, full ceramic: loads and pressures of the same bearing in three materials at high speed.

Lighter balls press less on the outer race; the stiffer ceramic makes smaller contacts and higher pressures.
"""

import matplotlib.pyplot as plt

import oilfilm

case = oilfilm.load_case("7008_combined")
kinds = {
    "steel": ("bearing steel", "bearing steel"),
    "hybrid": ("bearing steel", "silicon nitride"),
    "full ceramic": ("silicon nitride", "silicon nitride"),
}
figure, (loads, pressures) = plt.subplots(1, 2, figsize=(8.0, 3.4), layout="constrained")
for name, (ring, ball) in kinds.items():
    values = {
        "bearing.ring_material": ring,
        "bearing.ball_material": ball,
        "operation.inner_speed_rpm": 20000.0,
    }
    frame = oilfilm.run(case.with_values(values), film_maps="none").to_dataframe()
    outer = frame[frame.race == "outer"]
    loads.plot(outer.azimuth_deg, outer.load_N, "o-", label=name)
    pressures.plot(outer.azimuth_deg, outer.hertz_pressure_GPa, "o-", label=name)
loads.set(xlabel="azimuth [°]", ylabel="load of the outer contact [N]", ylim=0.0)
pressures.set(xlabel="azimuth [°]", ylabel="Hertz pressure [GPa]", ylim=0.0)
loads.legend(frameon=False)
figure.savefig("three_materials.png")
