"""A dent passes a contact: films and pressures while it does.

A dent of the disc is slower than the ball. The oil that it carries changes the film in front of it and behind it.
"""

from oilfilm.cases import load_case
from oilfilm.cases.runs.transient import run_transient
from oilfilm.postprocess.contact.transient_plots import draw_transient
from oilfilm.postprocess.plot_style import figure_of

case = load_case("dent_with_slip").with_values({"ehl.points": 65})
results = run_transient(case, "dent_with_slip")
figure = figure_of(lambda figure: draw_transient(figure, results.solution, results.title))
figure.savefig("dent_over_time.png")
