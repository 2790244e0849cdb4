"""How warm does it get? Temperatures of oil and rings over the speed.

At each speed friction and cooling agree. Warm oil is thinner and has less friction, so that the temperature grows
slower than the speed.
"""

import oilfilm
from oilfilm.postprocess.plot_style import figure_of
from oilfilm.postprocess.temperatures.write import draw_temperatures

results = oilfilm.temperatures(oilfilm.load_case("6208_self_heating"))
figure_of(lambda figure: draw_temperatures(figure, results)).savefig("temperature_over_speed.png")
