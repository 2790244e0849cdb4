"""Friction torque of a ball bearing, by several models side by side.

breakdown    - all models of the friction torque of one bearing, side by side
inputs       - input of the torque models
integrated   - friction torque from the shear of solved films, and from a law or table
models       - every model of the friction torque, brought to one form
paper_models - torque models of single papers, computed on request
skf          - SKF's friction model (2013), and Palmgren's
starved      - friction torque over the oil supply, and over the range of a flow
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
