"""Temperatures of a bearing from its friction.

friction_heat - heat of friction by where it arises
heat_state    - heat and temperatures at one film temperature and clearance
limits        - limits of temperatures
network       - nodes, conductances and boundaries; temperatures and flows of heat
over_speed    - balances of heat over the speed, limiting speed, required cooling
over_time     - temperatures over time, and the stability of their balance
paths         - rings, seats, shaft, housing, oil and air as paths of heat
self_heating  - temperatures at which friction, clearance, films and cooling agree
"""
