"""Clearance of a mounted, heated, rotating bearing: interference fits, thermal growth, centrifugal
growth of the rings; clearances of its cage.

Every ring is a cylinder in plane stress: the inner one from the bore to the bottom of its groove,
the outer one from the bottom of its groove to the outside diameter; shaft and housing likewise.
Fits and centrifugal growth are the linear solutions of Lame for thick rings, and add up. With d_i
and d_o the diameters at the bottom of the grooves,

    P_d = d_o - d_i - 2 D,   change of P_d = change of d_o - change of d_i - 2 (change of D)

so that growth of the inner ring and of the balls takes clearance away and growth of the outer ring
gives it. (One source, Yao et al. 2022, prints the opposite sign.)
"""

from collections.abc import Iterator
from dataclasses import dataclass

from oilfilm.ehl.messages import Caution
from oilfilm.ehl.options import require_finite

from ..geometry import Bearing, Race
from ..material import Material
from ..operation import Operation


@dataclass(frozen=True, slots=True, kw_only=True)
class Fit:
    """Seats of the two rings."""

    shaft_material: Material
    housing_material: Material
    # effective interference at rest and at the reference temperature, on the diameter; negative is
    # a loose fit
    inner_interference: float = 0.0  # [m]
    outer_interference: float = 0.0  # [m]
    shaft_bore: float = 0.0  # inner diameter of a hollow shaft [m], 0 for a solid one
    # needed with an interference of the outer ring
    housing_outside_diameter: float | None = None  # [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class TemperatureRise:
    """Temperatures above that at which bearing, shaft and housing were measured [K]."""

    inner_ring: float = 0.0
    outer_ring: float = 0.0
    ball: float = 0.0
    shaft: float = 0.0
    housing: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class CageClearance:
    """Change of the clearances of a cage by heat, positive where they grow."""

    pocket: float  # diametral, of a ball in its pocket [m]
    land: float | None = None  # radial, on the guiding land; None where balls guide the cage [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceBudget:
    """Diametral clearance from delivery to operation, and what changes it; all on the diameter."""

    initial: float  # clearance as delivered, after mounting, and in operation [m]
    mounted: float  # [m]
    operating: float  # [m]
    inner_fit: float = 0.0  # change of clearance by the fits in operation, never positive [m]
    outer_fit: float = 0.0  # [m]
    # change of clearance by free thermal and centrifugal growth of rings and balls
    thermal: float = 0.0  # [m]
    centrifugal: float = 0.0  # [m]
    # interference left in operation; negative where the seat has come loose
    inner_interference: float = 0.0  # [m]
    outer_interference: float = 0.0  # [m]
    inner_pressure: float = 0.0  # pressure in the seats in operation [Pa]
    outer_pressure: float = 0.0  # [Pa]
    messages: tuple[str, ...] = ()
    cage: CageClearance | None = None  # None where the temperature of the cage is not given


@dataclass(frozen=True, slots=True)
class _Cylinder:
    """Ring, shaft or housing: diameters [m], speed [rad/s], temperature rise [K]."""

    material: Material
    inner: float
    outer: float
    speed: float = 0.0
    rise: float = 0.0

    def free_growth(self, diameter: float) -> float:
        """Growth of the inner or outer diameter by temperature and speed, without seats [m]."""
        return thermal_growth(self.material, diameter, self.rise) + self.centrifugal(diameter)

    def centrifugal(self, diameter: float) -> float:
        other = self.outer if diameter == self.inner else self.inner
        return centrifugal_growth(self.material, diameter, other, self.speed)


def thermal_growth(material: Material, diameter: float, rise: float) -> float:
    """Growth of a diameter by a temperature rise, from 20 C where the expansion is known over it.

    Parameters
    ----------
    material : Material
        material with its thermal expansion
    diameter : float
        D [m]
    rise : float
        temperature rise dT [K]

    Returns
    -------
    float
        growth [m]

    Raises
    ------
    ValueError
        if the thermal expansion is missing
    """
    if rise == 0.0:
        return 0.0
    strain = material.thermal_strain(rise)
    if strain is None:
        raise ValueError(
            f"material {material.name!r} has no thermal_expansion, which a change of temperature "
            "needs"
        )
    return strain * diameter


def centrifugal_growth(material: Material, diameter: float, other: float, speed: float) -> float:
    """Growth of one diameter of a free rotating cylinder, Lame, plane stress.

    rho omega^2 D [(1 - nu) D^2 + (3 + nu) D_other^2]/(16 E): the hoop stress at the free surface r
    is rho omega^2 [(1 - nu) r^2 + (3 + nu) r_other^2]/4.

    Parameters
    ----------
    material : Material
        material of the cylinder
    diameter : float
        diameter D that grows [m]
    other : float
        the other diameter, 0 if the cylinder is solid [m]
    speed : float
        omega [rad/s]

    Returns
    -------
    float
        growth [m]
    """
    nu = material.poisson_ratio
    squares = (1.0 - nu) * diameter**2 + (3.0 + nu) * other**2
    stress = material.density * speed**2 * squares / 16.0
    return diameter * stress / material.youngs_modulus


