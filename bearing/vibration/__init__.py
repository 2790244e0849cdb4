"""Vibration of a bearing: form of its surfaces, films, rings on their supports, over time.

_kernels     - equations of motion, compiled
arrays       - numbers of the equations, and places in the state
assembly     - numbers of the equations from a bearing in equilibrium
form         - waviness, profiles, defects, diameters of the balls
inputs       - what vibration is computed from
laws         - laws of ball and race: Hertz, solved films, linear springs
lines        - frequencies at which the form of the surfaces shows
simulation   - the computation over time, and its record
transmission - what of a wave enters the bearing through the length of a contact
"""
