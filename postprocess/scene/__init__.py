"""Three-dimensional views, files for ParaView, meshes for other programs.

geometry          - shapes of patches, balls, cage and rings, by lengths
vtk               - fields and bodies of results as VTK files
vtk_history       - motion of a simulation as steps for ParaView
transient         - a contact over time for ParaView, and as a movie
export            - films and finite elements as meshes for other programs
hexahedra         - cells between the nodes of a grid in space
ring_deformed     - elastic rings with their displacement, for ParaView and other programs
ring_stress       - stress in rings below their contacts, for other programs
subsurface        - stress below the contacts as volumes
scene             - what a scene shows; asks for picture, page, movie, window, GIF
deformed          - elastic rings as a scene shows them
drawing           - the scene of results, drawn with pyvista
parts             - bodies, labels, colour bar and camera of a scene
arrows            - loads, rotation and axes of a scene as arrows
patch             - the shown part of one contact, read from disk
page              - what a browser's page needs beside the bodies
controls          - slider, click and movie of one turn
animation_frames  - the frames of the GIF of a simulation, drawn with pyvista
rendering         - the process that draws, and what to do where it cannot
"""
