"""Traction of a lubricated contact: sliding inside the ellipse, shear on both surfaces, forces,
moments, tables.

_block_kernels      - sums over the nodes of a film for many motions, compiled
_kapitza_kernels    - integral of the pressure of rigid bodies, compiled
_kernels            - sums over the nodes of a film, and lookups in a table, compiled
_spline_kernels     - splines over the axes of a table, compiled
atlas               - films and rolling moment of a contact from a table of solved ones
coefficient_kernels - coefficients by the local sliding, each law whole: Coulomb, four constants
film_quadrature     - quadrature over a solved film, and its sliding forces for many motions
heated              - shear of films that sliding heats
instruments         - capacitance, breakdown voltage and sound of a solved film
kapitza             - moment of rigid bodies' pressure, up to the meniscus of the oil
law                 - the law of traction: forces and moments over load and motion
laws                - laws by a coefficient over the ellipse
oil_around          - gap of the oil beyond the box of a solve, up to its meniscus
oil_extent          - gap of two circles, in which the oil of a contact ends
quadrature          - rings and lines of nodes over the ellipse of Hertz
response            - stiffness and damping of a lubricated contact
rolling_moment      - hydrodynamic rolling moment of a contact's oil, up to its meniscus
shear               - shear stress on both surfaces of a solved contact, and its integrals
table               - traction tables: films, sampling, storage, interpolation
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
