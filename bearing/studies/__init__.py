"""Studies over load and speed: slip, stiffness, preload.

preload   - rows set against each other: preload, duplex pairs, stiffness over speed
slip      - gross slip of balls after Hirano: slip factors, critical loads, minimum preload
stiffness - stiffness of a bearing over speed
"""
