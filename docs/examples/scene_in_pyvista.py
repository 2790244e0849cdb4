"""The bearing with its films in three dimensions, by pyvista.

The patches of the films are magnified and lie on their balls. `oilfilm.view("scene_results")` opens a window.
"""

import oilfilm
from oilfilm.postprocess.scene.scene import screenshot

oilfilm.run("6208_full_ceramic", points=65).write("scene_results")
screenshot("scene_results", "scene_in_pyvista.png")
