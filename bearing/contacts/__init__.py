"""The lubricated contacts that follow from an equilibrium: shape, motion, stress.

contact       - one contact of a ball with a race, placed in the bearing's frame
contacts      - the contacts of a solved bearing as lubricated contacts
electrical    - capacitance and breakdown voltage of a bearing between its rings
finite_bodies - difference of ring, ball and groove to half-spaces, radii of films with it
motion        - kinematics of ball on race (rolling, sliding, spin), traction there
shape         - shape of a contact between ball and race
stress        - stress in and below a contact, sliding in it, shoulders
"""
