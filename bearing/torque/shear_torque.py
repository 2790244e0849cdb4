"""Torque of the friction of all contacts, under a hypothesis of the balls' motion and with the
balls in balance.
"""

from dataclasses import dataclass, field

import numpy as np

from ..contacts.traction import ContactTraction
from ..friction.balance import BalancedFriction
from ..geometry import Array
from ..quasistatic.solution import QuasistaticSolution

# rings' power less heat and drag over the heat up to which balls count as balanced [-]
POWER_TOLERANCE = 1.0e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class IntegratedTorque:
    """Heat of the contacts over the shaft's speed, by what it works against, and the balance of
    power.
    """

    # rolling or curvature is None where the friction has no such part of its own; the other then
    # holds both
    rolling: float | None  # of the oil that the pressure pumps [N m]
    sliding: float  # at the centres of the contacts [N m]
    spin: float  # [N m]
    curvature: float | None  # sliding by the surfaces' curvature [N m]
    shaft_power: float  # what the two rings feed into the contacts [W]
    heat: float  # what the contacts turn into heat [W]
    per_ball: Array  # (balls,) torque by ball [N m]
    # of asperities that touch [N m]; the oil's shear is then the rest. None where the friction has
    # no share of them
    asperity: float | None = 0.0
    # what the balls give to the oil around them and to the cage's land where these are in the
    # balance [W]
    resisted: float = 0.0

    @property
    def total(self) -> float:
        """Sum of the parts [N m]."""
        return sum(self.parts.values())

    @property
    def parts(self) -> dict[str, float]:
        """Those of the five that the friction distinguishes, by name [N m]."""
        names = ("rolling", "sliding", "spin", "curvature", "asperity")
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}

    @property
    def imbalance(self) -> float:
        """Rings' power less heat and drag, over the heat [-]; it speeds up the balls."""
        left = self.shaft_power - self.heat - self.resisted
        return left / self.heat if self.heat > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedShear:
    """Shear of all films of a bearing: under the hypothesis of the ball's motion, and with the
    balls in balance.
    """

    hypothesis: IntegratedTorque  # at the motion that the equilibrium of the loads assumed
    # in traction equilibrium; None where it was not sought or not found
    balanced: IntegratedTorque | None = None
    # part of the sum of all loads on asperities [-]; None without roughness
    asperity_share: float | None = None
    # numbers of balls, from 1, loaded at the inner race, which cannot drive them, so that the cage
    # does
    cage_driven: tuple[int, ...] = ()
    # of every contact with a film, at the motion of `torque`
    tractions: tuple[ContactTraction, ...] = ()
    note: str = ""  # why there is no balanced one, or why it does not count as one
    # why parts of the torque are None, by name
    missing_components: dict[str, str] = field(default_factory=dict)

    @property
    def torque(self) -> IntegratedTorque:
        """In traction equilibrium where it was found, else under the hypothesis [N m]."""
        return self.hypothesis if self.balanced is None else self.balanced

    @property
    def closed(self) -> bool:
        """Whether the balls are balanced: their motion was found, and there the rings' power is
        heat and drag [-].
        """
        return self.balanced is not None and abs(self.balanced.imbalance) <= POWER_TOLERANCE


def no_balance_message(balance: BalancedFriction) -> str:
    """Why a search for the motion of the balls does not count: force left on a ball, push of the
    cage [-].
    """
    return (
        f"no traction equilibrium found (residual {balance.residual:.1e}, push of the cage known "
        f"to {balance.cage_change:.1e} of it), the hypothesis of the motion is kept"
    )


def imbalance_message(torque: IntegratedTorque) -> str:
    """Why the torque at the motion found does not count as that of balanced balls; empty if it
    does [-].
    """
    if abs(torque.imbalance) <= POWER_TOLERANCE:
        return ""
    return (
        "balls nearly balanced, the rings' power misses heat and drag by "
        f"{torque.imbalance:.1e} of the heat"
    )


def cage_driven_balls(solution: QuasistaticSolution, balance: BalancedFriction) -> tuple[int, ...]:
    """Numbers of balls, from 1, loaded at the inner race but not driven by it [-]."""
    return tuple(int(i) + 1 for i in np.flatnonzero((solution.inner_load > 0.0) & ~balance.driven))
