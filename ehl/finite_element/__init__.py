"""Independent finite-element solution of the lubricated contact."""
