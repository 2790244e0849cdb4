"""Three-dimensional views and VTK files."""
