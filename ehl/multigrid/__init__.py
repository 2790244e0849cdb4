"""Multigrid solution of the Reynolds and film equations."""
