"""Results of a slip study."""
