"""Results of a time simulation."""
