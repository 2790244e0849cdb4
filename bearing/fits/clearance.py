"""Clearance of a mounted, warm, turning bearing: interference fits, thermal growth, centrifugal
growth of the rings.

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
from math import isfinite

from ..geometry import Bearing
from ..material import Material
from ..operation import Operation


@dataclass(frozen=True, slots=True, kw_only=True)
class Fit:
    """Seats of the two rings.

    Attributes
    ----------
    inner_interference, outer_interference : float
        Effective interference at rest and at the reference temperature, on the diameter [m];
        negative is a loose fit.
    shaft_bore : float
        Inner diameter of a hollow shaft [m], 0 for a solid one.
    housing_outside_diameter : float or None
        [m]; needed with an interference of the outer ring.
    shaft_material, housing_material : Material
    """

    shaft_material: Material
    housing_material: Material
    inner_interference: float = 0.0
    outer_interference: float = 0.0
    shaft_bore: float = 0.0
    housing_outside_diameter: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Warming:
    """Temperatures above that at which bearing, shaft and housing were measured [K]."""

    inner_ring: float = 0.0
    outer_ring: float = 0.0
    ball: float = 0.0
    shaft: float = 0.0
    housing: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceBudget:
    """Diametral clearance from the box to operation, and what changes it; all on the diameter.

    Attributes
    ----------
    initial, mounted, operating : float
        Clearance [m] as delivered, after mounting, and warm and turning.
    inner_fit, outer_fit : float
        Change of clearance by the fits in operation [m], never positive.
    thermal, centrifugal : float
        Change of clearance by free thermal and centrifugal growth of rings and balls [m].
    inner_interference, outer_interference : float
        Interference left in operation [m]; negative where the seat has come loose.
    inner_pressure, outer_pressure : float
        Pressure in the seats in operation [Pa].
    messages : tuple of str
    cage : CageClearance or None
        None where the temperature of the cage is not given.
    """

    initial: float
    mounted: float
    operating: float
    inner_fit: float = 0.0
    outer_fit: float = 0.0
    thermal: float = 0.0
    centrifugal: float = 0.0
    inner_interference: float = 0.0
    outer_interference: float = 0.0
    inner_pressure: float = 0.0
    outer_pressure: float = 0.0
    messages: tuple[str, ...] = ()
    cage: "CageClearance | None" = None


@dataclass(frozen=True, slots=True, kw_only=True)
class _Cylinder:
    """A ring, a shaft (inner diameter 0 where it is solid) or a housing: diameters [m], speed
    [rad/s], warming [K].
    """

    material: Material
    inner: float
    outer: float
    speed: float = 0.0
    warming: float = 0.0

    def free_growth(self, diameter: float) -> float:
        """Growth of the inner or outer diameter by temperature and speed, without neighbours [m]."""
        return thermal_growth(self.material, diameter, self.warming) + self.centrifugal(diameter)

    def centrifugal(self, diameter: float) -> float:
        other = self.outer if diameter == self.inner else self.inner
        return centrifugal_growth(self.material, diameter, other, self.speed)


def thermal_growth(material: Material, diameter: float, warming: float) -> float:
    """Growth of a diameter, alpha D dT [m].

    Parameters
    ----------
    material : Material
        With its thermal expansion [1/K], unless there is no warming.
    diameter : float
        [m].
    warming : float
        [K].

    Returns
    -------
    float
        [m].
    """
    if warming == 0.0:
        return 0.0
    if material.thermal_expansion is None:
        raise ValueError(
            f"material {material.name!r} has no thermal_expansion, which a change of temperature needs"
        )
    return material.thermal_expansion * diameter * warming


def centrifugal_growth(material: Material, diameter: float, other: float, speed: float) -> float:
    """Growth of one diameter of a free turning cylinder, rho omega^2 D [(1 - nu) D^2 + (3 + nu)
    D_other^2]/(16 E).

    Lame, plane stress: the hoop stress at the free surface r is rho omega^2 [(1 - nu) r^2 + (3 +
    nu) r_other^2]/4.

    Parameters
    ----------
    material : Material
    diameter, other : float
        The diameter that grows, and the cylinder's other one (0 where it is solid) [m].
    speed : float
        [rad/s].

    Returns
    -------
    float
        [m].
    """
    nu = material.poisson_ratio
    stress = (
        material.density * speed**2 * ((1.0 - nu) * diameter**2 + (3.0 + nu) * other**2) / 16.0
    )
    return diameter * stress / material.youngs_modulus


def fit_pressure(interference: float, diameter: float, hub: _Cylinder, shaft: _Cylinder) -> float:
    """Pressure of a cylindrical fit [Pa], Lame; 0 where it is loose.

    delta = p d { [(h^2 + d^2)/(h^2 - d^2) + nu_h]/E_h + [(d^2 + s^2)/(d^2 - s^2) - nu_s]/E_s },
    h the outer diameter of the hub, s the bore of the shaft.

    Parameters
    ----------
    interference : float
        On the diameter [m].
    diameter : float
        Of the seat [m].
    hub, shaft : _Cylinder
        The outer and the inner part.

    Returns
    -------
    float
        [Pa].
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
    """Growth of a ring's far diameter under a pressure on its seat [m], Lame.

    2 p d_in^2 d_out/(E (d_out^2 - d_in^2)) of the outer diameter with the pressure inside, minus 2
    p d_out^2 d_in/(...) of the inner one with the pressure outside.

    Parameters
    ----------
    pressure : float
        [Pa].
    ring : _Cylinder
    inside : bool
        Whether the pressure acts on the inner surface.

    Returns
    -------
    float
        [m].
    """
    near, far = (ring.inner, ring.outer) if inside else (ring.outer, ring.inner)
    growth = (
        2.0
        * pressure
        * near**2
        * far
        / (ring.material.youngs_modulus * (ring.outer**2 - ring.inner**2))
    )
    return growth if inside else 0.0 - growth


