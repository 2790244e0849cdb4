"""Bearings, materials and lubricants by name, with sources."""
