"""Rating life, torque and energy of a bearing over a duty cycle of several load cases.

A load case that lasts the share q_i of the time at the speed n_i makes the share
u_i = q_i n_i/sum(q n) of the revolutions. Damage adds up linearly (Palmgren and Miner):

    1/L_10 = sum u_i/L_10,i,    P_m = (sum u_i P_i^3)^(1/3),    L_10 = (C/P_m)^3
    1/L_10m = sum u_i/(a_1 a_ISO,i L_10,i)

The first line is one statement in two forms. The second is not a_ISO at the equivalent load P_m:
most of the damage is done where a_ISO is small. Both are given. ISO 281 and ISO 16281 as in
`life`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf

from oilfilm.ehl.units import HOUR, MILLION

from ..geometry import Bearing
from ..operation import Operation
from .life import (
    LIFE_EXPONENT,
    SMALLEST_KAPPA,
    LifeRating,
    life_factor,
    overload,
    time_of,
    viscosity_ratio,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadCase:
    """One state of a duty cycle, computed."""

    time_share: float  # q_i of the time of the cycle [-]
    operation: Operation
    viscosity: float  # kinematic, of the oil at its temperature [m^2/s]
    largest_load: float  # of all contacts [N]
    largest_pressure: float  # Hertz', of all contacts [Pa]
    life: LifeRating
    converged: bool  # the equilibrium of ring and balls
    torque: float | None = None  # friction torque [N m]; None where no model gives it
    torque_model: str | None = None
    idle: bool = False  # without load: it turns, if at all, without damage
    revolution_share: float = 0.0  # u_i of the revolutions of the cycle [-]
    # fraction of the damage of the cycle, with a_ISO if that applies
    damage_share: float | None = None  # [-]
    messages: tuple[str, ...] = ()

    @property
    def power(self) -> float | None:
        """Friction power [W]."""
        return None if self.torque is None else self.torque * self.operation.shaft_speed


@dataclass(frozen=True, slots=True, kw_only=True)
class DutyCycle:
    """Load cases and results of all of them; None for a result that does not apply."""

    cases: tuple[LoadCase, ...]
    mean_speed: float  # n_m, of one ring against the other, over the time [rad/s]
    equivalent_load: float | None = None  # P_m [N]
    basic_life: float | None = None  # L_10r [revolutions]
    modified_life: float | None = None  # L_10mr, Miner's sum with a_ISO of each case [revolutions]
    # a_ISO at P_m, n_m and the mean viscosity over the revolutions, and the life with it
    equivalent_life_factor: float | None = None  # [-]
    equivalent_modified_life: float | None = None  # [revolutions]
    reliability_factor: float = 1.0  # a_1, in the modified lives [-]
    static_safety_factor: float | None = None  # the smallest S_0 of all cases [-]
    mean_torque: float | None = None  # over the revolutions: mean power over mean speed [N m]
    mean_power: float | None = None  # over the time [W]
    messages: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """True if every case has its equilibrium."""
        return all(case.converged for case in self.cases)

    @property
    def life_factor(self) -> float | None:
        """L_10mr/L_10r of the cycle, its mean a_ISO [-]."""
        if self.modified_life is None or self.basic_life is None:
            return None
        return self.modified_life / self.basic_life / self.reliability_factor

    @property
    def basic_life_time(self) -> float | None:
        """L_10rh [s]."""
        return time_of(self.basic_life, self.mean_speed)

    @property
    def modified_life_time(self) -> float | None:
        """L_10mrh [s]."""
        return time_of(self.modified_life, self.mean_speed)

    @property
    def equivalent_modified_life_time(self) -> float | None:
        """The modified life with a_ISO at the equivalent load [s]."""
        return time_of(self.equivalent_modified_life, self.mean_speed)

    @property
    def energy_per_hour(self) -> float | None:
        """Friction energy of one hour of the cycle [J]."""
        return None if self.mean_power is None else HOUR * self.mean_power


def revolution_shares(cases: Sequence[LoadCase]) -> list[float]:
    """Fractions u_i = q_i n_i/sum(q n) of the revolutions; zero for all if nothing turns.

    Parameters
    ----------
    cases : Sequence[LoadCase]
        load cases of the cycle

    Returns
    -------
    list[float]
        u_i of each case [-]
    """
    turns = [case.time_share * case.operation.shaft_speed for case in cases]
    total = sum(turns)
    return [turn / total if total else 0.0 for turn in turns]


def miner_life(shares: Sequence[float], lives: Sequence[float | None]) -> float | None:
    """L of 1/L = sum u_i/L_i, Palmgren and Miner.

    Parameters
    ----------
    shares : Sequence[float]
        u_i of the revolutions [-]
    lives : Sequence[float | None]
        L_i of each case by itself, None without one [revolutions]

    Returns
    -------
    float | None
        life of the cycle [revolutions]; None if a case that turns has no life
    """
    damage = 0.0
    for share, life in zip(shares, lives, strict=True):
        if share == 0.0:
            continue
        if life is None:
            return None
        damage += share / life
    return 1.0 / damage if damage else None


def duty_cycle(bearing: Bearing, cases: Sequence[LoadCase]) -> DutyCycle:
    """Life, torque and energy of a cycle from its cases.

    Parameters
    ----------
    bearing : Bearing
        bearing of all cases
    cases : Sequence[LoadCase]
        load cases, whose fractions of the time sum to 1

    Returns
    -------
    DutyCycle
        results of the cycle, each None if it does not apply
    """
    # 1. shares of the revolutions
    shares = revolution_shares(cases)
    speed = sum(case.time_share * case.operation.shaft_speed for case in cases)
    # 2. lives: basic, with a_ISO of each case, and with a_ISO at the equivalent load
    basic = miner_life(shares, [inf if case.idle else case.life.basic_life for case in cases])
    modified = miner_life(
        shares, [inf if case.idle else case.life.modified_life for case in cases]
    )
    rated = next((case.life for case in cases if case.life.dynamic_rating is not None), None)
    a_1 = 1.0 if rated is None else rated.reliability_factor
    load = None
    factor = None
    if basic is not None and rated is not None and rated.dynamic_rating is not None:
        load = rated.dynamic_rating * (MILLION / basic) ** (1.0 / LIFE_EXPONENT)
        mean = sum(u * case.viscosity for u, case in zip(shares, cases, strict=True))
        kappa = viscosity_ratio(mean, speed, bearing.pitch_diameter)
        factor = _factor_at(load, kappa, rated)
    # 3. power over the time, torque over the revolutions
    power = _mean_power(cases)
    safeties = [s for case in cases if (s := case.life.static_safety_factor) is not None]
    return DutyCycle(
        cases=tuple(_shared(cases, shares)),
        mean_speed=speed,
        equivalent_load=load,
        basic_life=basic,
        modified_life=modified,
        equivalent_life_factor=factor,
        equivalent_modified_life=basic * factor * a_1 if basic and factor else None,
        reliability_factor=a_1,
        static_safety_factor=min(safeties, default=None),
        mean_torque=power / speed if power is not None and speed else None,
        mean_power=power,
        messages=tuple(_messages(cases)),
    )


def _factor_at(load: float, kappa: float, rated: LifeRating) -> float | None:
    """a_ISO at an equivalent load [N] and a viscosity ratio [-]; None where it does not apply."""
    cleanliness = rated.rating.contamination_factor
    limit = rated.fatigue_load_limit
    if cleanliness is None or limit is None or kappa < SMALLEST_KAPPA:
        return None
    return life_factor(kappa, cleanliness * limit / load)


def _mean_power(cases: Sequence[LoadCase]) -> float | None:
    """Friction power over the time [W], without that of idle cases; None where a case that turns
    has no torque.
    """
    total = 0.0
    for case in cases:
        if not case.operation.shaft_speed or case.idle:
            continue
        if case.power is None:
            return None
        total += case.time_share * case.power
    return total


def _shared(cases: Sequence[LoadCase], shares: Sequence[float]) -> Iterator[LoadCase]:
    """The cases with their shares of revolutions and damage."""
    lives = [inf if case.idle else case.life.modified_life for case in cases]
    if miner_life(shares, lives) is None:
        lives = [inf if case.idle else case.life.basic_life for case in cases]
    total = miner_life(shares, lives)
    for case, share, life in zip(cases, shares, lives, strict=True):
        damage = None
        if total is not None:
            damage = share * total / life if share and life is not None else 0.0
        yield replace(case, revolution_share=share, damage_share=damage)


def _messages(cases: Sequence[LoadCase]) -> Iterator[str]:
    """Results that each case leaves out, by its messages, and the consequence for the cycle."""
    idle = [str(k) for k, case in enumerate(cases, 1) if not case.operation.shaft_speed]
    if idle:
        yield f"load_cases: life, kappa and a_iso null where nothing turns, {', '.join(idle)}"
    turning = [(k, case) for k, case in enumerate(cases, 1) if case.operation.shaft_speed]
    if not turning:
        yield "duty_cycle: life and torque null, no load case turns"
    unloaded = [str(k) for k, case in enumerate(cases, 1) if case.idle]
    if unloaded:
        yield (
            f"load_cases: without load {', '.join(unloaded)}: their turns count without damage; "
            "their friction, which has no model, is not in mean torque, power and energy"
        )
    for number, case in turning:
        if case.idle:
            continue
        if case.life.basic_life is None:
            yield f"duty_cycle: life null, load case {number} has none"
        elif case.life.modified_life is None:
            yield f"duty_cycle: modified life null, load case {number} has none"
        if case.torque is None:
            yield f"duty_cycle: torque null, no model gives that of load case {number}"
    for number, case in enumerate(cases, 1):
        if case.idle:
            continue
        yield from (f"load case {number}: {message}" for message in case.messages)
        yield from (f"load case {number}: {message}" for message in overload(case.life))
