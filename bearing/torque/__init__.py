"""Friction torque of a ball bearing, by several models side by side.

breakdown          - all models of the friction torque of one bearing, side by side
inlet              - inlet heating and replenishment in the rolling moment
inputs             - what the models take beyond the loads
integrated         - friction torque from the shear of solved films, and from a law or table
models             - every model of the friction torque, brought to one form
paper_models       - torque models of single papers, computed on request
palmgren           - Palmgren's friction torque, M = M_0 + M_1 (1957)
rolling_extent     - what the rolling part has by the layer that the oil of the films ends in
shear_torque       - torque of the friction of all contacts under a hypothesis on the motion
skf                - SKF's friction model (2013)
starved            - friction torque over the oil supply, first order
supply_band        - films and torque over what a flow of oil may leave on the tracks
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
