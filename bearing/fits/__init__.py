"""Fits and clearances.

clearance  - clearance in operation by fits, temperature and speed; clearances of the cage
"""
