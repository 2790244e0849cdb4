"""Tables of what is computed over time: contacts, and the vibration of bearings.

transient - a single contact over time
vibration - form of the surfaces of a bearing, support of its rings, vibration
"""
