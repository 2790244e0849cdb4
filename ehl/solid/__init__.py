"""The bodies: elastic deflection, coatings, heat conduction, stress below the contact.

bodies               - bodies of finite size: rings, by finite elements
_conductance_kernels - march of the heat through films along lines of rolling, compiled
coating              - a coated body, and its compliance
compliance           - half-space compliance of bilinear pressures on a graded rectangular mesh
deformation          - elastic deflection of the half-space by convolution
film_conductance     - heat that a rolling contact conducts through its film
heat                 - bodies as half-spaces that move past a source of heat
layered              - compliance of a contact one body of which is coated
layered_fem          - surface compliance of a coated half space by axisymmetric finite elements
surface_stress       - stress in the surface of a half-space under pressure and shear
subsurface           - stress in a half-space below a given pressure
"""
