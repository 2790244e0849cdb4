"""Results of one lubricated contact."""
