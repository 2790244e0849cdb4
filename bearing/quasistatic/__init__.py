"""Quasi-static equilibrium of rings and balls.

_kernels   - equilibrium of balls at a position of the inner ring, compiled
balls      - balls between the races: forces and equilibrium at a position of the ring
kinematics - rolling of a ball, body forces of its motion, stiffness of its contacts
ring       - balance of the inner ring on its balls: Newton's method
solution   - result of the equilibrium, and its characteristic frequencies
solver     - quasi-static equilibrium of a ball bearing in five degrees of freedom
symmetric  - the same by the balls that differ under the loads
thrust     - balls without centrifugal force: under a thrust, and of one row at rest
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
