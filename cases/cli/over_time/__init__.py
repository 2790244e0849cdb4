"""Commands that compute over time.

transient - one contact over time
vibration - vibration of a bearing
"""
