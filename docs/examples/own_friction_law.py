"""A friction law of your own: any object with a method `forces`.

The balls find the motion in which the forces of the law balance; what is left is the torque of their spin.
"""

from math import hypot

import matplotlib.pyplot as plt

import oilfilm
from oilfilm.bearing import Race
from oilfilm.bearing.friction.friction_sources import LawTraction
from oilfilm.bearing.torque import law_torque
from oilfilm.ehl.traction.law import TractionForces


class Coulomb:
    """Smooth Coulomb friction: a force against the sliding, a moment against the spin."""

    def __init__(self, coefficient, width=1e-4, smooth=0.02):
        self.coefficient, self.width, self.smooth = coefficient, width, smooth

    def forces(self, load, speed, slide_x, slide_y, spin):
        turn = self.width * spin  # sliding by the spin, somewhere in the ellipse
        rate = hypot(slide_x, slide_y, turn)
        share = self.coefficient * load / hypot(rate, self.smooth * speed)
        none = dict.fromkeys(("rolling_moment", "film", "stiffness", "damping"), 0.0)
        return TractionForces(
            force_x=-share * slide_x,
            force_y=-share * slide_y,
            spin_moment=-share * turn * self.width,
            power_loss=share * rate**2,
            outside=(),
            **none,
        )


case = oilfilm.load_case("7008_combined")
loads = oilfilm.solve_quasistatic(case.bearing, case.operation, case.model)
contacts = oilfilm.contact_conditions(loads, case.lubricant)
coefficients = [0.01, 0.02, 0.04, 0.06, 0.08, 0.1]
torques = []
for coefficient in coefficients:
    friction = LawTraction(laws={race: Coulomb(coefficient) for race in Race})
    torque = law_torque(loads, contacts, friction.at(loads, contacts)).torque
    torques.append(1e3 * (torque.sliding + torque.spin))
figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
axes.plot(coefficients, torques, "o-")
axes.set(xlabel="coefficient of friction", ylabel="friction torque [N mm]", xlim=0.0, ylim=0.0)
figure.savefig("own_friction_law.png")
