"""Bodies of finite size: meshes of rings, elasticity, heat and thermal stress by finite elements.

compliance             - structural compliance of a ring at its balls, without that of a half-space
conduction             - heat from the track of a ring to its seat, and the stress that it makes
elasticity             - linear elasticity on meshes of quadratic hexahedra
finite_body_correction - surface of a grooved ring under a contact, less that of a half-space
ring                   - stress in a grooved ring below a contact
ring_mesh              - mesh of a grooved ring, alone or with its shaft or housing
ring_profile           - section of a grooved ring, and what it sits on
surface_difference     - the difference as constant, tilt, curvatures and rest
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
