"""Time simulation of a ball bearing: rings, balls and cage under contact, friction, drag and
impact.
"""
