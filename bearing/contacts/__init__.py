"""The lubricated contacts that follow from an equilibrium: shape, motion, stress.

_kernels      - search for the largest sliding in ellipses, compiled
contact       - one contact of a ball with a race, placed in the bearing's frame
contacts      - the contacts of a solved bearing as lubricated contacts
electrical    - capacitance and breakdown voltage of a bearing between its rings
finite_bodies - difference of ring, ball and groove to half-spaces, radii of films with it
hertz         - Hertz contacts of many balls at once
motion        - the one kinematics of ball on race: rolling, sliding and spin of both
shape         - curvatures and ellipse of a contact, as the laws of friction take them
shoulder      - distance of ellipses to the shoulders, what these cut off, pressure of what is left
surface_tension - largest tension in the surfaces of ring and ball
stress        - stress below a contact and sliding in it
traction      - shear of the film of one contact at the motion of its ball
"""
