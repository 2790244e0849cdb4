"""The bodies: elastic deflection, coatings, heat conduction, stress below the contact.

_kernels         - compiled march of the heat through films along lines of rolling
bodies           - bodies of finite size: rings and balls
compliance       - half-space compliance of bilinear pressures on a graded rectangular mesh
deformation      - elastic deflection of the half-space by convolution
film_conductance - conductance of heat from a film into two bodies
heat             - bodies as half-spaces that move past a source of heat
layered          - compliance of a contact one body of which is coated
subsurface       - stress in a half-space below a given pressure
"""

import lazy_loader

# the elements of coatings load scikit-fem, which few contacts need
__getattr__, __dir__, __all__ = lazy_loader.attach(__name__, submodules=["layered"])
