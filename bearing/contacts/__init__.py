"""The lubricated contacts that follow from an equilibrium: shape, motion, stress.

contacts - the contacts of a solved bearing as lubricated contacts, placed in the bearing's frame
hertz    - Hertz contacts of many balls at once
motion   - motion of a ball over its races: rolling, sliding and spin
shape    - shape of a contact between ball and race, as the laws of friction take it
stress   - stress below a contact and sliding in it
traction - traction at the contacts of a bearing: how ball and race move over each other
"""
