"""Tables of what is computed over time: contacts, and the vibration of bearings.

programs  - speeds, loads, displacements and temperature of a simulation over time
transient - a single contact over time
vibration - form of the surfaces of a bearing, support of its rings, vibration
"""
