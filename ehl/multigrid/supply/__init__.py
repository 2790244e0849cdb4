"""Effect of a layer of oil at the inlet on a flooded contact.

oil_supply     - from two solutions in one box, flooded and behind the layer
starvation_law - from the flooded solution and the tabulated law of starvation
"""
