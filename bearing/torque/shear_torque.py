"""Torque of the friction of all contacts, under a hypothesis of the balls' motion and with the
balls in balance.
"""

from dataclasses import dataclass, field

import numpy as np

from ehl.arrays import Array

from ..contacts.traction import ContactTraction
from ..films.film import Films
from ..friction.balance import BalancedFriction
from ..friction.resistance import NOTHING_RESISTED, ResistedPower
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
    # what goes into the oil around the balls, their pockets and the cage's land [W]
    resistance: ResistedPower = NOTHING_RESISTED
    speed: float = 0.0  # of the rings against each other [rad/s]

    @property
    def total(self) -> float:
        """Sum of the parts [N m]."""
        return sum(self.parts.values())

    @property
    def contacts(self) -> dict[str, float]:
        """Parts of the contacts that the friction distinguishes, by name [N m]."""
        names = ("rolling", "sliding", "spin", "curvature", "asperity")
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}

    @property
    def parts(self) -> dict[str, float]:
        """Those of the contacts, cage with its pockets, and drag of the balls [N m]."""
        if self.speed == 0.0:
            return self.contacts
        cage = self.cage_power / self.speed
        return {**self.contacts, "cage": cage, "drag": self.resistance.drag / self.speed}

    @property
    def cage_power(self) -> float:
        """Heat of the cage's land and pockets [W]."""
        return self.resistance.land + self.resistance.pocket

    @property
    def rings_power(self) -> float:
        """What the rings feed into contacts and the cage's land [W]."""
        return self.shaft_power + self.resistance.guiding

    @property
    def resisted(self) -> float:
        """What the balls give beside the contacts [W]."""
        return self.resistance.of_balls

    @property
    def imbalance(self) -> float:
        """Rings' power less heat and drag, over the heat [-]; it speeds up the balls."""
        left = self.shaft_power - self.heat - self.resisted
        return left / self.heat if self.heat > 0.0 else 0.0

    @property
    def relative_error(self) -> float:
        """Torque times speed less what the rings feed in, over the larger, magnitude [-]."""
        spent = self.total * abs(self.speed)
        largest = max(abs(spent), abs(self.rings_power))
        return abs(spent - self.rings_power) / largest if largest > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedShear:
    """Shear of all films of a bearing: under the hypothesis of the ball's motion, and with the
    balls in balance.
    """

    hypothesis: IntegratedTorque  # at the motion that the equilibrium of the loads assumed
    # in traction equilibrium; None where it was not sought or not found
    balanced: IntegratedTorque | None = None
    # of the same films, flooded and isothermal, in traction equilibrium; None as `balanced`
    flooded: IntegratedTorque | None = None
    # part of the sum of all loads on asperities [-]; None without roughness
    asperity_share: float | None = None
    # numbers of balls, from 1, loaded at the inner race, which cannot drive them, so that the cage
    # does
    cage_driven: tuple[int, ...] = ()
    # of every contact with a solved film, at the motion of `torque`
    tractions: tuple[ContactTraction, ...] = ()
    films: Films = ()  # operating ones of all contacts; empty where a friction law has none
    # contacts of all lubricated ones whose film is that of a formula [-]
    by_formula: int = 0
    by_atlas: int = 0  # of these, that of the film atlas [-]
    lubricated: int = 0
    # part by which the balls' orbits lag behind those of the hypothesis, seen from the outer ring,
    # mean by load of the balls that the inner race drives [-]; None without a balance
    orbit_lag: float | None = None
    balance: BalancedFriction | None = None  # of `balanced`, where films shear
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
    """Message why a search for the motion of the balls does not count: no ball that the inner race
    drives, or force left on a ball and push of the cage.

    Parameters
    ----------
    balance : BalancedFriction
        motion of the balls

    Returns
    -------
    str
        sentence
    """
    if not balance.driven.any():
        return (
            "the inner race can drive no ball against drag and rolling resistance, so that all "
            "slide (more axial load, or less oil in the cavity); the hypothesis of the motion is "
            "kept"
        )
    return (
        f"no traction equilibrium found (residual {balance.residual:.1e}, push of the cage known "
        f"to {balance.cage_change:.1e} of it), the hypothesis of the motion is kept"
    )


def imbalance_message(torque: IntegratedTorque) -> str:
    """Message why the torque at a motion does not count as that of balanced balls.

    Parameters
    ----------
    torque : IntegratedTorque
        at the motion

    Returns
    -------
    str
        sentence; empty if it counts
    """
    if abs(torque.imbalance) <= POWER_TOLERANCE:
        return ""
    return (
        "balls nearly balanced, the rings' power misses heat and drag by "
        f"{torque.imbalance:.1e} of the heat"
    )


def cage_driven_balls(solution: QuasistaticSolution, balance: BalancedFriction) -> tuple[int, ...]:
    """Numbers of balls, from 1, loaded at the inner race but not driven by it.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    balance : BalancedFriction
        motion of the balls

    Returns
    -------
    tuple[int, ...]
        numbers [-]
    """
    return tuple(int(i) + 1 for i in np.flatnonzero((solution.inner_load > 0.0) & ~balance.driven))


def orbit_lag(solution: QuasistaticSolution, balance: BalancedFriction) -> float:
    """Part by which the orbits of the balls that the inner race drives lag behind those of the
    solution, seen from the outer ring, mean weighted by the inner loads.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    balance : BalancedFriction
        motion of the balls

    Returns
    -------
    float
        lag [-]
    """
    outer = solution.operation.outer_speed
    orbits = np.array([motion.orbit_speed for motion in balance.motions]) - outer
    ratio = orbits / (solution.orbit_speed - outer)
    weights = np.where(balance.driven, solution.inner_load, 0.0)
    return float(1.0 - np.average(ratio, weights=weights))
