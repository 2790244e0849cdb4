"""When does a ball skid? Hirano's slip factor over speed and axial load.

Below 10 the preload is too small for the speed: gyroscopic and centrifugal forces make the balls slide.
"""

import oilfilm
from oilfilm.cases.runs.stiffness_and_slip import run_slip
from oilfilm.postprocess.plot_style import figure_of
from oilfilm.postprocess.slip.write import draw_surface

case = oilfilm.load_case("hirano_7000C").with_values(
    {"slip.points": 15, "slip.critical_points": 5}
)
results = run_slip(case, "hirano_7000C", workers=1)
figure_of(lambda figure: draw_surface(figure, results)).savefig("skid_map.png")
