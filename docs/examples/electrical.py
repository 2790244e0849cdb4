"""Electrical capacitance of a motor's bearing over the speed: steel balls and a film that insulates.

The film is the dielectric; it grows with the speed, and the capacitance falls.
"""

import matplotlib.pyplot as plt
import numpy as np

import oilfilm

case = oilfilm.load_case("6206_motor_steel")
speeds = np.linspace(500.0, 6000.0, 5)
runs = [oilfilm.run(case, speed_rpm=float(speed), points=65).summary for speed in speeds]
figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.plot(speeds, [run["electrical"]["capacitance_pF"] for run in runs], "C0o-")
axes.set(xlabel="speed [r/min]", ylim=0.0)
axes.set_ylabel("capacitance [pF]", color="C0")
volts = axes.twinx()
volts.plot(speeds, [run["electrical"]["breakdown_voltage_V"] for run in runs], "C3s-")
volts.set_ylabel("breakdown voltage [V]", color="C3")
volts.set_ylim(0.0)
figure.savefig("electrical.png")
