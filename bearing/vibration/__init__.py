"""Vibration of a bearing: what form of its surfaces, films and supports add to its motion.

assembly   - heights of the surfaces, what a contact passes on of waves, and laws of the contacts
form       - waviness, profiles, defects, diameters of the balls
inputs     - inputs of vibration, and transmission of waves of a surface
lines      - frequencies at which the form of the surfaces shows
simulation - the simulation with form and supports, and its record
"""
