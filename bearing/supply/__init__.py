"""Oil supply and starved films.

oil_balance - balance of the oil in the track of one race
supply      - oil supply, first order: film, side flow, oil that stands, least friction
track       - oil on a track from ball to ball: passes, steady state
"""
