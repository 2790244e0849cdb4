"""Oil supply and starved films.

supply      - oil supply, first order: film, side flow, oil that stands, least friction
track       - oil on a track from ball to ball: passes, steady state
"""
