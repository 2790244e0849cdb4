"""A motor shaft on two bearings: deflection, and the load of each bearing.

The bearings' own stiffness, which grows with their load, carries the shaft.
"""

from oilfilm.cases.format.shaft_case import load_shaft
from oilfilm.cases.runs.shaft import run_shaft
from oilfilm.postprocess.plot_style import figure_of
from oilfilm.postprocess.shaft.results import shaft_summary
from oilfilm.postprocess.shaft.write import draw_shaft

results = run_shaft(load_shaft("spindle_two_bearings"))
summary = shaft_summary(results)
print("critical speeds [r/min]:", [round(speed) for speed in summary["critical_speeds_rpm"]])
for bearing in summary["bearings"]:
    heaviest = max(contact["load_N"] for contact in bearing["contacts"])
    print(f"{bearing['case']['bearing']['name']}: heaviest ball {heaviest:.0f} N")
figure_of(lambda figure: draw_shaft(figure, results)).savefig("shaft_two_bearings.png")
