"""The command `oilfilm`."""
