"""Vibration of a bearing: form of its surfaces, films, rings on their supports, over time.

_kernels   - equations of motion, compiled
assembly   - numbers of the equations from a bearing in equilibrium
form       - waviness, profiles, defects, diameters of the balls
inputs     - what vibration is computed from
lines      - frequencies at which the form of the surfaces shows
simulation - the computation over time, and its record
"""
