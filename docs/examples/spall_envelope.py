"""A spall of the outer race in the envelope of the housing's vibration.

Each ball that passes the spall causes an impact. The envelope of the signal has lines at the frequency of the passing
balls, BPFO, and at its multiples.
"""

import matplotlib.pyplot as plt

from oilfilm.cases import load_case
from oilfilm.cases.runs.vibration import run_vibration
from oilfilm.postprocess.vibration.results import envelope, envelope_band, measured, spectrum
from oilfilm.postprocess.vibration.summary import vibration_summary

case = load_case("6205_outer_defect")
results = run_vibration(case, "6205_outer_defect")
seen = measured(results)
found = spectrum(envelope(seen.acceleration, seen.rate, envelope_band(results)), seen.rate)
passing = vibration_summary(results)["frequencies_Hz"]["with_slip"]["ball_pass_outer"]

figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.plot(found.frequency, found.amplitude, linewidth=0.8)
for multiple in (1, 2, 3, 4):
    axes.axvline(
        multiple * passing,
        color="C3",
        linestyle=":",
        label="BPFO and multiples" if multiple == 1 else None,
    )
axes.set(
    xlabel="frequency [Hz]",
    ylabel="envelope of the acceleration [m/s²]",
    xlim=(0.0, 4.8 * passing),
    ylim=(0.0, 1.2 * found.amplitude.max()),
)
axes.legend(frameon=False)
figure.savefig("spall_envelope.png")
