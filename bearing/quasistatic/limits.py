"""How far contacts reach and what friction they give, for balls in NumPy and compiled."""

# friction over load beyond which a hypothesis asks more than a contact gives: above SKF's
# coefficient of boundary lubrication, 0.12 running and 0.15 at the start (`torque.skf`) [-]
FRICTION_LIMIT = 0.2
# cosine of 80 degrees: beyond, the load fades to none at 90, where no groove reaches [-]
EDGE_COSINE = 0.17
