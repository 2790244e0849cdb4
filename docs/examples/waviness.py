"""Vibration by waviness: the spectrum of the acceleration.

Waves of a ring move it if their number is near a multiple of the number of balls; all others cancel.
"""

import matplotlib.pyplot as plt

from oilfilm.cases import load_case
from oilfilm.cases.runs.vibration import run_vibration
from oilfilm.postprocess.vibration.results import measured, spectrum

case = load_case("6208_waviness")
results = run_vibration(case, "6208_waviness")
seen = measured(results)
found = spectrum(seen.acceleration, seen.rate)
figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.semilogy(found.frequency, found.amplitude, linewidth=0.7)
axes.set(
    xlabel="frequency [Hz]", ylabel="acceleration [m/s²]", xlim=(0.0, 3000.0), ylim=(1e-5, 0.2)
)
figure.savefig("waviness.png")
