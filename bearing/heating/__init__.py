"""Heat balance and self-heating of a bearing."""
