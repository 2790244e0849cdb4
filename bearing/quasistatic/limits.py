"""How far contacts reach, what friction they give and what rounding is worth, for balls in NumPy
and compiled.
"""

from math import ulp

# friction over load beyond which a hypothesis asks more than a contact gives: above SKF's
# coefficient of boundary lubrication, 0.12 running and 0.15 at the start (`torque.skf`) [-]
FRICTION_LIMIT = 0.2
# cosine of 80 degrees: beyond, the load fades to none at 90, where no groove reaches [-]
EDGE_COSINE = 0.17
ROUND_OFF = 8.0 * ulp(1.0)  # [-]
