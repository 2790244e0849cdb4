"""Hoop tension of rings by fit and rotation, and the probability that a brittle ring breaks.

A ring is the cylinder in plane stress of `clearance`, from the bore a to the bottom of the groove
b. A pressure p in its bore and rotation make the hoop stress (Lame; Timoshenko and Goodier,
Theory of Elasticity)

    sigma(r) = p a^2/(b^2 - a^2) (1 + b^2/r^2)
             + (3 + nu)/8 rho w^2 [a^2 + b^2 + a^2 b^2/r^2 - (1 + 3 nu)/(3 + nu) r^2]

largest at the bore: p (b^2 + a^2)/(b^2 - a^2) + rho w^2 [(3 + nu) b^2 + (1 - nu) a^2]/4. A
pressure from outside presses the ring together. A uniform temperature makes no stress by itself,
only through the seat. The probability of failure is Weibull's (1939) for flaws in the volume,

    P_f = 1 - exp{-integral of (sigma/sigma_0)^m dV/V_bar},  sigma_0 = mean strength/Gamma(1 + 1/m)

with the effective volume of the bars that the strength was measured with, in four-point bending
with half the span between the inner rollers: V_bar = volume (m + 2)/[4 (m + 1)^2]. Bars of 3 mm
by 4 mm on a span of 40 mm (ASTM C1161, size B) are assumed, as sources do not say. Left out:
bending by the balls, stress at the contacts, shoulders and fillets, flaws of the surface. No
standard rates ceramic rings.

A crack that grows as v = A (K/K_Ic)^n reaches its critical length under a constant tension sigma
after the time

    t = t_0/(n + 1) (sigma_f/sigma)^n

where a bar whose tension rises evenly breaks at sigma_f after t_0: the same law twice, in which A
and the first crack cancel. No source was read for the exponent of bearing ceramics in moist air:
its range is that of other ceramics, 12 and 36 of two dental ones (Griggs et al., 2010) and 16 to
36 of hot-pressed silicon carbide at 1300 C (Choi, Salem and Nemeth, 1998). A step of the
temperature at a whole surface makes E alpha dT/(1 - nu) of tension there; at thermal_shock it is
the strength.
"""

from dataclasses import dataclass, fields, replace
from functools import cache
from math import expm1, gamma, pi

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ..geometry import Bearing, Race, ring_material
from ..material import Material
from ..operation import Operation
from .clearance import ClearanceBudget, Fit, TemperatureRise, clearance_budget, groove_diameters

BAR_VOLUME = 3e-3 * 4e-3 * 40e-3  # of a bending test, between the outer rollers [m^3]
LARGE_SHARE = 0.2  # of the mean strength, beyond which a hoop tension is reported [-]
GROWTH_EXPONENT = (20.0, 12.0, 36.0)  # n, an estimate with its range [-]
BENDING_TIME = 10.0  # t_0, in which bending tests break a bar (assumed) [s]
RADII = 64  # Gauss points over the wall [-]
MAP_TEMPERATURES = 13
MAP_SPEEDS = 4
MAP_REACH = 1.5  # speeds of the map go up to so many times that of operation [-]
MAP_RISE = 120.0  # and temperatures at least so far above that of measurement [K]


@dataclass(frozen=True, slots=True)
class RingWall:
    """Cylinder from seat to groove: radii [m], width [m], seat inside or outside, loads."""

    inner: float
    outer: float
    width: float | None
    material: Material
    pressure: float  # [Pa]
    inside: bool  # whether the pressure acts in the bore
    speed: float  # [rad/s]

    def by_pressure(self, radius: Array | float) -> Array | float:
        """Hoop stress by the pressure of the seat.

        Parameters
        ----------
        radius : Array | float
            radius [m]

        Returns
        -------
        Array | float
            stress [Pa]
        """
        a = self.inner**2
        b = self.outer**2
        if self.inside:
            return self.pressure * a / (b - a) * (1.0 + b / np.square(radius))
        return -self.pressure * b / (b - a) * (1.0 + a / np.square(radius))

    def by_rotation(self, radius: Array | float) -> Array | float:
        """Hoop stress by rotation.

        Parameters
        ----------
        radius : Array | float
            radius [m]

        Returns
        -------
        Array | float
            stress [Pa]
        """
        nu = self.material.poisson_ratio
        a = self.inner**2
        b = self.outer**2
        r = np.square(radius)
        form = a + b + a * b / r - (1.0 + 3.0 * nu) / (3.0 + nu) * r
        return (3.0 + nu) / 8.0 * self.material.density * self.speed**2 * form

    def hoop(self, radius: Array | float) -> Array | float:
        """Hoop stress by both.

        Parameters
        ----------
        radius : Array | float
            radius [m]

        Returns
        -------
        Array | float
            stress [Pa]
        """
        return self.by_pressure(radius) + self.by_rotation(radius)


