"""Fits, clearance and the cage's clearance."""
