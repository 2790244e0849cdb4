"""A cage runs up: the time simulation of a 6304 from rest.

The inner ring drives the balls, and the balls drive the cage. Until the balls roll, they slide.
"""

from pathlib import Path

import matplotlib.pyplot as plt

from oilfilm.cases import load_case
from oilfilm.cases.runs.dynamics import run_dynamics
from oilfilm.postprocess.dynamics.read import open_history
from oilfilm.postprocess.dynamics.results import dynamics_summary

case = load_case("6304_planar").with_values({"dynamics.end_time_s": 0.4})
results = run_dynamics(case, "6304_planar", Path("cage_run_up.nc"))
print(f"cage {dynamics_summary(results)['cage_speed_rpm']:.0f} r/min")
history = open_history("cage_run_up.nc")
RPM = 30.0 / 3.141592653589793  # of 1 rad/s
cage = RPM * history.cage_velocity.sel(cage_coordinate="rotation")
sliding = abs(history.contact_slide_x.sel(race="inner")).mean("ball")

figure, (speeds, slides) = plt.subplots(
    2, 1, figsize=(6.0, 4.6), sharex=True, layout="constrained"
)
speeds.plot(history.time, cage)
speeds.set(ylabel="speed of the cage [r/min]")
slides.plot(history.time, sliding, "C3")
slides.set(xlabel="time [s]", ylabel="sliding at the inner race [m/s]", ylim=0.0)
figure.savefig("cage_run_up.png")
