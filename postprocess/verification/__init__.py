"""Pictures of the verification page."""
