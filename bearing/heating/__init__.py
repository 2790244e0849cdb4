"""Temperatures of a bearing from its friction.

capacities      - heat capacities of the parts
conductances    - conductances in closed form, each with its range
contact_conductances - how the contacts conduct heat through their films
films_heat      - heat of films of formulas in balance
friction_heat   - heat of friction by where it arises
heat_balance    - temperature at which friction and cooling agree
heat_state      - heat and temperatures at one film temperature and clearance
limiting_speed  - balances over the speed, and the speed above which there is none
network         - nodes, paths and boundaries; temperatures and flows of heat
paths           - rings, seats, shaft, housing, oil and air as paths of heat
required_cooling - least cooling that keeps a bearing below a limit
self_heating    - temperatures at which friction, clearance, films and cooling agree
stability       - margin against thermal runaway, ends of the temperatures
warm_up         - temperatures over time from a start on
"""
