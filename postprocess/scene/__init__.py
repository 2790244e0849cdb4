"""Three-dimensional views, files for ParaView, meshes for other programs.

drawing        - the scene of results, drawn with pyvista, controls of its window, its page for
                 browsers
export         - films and finite elements as meshes for other programs
geometry       - shapes of patches, balls, cage and rings, by lengths
live           - a scene that follows the results: bodies stay, films are exchanged
live_arrays    - bodies and films of results as plain arrays, for such a scene
parts          - bodies, labels, colour bar and camera of a scene
patch          - the shown part of one contact, read from disk
render_process - scenes drawn in a process of their own, their controls, and as one page for
                 browsers
scene          - what a scene shows; asks for picture, page, movie, window, GIF
transient      - a contact over time for ParaView and as a movie, a simulation as a GIF
vtk            - fields and bodies of results as VTK files
vtk_history    - motion of a simulation as steps for ParaView
"""
