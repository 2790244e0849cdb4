"""Oil supply and starved films.

oil_balance   - oil of the wetted grooves over the time: the best supply on paper
side_flow     - oil that one pass presses sideways out of a severely starved contact
solved_track  - one track over many passes, each solved behind the layer of the last one
supply        - oil supply, first order: the film that little oil leaves
track         - oil on a track from ball to ball: passes, steady state
"""
