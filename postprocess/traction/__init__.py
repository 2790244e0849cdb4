"""Results of traction tables."""
