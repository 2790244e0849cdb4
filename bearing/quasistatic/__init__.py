"""Quasi-static equilibrium of rings and balls.

_kernels   - compiled equilibrium of balls at a given position of the inner ring, each by itself;
             the NumPy twin, of all balls together, is `solve_balls_twin` of tests/reference
balls      - balls between the races: forces at given positions
kinematics - rolling of a ball between two races, and the body forces of its motion
ring       - balance of the inner ring on its balls: Newton's method
solution   - result of the quasi-static equilibrium of a bearing
solver     - quasi-static equilibrium of a ball bearing in five degrees of freedom
symmetric  - the same by the balls that differ under the loads
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
