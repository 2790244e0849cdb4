"""Films that part balls and races: how a load follows from the distance of the bodies through film
and elastic body.
"""
