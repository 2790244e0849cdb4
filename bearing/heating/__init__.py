"""Temperature of a bearing from its friction.

heat_balance  - temperature at which friction power and cooling agree
self_heating  - the balance with equilibrium, clearance and oil solved anew at each temperature
"""