def clearance_budget(
    bearing: Bearing, operation: Operation, fit: Fit | None = None, warming: Warming | None = None
) -> ClearanceBudget:
    """Clearance in operation from that of the bearing as delivered.

    Parameters
    ----------
    bearing : Bearing
        With its initial `diametral_clearance`, bore and outside diameter [m] where fits need them.
    operation : Operation
        Speeds of the rings [rad/s]; shaft and housing turn with them.
    fit : Fit, optional
        Left out, the rings are free.
    warming : Warming, optional
        Left out, nothing warms up.

    Returns
    -------
    ClearanceBudget

    Raises
    ------
    ValueError
        If a dimension or a thermal expansion that is needed is missing or impossible; the message
        names it.
    """
    warming = warming or Warming()
    cold = Warming()
    at_rest = (0.0, 0.0)
    speeds = (operation.inner_speed, operation.outer_speed)
    if fit is not None:
        _check(bearing, fit)
    mounted = _state(bearing, fit, cold, at_rest)
    running = _state(bearing, fit, warming, speeds)
    initial = bearing.diametral_clearance
    budget = {name: running[name] for name in running if name != "change"}
    return ClearanceBudget(
        initial=initial,
        mounted=initial + mounted["change"],
        operating=initial + running["change"],
        **budget,
        messages=tuple(_messages(bearing, fit, running, speeds)),
        cage=None,
    )


def groove_diameters(bearing: Bearing) -> tuple[float, float]:
    """Diameters at the bottom of the inner and the outer groove, d_m -+ (D + P_d/2) [m]."""
    reach = bearing.ball_diameter + 0.5 * bearing.diametral_clearance
    return bearing.pitch_diameter - reach, bearing.pitch_diameter + reach


