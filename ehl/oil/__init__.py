"""The oil: density, viscosity, rheology and their numbers for compiled kernels."""