@dataclass(frozen=True, slots=True, kw_only=True)
class RingStrength:
    """Hoop stress of one ring, tension positive, and its probability of failure."""

    race: Race
    material: Material
    seat_pressure: float  # [Pa]
    fit_tension: float  # hoop stress at the bore by the pressure of the seat [Pa]
    rotation_tension: float  # and by rotation [Pa]
    groove_tension: float  # hoop stress at the bottom of the groove by both [Pa]
    # whole wall, over which (sigma/largest)^m is integrated
    effective_volume: float | None = None  # [m^3]; None without width or strength
    failure_probability: float | None = None  # [-]
    # with the strongest and least scattered material of the range, and with the weakest
    failure_low: float | None = None  # [-]
    failure_high: float | None = None  # [-]
    wall: RingWall | None = None  # its loads; None where tensions alone are given

    @property
    def hoop_tension(self) -> float:
        """Hoop stress at the bore, the largest of the ring [Pa]; negative in compression."""
        return self.fit_tension + self.rotation_tension

    @property
    def strength_share(self) -> float | None:
        """Hoop tension over the mean bending strength [-]; None where that is not known."""
        strength = self.material.bending_strength
        return None if strength is None else max(0.0, self.hoop_tension) / strength

    def growth_life(self, exponent: float, strength: float | None) -> float | None:
        """Time in which slow growth makes a crack critical under the hoop tension.

        Parameters
        ----------
        exponent : float
            n of the growth [-]
        strength : float | None
            bending strength [Pa]

        Returns
        -------
        float | None
            time [s]; None without tension or strength
        """
        if strength is None or not self.hoop_tension > 0.0:
            return None
        return BENDING_TIME / (exponent + 1.0) * (strength / self.hoop_tension) ** exponent

    @property
    def growth(self) -> float | None:
        """Time to failure by slow crack growth [s]."""
        return self.growth_life(GROWTH_EXPONENT[0], self.material.bending_strength)

    @property
    def growth_low(self) -> float | None:
        """Low end of it: least exponent and strength [s]."""
        ends = self.material.bending_strength_range
        return self.growth_life(GROWTH_EXPONENT[1], ends and ends[0])

    @property
    def growth_high(self) -> float | None:
        """High end of it: largest exponent and strength [s]."""
        ends = self.material.bending_strength_range
        return self.growth_life(GROWTH_EXPONENT[2], ends and ends[1])

    @property
    def shock(self) -> float | None:
        """Step of the temperature at the surface whose tension is the strength [K]."""
        return _shock(self.material, self.material.bending_strength)

    @property
    def shock_low(self) -> float | None:
        """Low end of it, by the range of the strength [K]."""
        ends = self.material.bending_strength_range
        return _shock(self.material, ends and ends[0])

    @property
    def shock_high(self) -> float | None:
        """High end of it [K]."""
        ends = self.material.bending_strength_range
        return _shock(self.material, ends and ends[1])


def _shock(material: Material, strength: float | None) -> float | None:
    """sigma_f (1 - nu)/(E alpha) [K]; None without strength or expansion."""
    if strength is None or not material.thermal_expansion:
        return None
    stiffness = material.youngs_modulus * material.thermal_expansion
    return strength * (1.0 - material.poisson_ratio) / stiffness


