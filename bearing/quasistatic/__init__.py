"""Quasi-static equilibrium of rings and balls.

_ball_kernels        - balance of balls for complex steps, compiled
_equilibrium_kernels - equilibrium of balls at a given position of the ring, compiled
ball_equilibrium     - equilibrium of every ball at a given position of the ring, Newton's method
balls                - balls between the races: forces at given positions
contact_stiffness    - Hertz stiffness of ball and race as a smooth function of the contact angle
elastic_balls        - balls between elastic rings
kinematics           - rolling of a ball between two races, and the body forces of its motion
limits               - how far contacts reach and what friction they give
ring                 - balance of the inner ring on its balls: Newton's method
ring_displacement    - displacement of whole elastic rings under all balls
solution             - result of the quasi-static equilibrium of a bearing
solver               - quasi-static equilibrium of a ball bearing in five degrees of freedom
symmetric            - the same by the balls that differ under the loads
thrust               - a row at rest under a thrust alone, in closed form
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