def fit_pressure(interference: float, diameter: float, hub: _Cylinder, shaft: _Cylinder) -> float:
    """Pressure of a cylindrical fit, Lame; 0 if it is loose.

    delta = p d { [(h^2 + d^2)/(h^2 - d^2) + nu_h]/E_h + [(d^2 + s^2)/(d^2 - s^2) - nu_s]/E_s },
    h the outer diameter of the hub, s the bore of the shaft.

    Parameters
    ----------
    interference : float
        delta [m]
    diameter : float
        d of the fit [m]
    hub, shaft : _Cylinder
        outer and inner part

    Returns
    -------
    float
        pressure p [Pa]
    """
    if interference <= 0.0:
        return 0.0
    h = hub.outer**2
    d = diameter**2
    s = shaft.inner**2
    of_hub = ((h + d) / (h - d) + hub.material.poisson_ratio) / hub.material.youngs_modulus
    of_shaft = ((d + s) / (d - s) - shaft.material.poisson_ratio) / shaft.material.youngs_modulus
    return interference / (diameter * (of_hub + of_shaft))


def far_growth(pressure: float, ring: _Cylinder, *, inside: bool) -> float:
    """Growth of a ring's far diameter under a pressure on its seat, Lame.

    2 p d_in^2 d_out/(E (d_out^2 - d_in^2)) of the outer diameter with the pressure inside, minus 2
    p d_out^2 d_in/(...) of the inner one with the pressure outside.

    Parameters
    ----------
    pressure : float
        p on the seat [Pa]
    ring : _Cylinder
        ring as a cylinder
    inside : bool
        whether the seat is the bore of the ring

    Returns
    -------
    float
        growth [m]
    """
    seat, far = (ring.inner, ring.outer) if inside else (ring.outer, ring.inner)
    modulus = ring.material.youngs_modulus
    growth = 2.0 * pressure * seat**2 * far / (modulus * (ring.outer**2 - ring.inner**2))
    return growth if inside else 0.0 - growth


def clearance_budget(
    bearing: Bearing,
    operation: Operation,
    fit: Fit | None = None,
    rise: TemperatureRise | None = None,
) -> ClearanceBudget:
    """Clearance in operation from that of the bearing as delivered.

    Parameters
    ----------
    bearing : Bearing
        with its initial `diametral_clearance`, and bore and outside diameter if there are fits
    operation : Operation
        speeds of the rings, with which shaft and housing turn
    fit : Fit | None, optional
        seats of the rings; None: the rings are free
    rise : TemperatureRise | None, optional
        temperature rises of the parts; None: nothing heats up

    Returns
    -------
    ClearanceBudget
        clearances and the changes by fits, heat and speed [m]

    Raises
    ------
    ValueError
        naming a dimension or a thermal expansion that is missing or impossible
    """
    speeds = (operation.inner_speed, operation.outer_speed)
    if fit is not None:
        _check(bearing, fit)
    mounted = _changes(bearing, fit, TemperatureRise(), (0.0, 0.0))
    running = _changes(bearing, fit, rise or TemperatureRise(), speeds)
    initial = bearing.diametral_clearance
    return ClearanceBudget(
        initial=initial,
        mounted=initial + mounted.pop("change"),
        operating=initial + running.pop("change"),
        **running,
        messages=tuple(_messages(bearing, fit, running, speeds)),
        cage=None,
    )


def groove_diameters(bearing: Bearing) -> tuple[float, float]:
    """Diameters at the bottom of the inner and the outer groove, d_m -+ (D + P_d/2).

    Parameters
    ----------
    bearing : Bearing
        geometry of the row

    Returns
    -------
    inner
        at the inner groove [m]
    outer
        at the outer groove [m]
    """
    reach = bearing.ball_diameter + 0.5 * bearing.diametral_clearance
    return bearing.pitch_diameter - reach, bearing.pitch_diameter + reach


