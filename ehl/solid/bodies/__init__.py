"""Bodies of finite size: meshes of rings, their elasticity and heat conduction by finite elements.

compliance           - structural compliance of a ring at its balls, without that of a half-space
conduction           - heat conductances of a ring between its track, other surfaces and seat
elasticity           - linear elasticity on meshes of quadratic hexahedra
flat_block           - a flat block under the same nodal forces, half-space around it
hexahedra            - meshes of quadratic hexahedra and integrals of their shape functions
ring_difference      - surface of a ring under a contact, less that of a half-space
ring_field           - displacement of a whole ring under all its balls, by superposition
ring_mesh            - mesh of a grooved ring, alone or with its shaft or housing
ring_profile         - section of a grooved ring, and what it sits on
ring_stress          - stress in a ring below a contact: half-space and difference
seat_places          - a ring whose seat touches it at some azimuths only
smoothed_aggregation - linear systems of elasticity and conduction: multigrid, else factors
sphere               - surface of a ball under two opposite contacts, less that of a half-space
surface_difference   - the difference as constant, tilt, curvatures and rest
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
