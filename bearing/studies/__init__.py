"""Studies over load and speed: slip, stiffness, preload.

preload - rows set against each other: preload as a force or as a displacement
slip    - gross slip of balls after Hirano: slip factors, critical loads, minimum preload
"""