def _state(
    bearing: Bearing, fit: Fit | None, warming: Warming, speeds: tuple[float, float]
) -> dict[str, float]:
    """Change of clearance and its parts, interferences [m] and pressures [Pa] at given
    temperatures and speeds.
    """
    bottom, top = groove_diameters(bearing)
    bore, outside = bearing.bore or 0.0, bearing.outside_diameter or 0.0
    inner = _Cylinder(
        material=bearing.inner_ring_material,
        inner=bore,
        outer=bottom,
        speed=speeds[0],
        warming=warming.inner_ring,
    )
    outer = _Cylinder(
        material=bearing.outer_ring_material,
        inner=top,
        outer=outside,
        speed=speeds[1],
        warming=warming.outer_ring,
    )
    balls = thermal_growth(bearing.ball_material, bearing.ball_diameter, warming.ball)
    rings = (
        thermal_growth(inner.material, bottom, inner.warming),
        thermal_growth(outer.material, top, outer.warming),
    )
    centrifugal = (outer.centrifugal(top) if outside else 0.0) - (
        inner.centrifugal(bottom) if bore else 0.0
    )
    found = {"thermal": rings[1] - rings[0] - 2.0 * balls, "centrifugal": centrifugal}
    if fit is not None:
        found |= _inner_seat(inner, fit, warming) if bore else {}
        found |= (
            _outer_seat(outer, fit, warming) if outside and fit.housing_outside_diameter else {}
        )
    changes = ("thermal", "centrifugal", "inner_fit", "outer_fit")
    return found | {"change": sum(found.get(name, 0.0) for name in changes)}


def _inner_seat(ring: _Cylinder, fit: Fit, warming: Warming) -> dict[str, float]:
    shaft = _Cylinder(
        material=fit.shaft_material,
        inner=fit.shaft_bore,
        outer=ring.inner,
        speed=ring.speed,
        warming=warming.shaft,
    )
    left = fit.inner_interference + shaft.free_growth(ring.inner) - ring.free_growth(ring.inner)
    pressure = fit_pressure(left, ring.inner, hub=ring, shaft=shaft)
    change = -far_growth(pressure, ring, inside=True)
    return {"inner_interference": left, "inner_pressure": pressure, "inner_fit": change}


def _outer_seat(ring: _Cylinder, fit: Fit, warming: Warming) -> dict[str, float]:
    housing = _Cylinder(
        material=fit.housing_material,
        inner=ring.outer,
        outer=fit.housing_outside_diameter or 0.0,
        speed=ring.speed,
        warming=warming.housing,
    )
    left = fit.outer_interference + ring.free_growth(ring.outer) - housing.free_growth(ring.outer)
    pressure = fit_pressure(left, ring.outer, hub=housing, shaft=ring)
    change = far_growth(pressure, ring, inside=False)
    return {"outer_interference": left, "outer_pressure": pressure, "outer_fit": change}


def _check(bearing: Bearing, fit: Fit) -> None:
    """Refuse fits whose dimensions are missing or impossible."""
    for field in ("inner_interference", "outer_interference", "shaft_bore"):
        if not isfinite(getattr(fit, field)):
            raise ValueError(f"{field} must be finite, got {getattr(fit, field)!r}")
    bottom, top = groove_diameters(bearing)
    if bearing.bore is None and fit.inner_interference:
        raise ValueError("bore is needed with an interference of the inner ring")
    if bearing.bore is not None and not 0.0 <= fit.shaft_bore < bearing.bore < bottom:
        found = f"{fit.shaft_bore!r}, {bearing.bore!r} and {bottom!r} m"
        raise ValueError(f"shaft_bore, bore and groove must grow in this order, got {found}")
    housing = fit.housing_outside_diameter
    if fit.outer_interference and (housing is None or bearing.outside_diameter is None):
        raise ValueError(
            "housing_outside_diameter and outside_diameter are needed with an interference of the outer ring"
        )
    if (
        housing is not None
        and bearing.outside_diameter is not None
        and not top < bearing.outside_diameter < housing
    ):
        found = f"{top!r}, {bearing.outside_diameter!r} and {housing!r} m"
        raise ValueError(
            f"groove, outside_diameter and housing_outside_diameter must grow in this order, got {found}"
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
            yield f"clearance: the {ring} ring comes loose on its seat, the fit is lost in operation"


@dataclass(frozen=True, slots=True, kw_only=True)
class CageClearance:
    """Change of the clearances of a cage by heat.

    Attributes
    ----------
    pocket : float
        Change of the diametral clearance of a ball in its pocket [m].
    land : float or None
        Change of the radial clearance on the guiding land [m]; None where balls guide the cage.
    """

    pocket: float
    land: float | None = None