@dataclass(frozen=True, slots=True, kw_only=True)
class StrengthMap:
    """Hoop tension of the inner ring over its temperature and its speed."""

    temperature: Array  # of the inner ring, shape (nt,) [K]
    speed: Array  # of the inner ring, shape (ns,) [rad/s]
    hoop_tension: Array  # shape (nt, ns) [Pa]
    # shape (nt, ns) [-], with its ends by the ranges of the material; None without width, strength
    failure_probability: Array | None
    failure_low: Array | None
    failure_high: Array | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Strength:
    """Strength of the rings of a bearing."""

    rings: tuple[RingStrength, ...]  # those whose seat has a diameter
    inner_map: StrengthMap | None = None  # None unless the inner ring is brittle and has a seat

    def groove_tension(self) -> dict[Race, float]:
        """Hoop tension at the bottom of the grooves by race [Pa]."""
        return {ring.race: ring.groove_tension for ring in self.rings}


def ring_strengths(
    bearing: Bearing, operation: Operation, budget: ClearanceBudget | None
) -> tuple[RingStrength, ...]:
    """Hoop stress of the rings with known seats, from the pressures of the seats in operation.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds of the rings
    budget : ClearanceBudget | None
        clearances with the pressures of the seats; None: rotation alone

    Returns
    -------
    tuple[RingStrength, ...]
        strength of each ring whose seat has a diameter
    """
    return tuple(
        _strength(race, wall)
        for race in Race
        if (wall := _wall(bearing, race, operation, budget)) is not None
    )


def strength_map(
    bearing: Bearing,
    operation: Operation,
    fit: Fit | None,
    rise: TemperatureRise | None,
    reference: float,
) -> StrengthMap | None:
    """Hoop tension and failure probability of the inner ring over temperature and speed.

    All parts warm up in proportion to `rise`, together without it.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        speeds of the rings
    fit : Fit | None
        seats of the rings
    rise : TemperatureRise | None
        temperature rises in operation
    reference : float
        temperature of measurement [K]

    Returns
    -------
    StrengthMap | None
        map over temperature and speed; None without a bore, or if the thermal expansion of a part
        is missing
    """
    if bearing.bore is None or not _all_expand(bearing, fit):
        return None
    rise = rise if rise is not None and rise.inner_ring > 0.0 else _uniform(1.0)
    top = max(MAP_RISE, MAP_REACH * rise.inner_ring)
    rises = np.linspace(0.0, top, MAP_TEMPERATURES)
    fastest = MAP_REACH * abs(operation.inner_speed)
    speeds = np.linspace(0.0, fastest, MAP_SPEEDS) if fastest else np.zeros(1)
    rings = np.empty((rises.size, speeds.size), dtype=object)
    for i, inner_rise in enumerate(rises):
        warm = _scaled(rise, float(inner_rise) / rise.inner_ring)
        for j, speed in enumerate(speeds):
            turning = _at_speed(operation, float(speed))
            budget = clearance_budget(bearing, turning, fit, warm)
            rings[i, j] = ring_strengths(bearing, turning, budget)[0]
    failures = {
        name: _over_map(rings, name)
        for name in ("failure_probability", "failure_low", "failure_high")
    }
    return StrengthMap(
        temperature=reference + rises,
        speed=speeds,
        hoop_tension=np.array([[ring.hoop_tension for ring in row] for row in rings]),
        **failures,
    )


def _over_map(rings: NDArray[np.object_], name: str) -> Array | None:
    """An attribute of all rings of a map; None where it is None."""
    values = [[getattr(ring, name) for ring in row] for row in rings]
    return None if values[0][0] is None else np.array(values)


def _all_expand(bearing: Bearing, fit: Fit | None) -> bool:
    """Check that every part has a thermal expansion."""
    materials = [bearing.inner_ring_material, bearing.outer_ring_material, bearing.ball_material]
    if fit is not None:
        materials += [fit.shaft_material, fit.housing_material]
    return all(material.thermal_expansion is not None for material in materials)


def failure_probability(
    largest: float, effective_volume: float, strength: float, modulus: float
) -> float:
    """Weibull's probability of failure.

    Parameters
    ----------
    largest : float
        largest stress [Pa]
    effective_volume : float
        integral of (sigma/largest)^m dV [m^3]
    strength : float
        mean strength of bending bars [Pa]
    modulus : float
        Weibull's m [-]

    Returns
    -------
    float
        probability [-]
    """
    if largest <= 0.0:
        return 0.0
    scale = strength / gamma(1.0 + 1.0 / modulus)
    return -expm1(-effective_volume / bar_volume(modulus) * (largest / scale) ** modulus)


