"""Studies over load and speed: slip, stiffness, preload."""
