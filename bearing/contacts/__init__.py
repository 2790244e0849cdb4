"""The lubricated contacts that follow from an equilibrium: shape, motion, stress."""
