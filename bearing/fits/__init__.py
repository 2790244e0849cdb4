"""Fits and clearances.

clearance     - clearance in operation by fits, temperature and speed; clearances of the cage
ring_strength - hoop tension of rings, and the probability that a brittle one breaks
"""
