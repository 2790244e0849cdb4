"""Results of a batch."""
