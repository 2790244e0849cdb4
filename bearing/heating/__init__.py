"""Temperatures of a bearing from its friction.

friction_heat - heat of friction by where it arises
heat_state    - heat and temperatures at one film temperature and clearance
network       - nodes, paths and boundaries; temperatures and flows of heat
over_speed    - balances of heat over the speed, and the speed above which there is none
over_time     - temperatures of a bearing over time, from a start on
paths         - rings, seats, shaft, housing, oil and air as paths of heat
self_heating  - temperatures at which friction, clearance, films and cooling agree
"""
