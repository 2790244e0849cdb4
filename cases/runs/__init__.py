"""Runs of a case."""
