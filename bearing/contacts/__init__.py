"""The lubricated contacts that follow from an equilibrium: shape, motion, stress.

_kernels      - search for the largest sliding in ellipses, compiled
contact       - one contact of a ball with a race, placed in the bearing's frame
contacts      - the contacts of a solved bearing as lubricated contacts
electrical    - capacitance and breakdown voltage of a bearing between its rings
finite_bodies - difference of ring, ball and groove to half-spaces, radii of films with it
motion        - the one kinematics of ball on race: rolling, sliding and spin of both
stress        - stress below a contact and sliding in it
"""
