"""Oil supply and starved films.

supply - oil supply, first order: the film that little oil leaves
track  - oil on a track from ball to ball: passes, steady state
"""
