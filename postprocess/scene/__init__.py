"""Three-dimensional views, files for ParaView, meshes for other programs.

geometry          - shapes of patches, balls, cage and rings, by lengths
vtk               - fields and bodies of results as VTK files
vtk_history       - motion of a simulation as steps for ParaView
export            - films and finite elements as meshes for other programs
subsurface        - stress below the contacts as volumes
scene             - what a scene shows; asks for a picture, page, movie or window
drawing           - the scene of results, drawn with pyvista
parts             - bodies, labels, colour bar and camera of a scene
patch             - the shown part of one contact, read from disk
page              - what a browser's page needs beside the bodies
controls          - slider, click and movie of one turn
animation         - asks for the GIF of a simulation
animation_frames  - the frames of that GIF, drawn with pyvista
rendering         - the process that draws, and what to do where it cannot
"""