def _changes(
    bearing: Bearing, fit: Fit | None, rise: TemperatureRise, speeds: tuple[float, float]
) -> dict[str, float]:
    """Change of clearance and parts, interferences [m], pressures [Pa] at given conditions."""
    bottom, top = groove_diameters(bearing)
    bore = bearing.bore or 0.0
    outside = bearing.outside_diameter or 0.0
    inner = _Cylinder(bearing.inner_ring_material, bore, bottom, speeds[0], rise.inner_ring)
    outer = _Cylinder(bearing.outer_ring_material, top, outside, speeds[1], rise.outer_ring)
    balls = thermal_growth(bearing.ball_material, bearing.ball_diameter, rise.ball)
    inner_ring = thermal_growth(inner.material, bottom, inner.rise)
    outer_ring = thermal_growth(outer.material, top, outer.rise)
    changes = {
        "thermal": outer_ring - inner_ring - 2.0 * balls,
        "centrifugal": (outer.centrifugal(top) if outside else 0.0)
        - (inner.centrifugal(bottom) if bore else 0.0),
    }
    if fit is not None and bore:
        shaft = _Cylinder(fit.shaft_material, fit.shaft_bore, bore, speeds[0], rise.shaft)
        remaining, pressure = _seat(fit.inner_interference, hub=inner, shaft=shaft)
        growth = far_growth(pressure, inner, inside=True)
        changes |= {
            "inner_interference": remaining,
            "inner_pressure": pressure,
            "inner_fit": -growth,
        }
    if fit is not None and outside and fit.housing_outside_diameter:
        far = fit.housing_outside_diameter
        housing = _Cylinder(fit.housing_material, outside, far, speeds[1], rise.housing)
        remaining, pressure = _seat(fit.outer_interference, hub=housing, shaft=outer)
        growth = far_growth(pressure, outer, inside=False)
        changes |= {
            "outer_interference": remaining,
            "outer_pressure": pressure,
            "outer_fit": growth,
        }
    names = ("thermal", "centrifugal", "inner_fit", "outer_fit")
    return changes | {"change": sum(changes.get(name, 0.0) for name in names)}


def _seat(interference: float, hub: _Cylinder, shaft: _Cylinder) -> tuple[float, float]:
    """Interference left of one at rest [m], and pressure in the seat [Pa]."""
    seat = hub.inner
    remaining = interference + shaft.free_growth(seat) - hub.free_growth(seat)
    return remaining, fit_pressure(remaining, seat, hub=hub, shaft=shaft)


def _check(bearing: Bearing, fit: Fit) -> None:
    """Refuse fits whose dimensions are missing or impossible."""
    require_finite(fit, "inner_interference", "outer_interference", "shaft_bore")
    bottom, top = groove_diameters(bearing)
    bore, outside = bearing.bore, bearing.outside_diameter
    housing = fit.housing_outside_diameter
    if bore is None and fit.inner_interference:
        raise ValueError("bore is needed with an interference of the inner ring")
    if bore is not None and not 0.0 <= fit.shaft_bore < bore < bottom:
        raise ValueError(
            "shaft_bore, bore and groove must grow in this order, got "
            f"{fit.shaft_bore!r}, {bore!r} and {bottom!r} m"
        )
    if fit.outer_interference and (housing is None or outside is None):
        raise ValueError(
            "housing_outside_diameter and outside_diameter are needed with an interference of "
            "the outer ring"
        )
    if housing is not None and outside is not None and not top < outside < housing:
        raise ValueError(
            "groove, outside_diameter and housing_outside_diameter must grow in this order, got "
            f"{top!r}, {outside!r} and {housing!r} m"
        )


def _messages(
    bearing: Bearing, fit: Fit | None, running: dict[str, float], speeds: tuple[float, float]
) -> Iterator[str]:
    for ring, dimension, key, speed in (
        ("inner", bearing.bore, "bore_mm", speeds[0]),
        ("outer", bearing.outside_diameter, "outside_diameter_mm", speeds[1]),
    ):
        if dimension is None and speed:
            yield f"clearance: centrifugal growth of the {ring} ring left out, no {key} is given"
        tight = fit is not None and getattr(fit, f"{ring}_interference") > 0.0
        if tight and running.get(f"{ring}_interference", 0.0) <= 0.0:
            text = f"the {ring} ring comes loose on its seat, the fit is lost in operation"
            yield Caution(f"clearance: {text}")


def cage_clearance(
    bearing: Bearing,
    material: Material,
    rise: TemperatureRise,
    cage_rise: float,
    land: tuple[Race, float] | None,
) -> CageClearance:
    """Thermal growth of cage, balls and guiding ring; every part grows freely, alpha D dT.

    A pocket grows with the cage around it. On the inner ring the cage's bore grows away from the
    land, on the outer ring its outside grows towards it. Growth of the rings by fits and speed,
    some micrometres, is left out.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    material : Material
        material of the cage, with its thermal expansion
    rise : TemperatureRise
        temperature rises of rings and balls
    cage_rise : float
        temperature rise of the cage [K]
    land : tuple[Race, float] | None
        guiding ring and the diameter of its land [m]; None if balls guide the cage

    Returns
    -------
    CageClearance
        changes of the clearances of pocket and land [m]
    """
    ball = bearing.ball_diameter
    pocket = thermal_growth(material, ball, cage_rise)
    pocket -= thermal_growth(bearing.ball_material, ball, rise.ball)
    if land is None:
        return CageClearance(pocket=pocket)
    race, diameter = land
    cage = thermal_growth(material, diameter, cage_rise)
    if race is Race.INNER:
        room = cage - thermal_growth(bearing.inner_ring_material, diameter, rise.inner_ring)
    else:
        room = thermal_growth(bearing.outer_ring_material, diameter, rise.outer_ring) - cage
    return CageClearance(pocket=pocket, land=0.5 * room)
