"""Tables and pictures of the verification page, and the sweep over random contacts."""
