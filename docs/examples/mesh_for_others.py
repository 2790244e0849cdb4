"""Films as meshes for other programs: results to Gmsh's format, read back by meshio.

`oilfilm export` writes XDMF, Abaqus input, Gmsh and VTK files.
"""

from pathlib import Path

import meshio

import oilfilm
from oilfilm.cases.runs.export import export_meshes

oilfilm.run("6208_full_ceramic", points=65, film_maps=[0.0]).write("mesh_results")
for file in export_meshes(Path("mesh_results"), Path("mesh.msh")):
    mesh = meshio.read(file)
    print(file, mesh.points.shape, list(mesh.point_data))