def bar_volume(modulus: float) -> float:
    """Effective volume of the bending bar.

    Parameters
    ----------
    modulus : float
        Weibull's m [-]

    Returns
    -------
    float
        volume [m^3]
    """
    return BAR_VOLUME * (modulus + 2.0) / (4.0 * (modulus + 1.0) ** 2)


def _wall(
    bearing: Bearing, race: Race, operation: Operation, budget: ClearanceBudget | None
) -> RingWall | None:
    """The ring between its seat and its groove; None where the seat's diameter is not known."""
    bottom, top = groove_diameters(bearing)
    seat = bearing.bore if race is Race.INNER else bearing.outside_diameter
    if seat is None:
        return None
    inside = race is Race.INNER
    diameters = (seat, bottom) if inside else (top, seat)
    name = race.value
    return RingWall(
        inner=0.5 * diameters[0],
        outer=0.5 * diameters[1],
        width=bearing.width,
        material=ring_material(bearing, race),
        pressure=0.0 if budget is None else getattr(budget, f"{name}_pressure"),
        inside=inside,
        speed=operation.inner_speed if inside else operation.outer_speed,
    )


def _strength(race: Race, wall: RingWall) -> RingStrength:
    """Hoop stress and probability of failure of a ring."""
    bore = wall.inner
    stresses = RingStrength(
        race=race,
        material=wall.material,
        seat_pressure=wall.pressure,
        fit_tension=float(wall.by_pressure(bore)) + 0.0,  # no -0
        rotation_tension=float(wall.by_rotation(bore)),
        groove_tension=float(wall.hoop(wall.outer if wall.inside else bore)) + 0.0,
        wall=wall,
    )
    material = wall.material
    strength = material.bending_strength
    modulus = material.weibull_modulus
    if wall.width is None or strength is None or modulus is None:
        return stresses
    weak, strong = material.bending_strength_range or (strength, strength)
    smallest, largest = material.weibull_modulus_range or (modulus, modulus)
    ends = [_failure(wall, s, m) for s in (weak, strong) for m in (smallest, largest)]
    return replace(
        stresses,
        effective_volume=effective_volume(wall, modulus),
        failure_probability=_failure(wall, strength, modulus),
        failure_low=min(ends),
        failure_high=max(ends),
    )


def _failure(wall: RingWall, strength: float, modulus: float) -> float:
    """Probability of failure [-] by the strength of bars [Pa] and Weibull's modulus [-]."""
    largest = float(wall.hoop(wall.inner))
    return failure_probability(largest, effective_volume(wall, modulus), strength, modulus)


def effective_volume(wall: RingWall, modulus: float) -> float:
    """Integral of (sigma/sigma_bore)^m over the wall, tension alone; zero if the bore is pressed.

    Parameters
    ----------
    wall : RingWall
        ring as a cylinder with its loads
    modulus : float
        Weibull's m [-]

    Returns
    -------
    float
        volume [m^3]
    """
    largest = float(wall.hoop(wall.inner))
    if largest <= 0.0 or wall.width is None:
        return 0.0
    nodes, weights = _gauss()
    half = 0.5 * (wall.outer - wall.inner)
    radius = wall.inner + half * (1.0 + nodes)
    ratio = np.maximum(np.asarray(wall.hoop(radius)) / largest, 0.0) ** modulus
    return float(2.0 * pi * wall.width * half * (weights * ratio * radius).sum())


@cache
def _gauss() -> tuple[Array, Array]:
    """Points and weights of Gauss and Legendre on [-1, 1] [-]."""
    nodes, weights = np.polynomial.legendre.leggauss(RADII)
    return nodes, weights


def _uniform(rise: float) -> TemperatureRise:
    """All parts warmer by as much [K]."""
    return TemperatureRise(inner_ring=rise, outer_ring=rise, ball=rise, shaft=rise, housing=rise)


def _scaled(rise: TemperatureRise, factor: float) -> TemperatureRise:
    """Rises times a factor [-]."""
    return TemperatureRise(**{f.name: factor * getattr(rise, f.name) for f in fields(rise)})


def _at_speed(operation: Operation, speed: float) -> Operation:
    """The operation with its inner ring at a speed, the outer one in proportion [rad/s]."""
    ratio = operation.outer_speed / operation.inner_speed if operation.inner_speed else 0.0
    return replace(operation, inner_speed=speed, outer_speed=ratio * speed)
