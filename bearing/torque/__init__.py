"""Friction torque of a ball bearing, by several models side by side."""
