"""Traction tables: films, sampling, storage, interpolation."""
