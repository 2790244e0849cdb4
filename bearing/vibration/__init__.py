"""Vibration of a bearing: form of its surfaces, films, rings on their supports, over time.

_kernels     - equations of motion, compiled
assembly     - arrays of the equations from a bearing in equilibrium, laws of the contacts
form         - waviness, profiles, defects, diameters of the balls
inputs       - inputs of vibration, and transmission of waves of a surface
lines        - frequencies at which the form of the surfaces shows
simulation   - the computation over time, and its record
transmission - fraction of a waviness that moves the bodies
"""
