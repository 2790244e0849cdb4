"""Traction of a lubricated contact: sliding inside the ellipse, shear on both surfaces, forces,
moments, tables.

_heated_kernels       - heat of sliding in a film that is sheared
_kernels              - sums over the nodes of a film, lookups in a table, Kapitza's moment,
                        compiled
_spline_kernels       - splines over the axes of a table, compiled
film_quadrature       - quadrature over a solved film, and its sliding forces for many motions
friction_coefficients - coefficients of friction by the local sliding, each law whole
instruments           - capacitance, breakdown voltage and sound of a solved film
law                   - the law of traction: forces and moments over load and motion
linear_response       - stiffness and damping of a lubricated contact along its normal, with error
                        bars
rolling_moment        - hydrodynamic rolling moment of a contact's oil, up to its meniscus
shear                 - shear stress on both surfaces of a solved contact, and its integrals
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
