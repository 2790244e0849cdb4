"""Oil supply and starved films.

supply      - oil supply, first order: film, side flow, oil that stands, least friction
inlet_oil   - oil that comes to a bearing: layer, flow, space that it fills
track       - oil on a track from ball to ball: passes, steady state
"""
