"""Results of a bearing run."""
