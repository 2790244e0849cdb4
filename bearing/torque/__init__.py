"""Friction torque of a ball bearing, by several models side by side.

Functions named as their module are imported from it: heat_balance, self_heating, starved_torque.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
