"""Published torque models of ball bearings: SKF's (Rolling bearings, 10000 EN, 2013; mu_bl of
2018), M = M_rr + M_sl + M_seal + M_drag, and Palmgren's, M = M_0 + M_1 (1957; Harris and Kotzalas,
chapter 10).

The published constants take loads in N, lengths in mm, speeds in r/min and viscosities in mm^2/s,
and give N mm; the functions here take and give SI, and convert at the first and the last line.

SKF's factor of its rolling moment for oil that has not come back (pages 104 to 106) also serves
the integrated torque where the layer of its films is not prescribed; that for heat of the inlet
shear only the friction laws that have no films.
"""

import re
from dataclasses import dataclass, replace
from enum import Enum
from math import acos, exp, pi, radians, sin, sqrt
from typing import Any

import numpy as np

from oilfilm.ehl.units import MILLIMETRE, NEWTON_MILLIMETRE, RPM, from_si, to_si

from ..geometry import Bearing
from ..library.catalogue import friction_series
from ..library.designation import read_designation
from ..library.plugins import library_data

SKF_DATA = "skf_friction.toml"
# series of deep groove bearings beside those of the catalogue, longer names first
OTHER_SERIES = ("617", "628", "637", "638", "639", "622", "623", "630", "160", "161", "42", "43")
BOUNDARY_FRICTION = 0.12  # mu_bl of a running bearing, 2018 edition; 0.15 at the start

FULL_FILM_FRICTION = {"mineral": 0.05, "synthetic": 0.04, "transmission fluid": 0.1}  # mu_EHL

# ball diameter over the section's height D - d, where that is not given [-]: 0.28 to 0.31 of
# catalogue bearings of 60, 62 and 63
BALL_TO_SECTION = 0.3

# V_M of a digitised diagram of low accuracy over the value read, estimated [-]
DRAG_FACTOR_RANGE = (0.67, 1.33)
PALMGREN_DATA = "palmgren.toml"
BRANCH = 2000.0  # nu n [mm^2/s r/min] from which the viscous moment rises with the speed


class Series(Enum):
    """Kinds of ball bearings the model has constants for."""

    DEEP_GROOVE = "deep_groove"
    ANGULAR_CONTACT = "angular_contact"


class Lubrication(Enum):
    """How the oil comes to the bearing."""

    OIL_BATH = "oil bath"
    LOW_OIL_BATH = "low oil bath"
    OIL_JET = "oil jet"
    GREASE = "grease"
    OIL_AIR = "oil air"
    DRY = "dry"


# K_rs of the replenishment factor, Rolling bearings 10000 EN (2013), pages 104 to 106
STARVATION = {
    Lubrication.OIL_BATH: 0.0,
    Lubrication.LOW_OIL_BATH: 3e-8,
    Lubrication.OIL_JET: 3e-8,
    Lubrication.GREASE: 6e-8,
    Lubrication.OIL_AIR: 6e-8,
    Lubrication.DRY: 0.0,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelRange:
    """Range of a torque model; the sources were not read, numbers from memory."""

    speed_factor: float  # largest n d_m [mm/min]
    viscosity: tuple[float, float]  # kinematic [mm^2/s]
    load_share: float  # least load over C [-]


# SKF: catalogue bearings up to their permissible speeds, oils of 2 to 500 mm^2/s, the minimum load
# of ball bearings; Palmgren: "moderate" speeds and loads
RANGES = {
    "skf": ModelRange(speed_factor=1.0e6, viscosity=(2.0, 500.0), load_share=0.01),
    "palmgren": ModelRange(speed_factor=1.0e6, viscosity=(1.0, 1000.0), load_share=0.0),
}
# least phi_rs that the films take: Biboulet and Houpert's formula of the starved moment (2010)
# ends there, at a layer of twice the film [-]
LEAST_REPLENISHMENT = 0.2
# phi_rs below which SKF's rolling moment, (nu n)^0.6 phi_rs, falls as the oil thickens [-]
FALLING_REPLENISHMENT = exp(-0.6)


@dataclass(frozen=True, slots=True, kw_only=True)
class SkfConstants:
    """Constants of one series in the catalogue's units."""

    kind: Series
    series: str
    rolling: tuple[float, ...]  # R1, R2 (, R3) [as printed]
    sliding: tuple[float, ...]  # S1, S2 (, S3) [as printed]
    geometry: float  # K_Z [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class SkfBearing:
    """Input of the model from a bearing."""

    constants: SkfConstants
    bore: float  # d [m]
    outside_diameter: float  # D [m]
    static_rating: float | None = None  # C_0 [N], for deep groove bearings under axial load
    sealed: bool = False  # RS1 contact seals on both sides
    seal_diameter: float | None = None  # d_s [m]; None: of the bore, a lower bound
    rows: int = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class SkfOperation:
    """Loads, speed and oil; the defaults are the catalogue's for mineral oil in a low bath."""

    radial_load: float  # F_r [N]
    axial_load: float  # F_a [N]
    speed: float  # of the rotating ring [rad/s]
    viscosity: float  # kinematic, at the operating temperature [m^2/s]
    lubrication: Lubrication = Lubrication.LOW_OIL_BATH
    oil: str = "mineral"
    # H above the lowest contact point of the outer raceway [m]; drag counts from it
    oil_level: float = 0.0
    boundary_friction: float = BOUNDARY_FRICTION  # mu_bl [-]
    full_film_friction: float | None = None  # mu_EHL [-]; None: by the kind of oil
    boundary_share: float | None = None  # phi_bl [-]; None: SKF's, from speed and viscosity
    drag_factor: float | None = None  # V_M [-]; None: digitised from the catalogue's diagram


@dataclass(frozen=True, slots=True, kw_only=True)
class SkfTorque:
    """Frictional moments [N m], and the factors that made them [-]."""

    rolling: float
    sliding: float
    seal: float
    drag: float
    inlet_shear_factor: float  # phi_ish
    replenishment_factor: float  # phi_rs
    friction_coefficient: float  # mu_sl

    @property
    def total(self) -> float:
        """Sum of the four [N m]."""
        return self.rolling + self.sliding + self.seal + self.drag


def skf_series(kind: Series) -> tuple[str, ...]:
    """Names of the series of a kind of bearing.

    Parameters
    ----------
    kind : Series
        deep groove or angular contact

    Returns
    -------
    tuple[str, ...]
        names
    """
    return tuple(name for name in library_data(SKF_DATA)[kind.value] if name != "K_Z")


def series_of(name: str) -> str | None:
    """Series of the model by the designation of a bearing.

    Parameters
    ----------
    name : str
        designation

    Returns
    -------
    str | None
        series; None where there is none in it
    """
    designation = read_designation(name)
    if designation is not None:
        return friction_series(designation)
    match = re.match(rf"({'|'.join(OTHER_SERIES)})\d\d(?!\d)", name.strip())
    return None if match is None else match.group(1)


def skf_constants(kind: Series, series: str) -> SkfConstants:
    """Constants of a series as in the catalogue.

    Parameters
    ----------
    kind : Series
        deep groove or angular contact
    series : str
        for example "62" or "72 B"

    Returns
    -------
    SkfConstants
        in the catalogue's units

    Raises
    ------
    ValueError
        with those there are, if there is no such series
    """
    table = library_data(SKF_DATA)[kind.value]
    if series not in skf_series(kind):
        raise ValueError(f"unknown SKF series {series!r}; known: {', '.join(skf_series(kind))}")
    values = tuple(table[series])
    half = len(values) // 2
    return SkfConstants(
        kind=kind,
        series=series,
        rolling=values[:half],
        sliding=values[half:],
        geometry=float(table["K_Z"]),
    )


def skf_torque(bearing: SkfBearing, operation: SkfOperation) -> SkfTorque:
    """Frictional moment of a ball bearing.

    Parameters
    ----------
    bearing : SkfBearing
        dimensions and constants
    operation : SkfOperation
        loads, speed and oil

    Returns
    -------
    SkfTorque
        moments [N m] and factors [-]

    Raises
    ------
    ValueError
        if a deep groove bearing under axial load has no static rating
    """
    d, outside = bearing.bore / MILLIMETRE, bearing.outside_diameter / MILLIMETRE
    mean = 0.5 * (d + outside)
    n = abs(operation.speed) / RPM
    nu = from_si("viscosity_mm2_s", operation.viscosity)
    rolling, sliding = _load_factors(bearing, operation, mean, n)
    inlet = inlet_shear_factor(operation.speed, operation.viscosity, mean * MILLIMETRE)
    replenished = replenishment_factor(
        bearing.constants.geometry,
        operation.lubrication,
        operation.speed * operation.viscosity,
        (bearing.bore, bearing.outside_diameter),
    )
    film = operation.full_film_friction
    if film is None:
        film = FULL_FILM_FRICTION[operation.oil]
    share = operation.boundary_share
    if share is None:
        mean_diameter = 0.5 * (bearing.bore + bearing.outside_diameter)
        share = boundary_share(operation.speed, operation.viscosity, mean_diameter)
    friction = share * operation.boundary_friction + (1.0 - share) * film
    turning = n > 0.0
    rolling *= inlet * replenished * (nu * n) ** 0.6
    return SkfTorque(
        rolling=rolling * NEWTON_MILLIMETRE if turning else 0.0,
        sliding=sliding * friction * NEWTON_MILLIMETRE,
        seal=_seal(bearing) * NEWTON_MILLIMETRE,
        drag=bath_drag(
            bearing.constants.kind,
            (bearing.bore, bearing.outside_diameter),
            operation.lubrication,
            operation.oil_level,
            operation.speed,
            operation.viscosity,
            operation.drag_factor,
            bearing.rows,
        ),
        inlet_shear_factor=inlet,
        replenishment_factor=replenished,
        friction_coefficient=friction,
    )


def inlet_shear_factor(speed: float, viscosity: float, mean_diameter: float) -> float:
    """phi_ish = 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64), which the heat of the shear in the inlets
    leaves of the rolling moment.

    Parameters
    ----------
    speed : float
        of the rotating ring [rad/s]
    viscosity : float
        kinematic [m^2/s]
    mean_diameter : float
        d_m [m]

    Returns
    -------
    float
        phi_ish [-]
    """
    path = abs(speed) / RPM * mean_diameter / MILLIMETRE
    nu = from_si("viscosity_mm2_s", viscosity)
    return float(1.0 / (1.0 + 1.84e-9 * path**1.28 * nu**0.64))


def replenishment_factor(
    geometry: float, lubrication: Lubrication, product: float, diameters: tuple[float, float]
) -> float:
    """phi_rs = exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), which displaced oil that is not yet
    back leaves of the rolling moment.

    Parameters
    ----------
    geometry : float
        K_Z [-]
    lubrication : Lubrication
        the way the oil comes to the bearing
    product : float
        of speed and kinematic viscosity [m^2/s^2]
    diameters : tuple[float, float]
        bore and outside diameter [m]

    Returns
    -------
    float
        phi_rs [-]
    """
    bore, outside = (diameter / MILLIMETRE for diameter in diameters)
    slenderness = sqrt(geometry / (2.0 * (outside - bore)))
    rate = from_si("viscosity_mm2_s", abs(product) / RPM)
    return exp(-STARVATION[lubrication] * rate * (bore + outside) * slenderness)


def geometry_factor(kind: Series) -> float:
    """K_Z of a kind of bearing.

    Parameters
    ----------
    kind : Series
        deep groove or angular contact

    Returns
    -------
    float
        K_Z [-]
    """
    return float(library_data(SKF_DATA)[kind.value]["K_Z"])


def boundary_share(speed: float, viscosity: float, mean_diameter: float) -> float:
    """phi_bl = exp(-2.6e-8 (n nu)^1.4 d_m), fraction of boundary friction.

    Parameters
    ----------
    speed : float
        of the rotating ring [rad/s]
    viscosity : float
        kinematic [m^2/s]
    mean_diameter : float
        d_m [m]

    Returns
    -------
    float
        phi_bl [-]
    """
    product = from_si("viscosity_mm2_s", abs(speed) / RPM * viscosity)
    return exp(-2.6e-8 * product**1.4 * mean_diameter / MILLIMETRE)


def sliding_friction(
    speed: float,
    viscosity: float,
    mean_diameter: float,
    full_film: float,
    boundary: float = BOUNDARY_FRICTION,
) -> float:
    """mu_sl = phi_bl mu_bl + (1 - phi_bl) mu_EHL.

    Parameters
    ----------
    speed : float
        of the rotating ring [rad/s]
    viscosity : float
        kinematic [m^2/s]
    mean_diameter : float
        d_m [m]
    full_film : float
        mu_EHL [-]
    boundary : float, default BOUNDARY_FRICTION
        mu_bl [-]

    Returns
    -------
    float
        mu_sl [-]
    """
    share = boundary_share(speed, viscosity, mean_diameter)
    return share * boundary + (1.0 - share) * full_film


def sliding_as_printed(bearing: SkfBearing, operation: SkfOperation) -> float:
    """M_sl of a deep groove bearing with a slip of a paper: half of the radial part, added to the
    axial one.

    For comparison with its tables alone. The formula combines the loads under one root and takes
    the whole radial part.

    Parameters
    ----------
    bearing : SkfBearing
        dimensions and constants
    operation : SkfOperation
        loads, speed and oil

    Returns
    -------
    float
        moment [N m]
    """
    moment = 0.0
    if operation.axial_load:
        moment += skf_torque(bearing, replace(operation, radial_load=0.0)).sliding
    if operation.radial_load:
        moment += 0.5 * skf_torque(bearing, replace(operation, axial_load=0.0)).sliding
    return moment


def _load_factors(
    bearing: SkfBearing, operation: SkfOperation, mean: float, n: float
) -> tuple[float, float]:
    """G_rr and G_sl in the catalogue's units."""
    radial, axial = abs(operation.radial_load), abs(operation.axial_load)
    c = bearing.constants
    if c.kind is Series.ANGULAR_CONTACT:
        r1, r2, r3 = c.rolling
        s1, s2, s3 = c.sliding
        whirl_rolling, whirl_sliding = r3 * mean**4 * n**2, s3 * mean**4 * n**2
        rolling = r1 * mean**1.97 * (radial + whirl_rolling + r2 * axial) ** 0.54
        return rolling, s1 * mean**0.26 * (
            (radial + whirl_sliding) ** (4 / 3) + s2 * axial ** (4 / 3)
        )
    (r1, r2), (s1, s2) = c.rolling, c.sliding
    if axial == 0.0:
        return r1 * mean**1.96 * radial**0.54, s1 * mean**-0.26 * radial ** (5 / 3)
    if bearing.static_rating is None:
        raise ValueError("static_rating is needed for a deep groove bearing under axial load")
    slope = sin(radians(24.6 * (axial / bearing.static_rating) ** 0.24))
    rolling = r1 * mean**1.96 * (radial + r2 / slope * axial) ** 0.54
    return rolling, s1 * mean**-0.145 * (radial**5 + s2 * mean**1.5 / slope * axial**4) ** (1 / 3)


def _seal(bearing: SkfBearing) -> float:
    """K_S1 d_s^beta + K_S2 of both contact seals; zero without [N mm]."""
    if not bearing.sealed:
        return 0.0
    lip = bearing.seal_diameter if bearing.seal_diameter is not None else bearing.bore
    outside = bearing.outside_diameter / MILLIMETRE
    rows: Any = library_data(SKF_DATA)["seal"]
    row = next(row for row in rows if outside <= row["up_to"])
    return float(row["K_S1"] * (lip / MILLIMETRE) ** 2.25 + row["K_S2"])


def bath_drag(
    kind: Series,
    diameters: tuple[float, float],
    lubrication: Lubrication,
    level: float,
    speed: float,
    viscosity: float,
    stirred: float | None = None,
    rows: int = 1,
) -> float:
    """Drag of the oil of a bath, 0.4 V_M K_ball d_m^5 n^2 + 1.093e-7 n^2 d_m^3 (n d_m^2
    f_t/nu)^-1.379 R_s; twice for a jet.

    The second part goes with nu^1.379, which no flow does beyond the range of the model: from its
    end on it is continued in proportion to nu, as creeping flow resists.

    Parameters
    ----------
    kind : Series
        deep groove or angular contact
    diameters : tuple[float, float]
        bore and outside diameter [m]
    lubrication : Lubrication
        the way the oil comes to the bearing
    level : float
        H, above the lowest contact point of the outer raceway [m]
    speed : float
        of the rotating ring [rad/s]
    viscosity : float
        kinematic [m^2/s]
    stirred : float | None, optional
        V_M [-]; None: from the digitised diagram
    rows : int, default 1
        of balls [-]

    Returns
    -------
    float
        torque [N m]; zero without a level, of grease and oil-air
    """
    dry = lubrication in (Lubrication.GREASE, Lubrication.OIL_AIR)
    if dry or level <= 0.0 or speed == 0.0:
        return 0.0
    d, outside = (diameter / MILLIMETRE for diameter in diameters)
    n = abs(speed) / RPM
    nu = from_si("viscosity_mm2_s", viscosity)
    geometry = geometry_factor(kind)
    mean = 0.5 * (d + outside)
    depth = min(level / MILLIMETRE, 1.2 * mean)
    slenderness = (outside + d) / (outside - d)
    balls = rows * geometry * slenderness * 1e-12
    angle = 2.0 * acos(max(min((0.6 * mean - depth) / (0.6 * mean), 1.0), -1.0))
    wetted = sin(0.5 * angle) if angle <= pi else 1.0
    surface = 0.36 * mean**2 * (angle - sin(angle)) * 0.05 * geometry * slenderness
    factor = drag_factor(depth / mean) if stirred is None else stirred
    churning = 0.4 * factor * balls * mean**5 * n**2
    fitted = min(nu, RANGES["skf"].viscosity[1])
    stirring = 1.093e-7 * n**2 * mean**3 * (n * mean**2 * wetted / fitted) ** -1.379 * surface
    stirring *= nu / fitted
    jets = 2.0 if lubrication is Lubrication.OIL_JET else 1.0
    return jets * (churning + stirring) * NEWTON_MILLIMETRE


def drag_factor(level: float) -> float:
    """V_M, linear between points digitised by a third party (unverified).

    Parameters
    ----------
    level : float
        oil level over the mean diameter [-]

    Returns
    -------
    float
        V_M [-]
    """
    drag = library_data(SKF_DATA)["drag"]
    return float(np.interp(level, drag["level"], drag["V_M"]))


@dataclass(frozen=True, slots=True, kw_only=True)
class InletFactors:
    """Factors of the rolling moment of flooded, isothermal films [-], and their sources."""

    shear_heating: float = 1.0  # of a moment that has no film
    replenishment: float = 1.0
    replenishment_source: str = ""
    limit: str = ""  # the end of the factors' range at which they are held; empty inside
    # phi_rs beyond the end of its range as well [-]
    extrapolated_replenishment: float = 1.0

    @property
    def rolling(self) -> float:
        """Both together [-], of a moment that has no film."""
        return self.shear_heating * self.replenishment


NO_LOSS = InletFactors()


def inlet_factors(
    bearing: Bearing,
    speed: float,
    viscosity: float,
    lubrication: Lubrication,
    *,
    layered: bool = False,
) -> InletFactors:
    """Factors of the rolling moment of flooded, isothermal films, beyond the viscosities of SKF's
    model those at its end, and phi_rs not below `LEAST_REPLENISHMENT`.

    Parameters
    ----------
    bearing : Bearing
        the bearing
    speed : float
        of the rings against each other [rad/s]
    viscosity : float
        kinematic, of the oil [m^2/s]
    lubrication : skf.Lubrication
        the way the oil comes to the bearing
    layered : bool, default False
        whether the oil at the inlets is given or solved

    Returns
    -------
    InletFactors
        factors [-] and their sources
    """
    supplied = extrapolated = 1.0
    why_supplied = "the oil at the inlets is that of the stated supply"
    counted = min(viscosity, to_si("viscosity_mm2_s", RANGES["skf"].viscosity[1]))
    if not layered:
        geometry = geometry_factor(bearing_kind(bearing))
        product = speed * counted
        sizes = diameters(bearing)
        by_skf = replenishment_factor(geometry, lubrication, product, sizes)
        extrapolated = replenishment_factor(geometry, lubrication, speed * viscosity, sizes)
        supplied = max(by_skf, LEAST_REPLENISHMENT)
        why_supplied = f"SKF's phi_rs, {lubrication.value}"
    return InletFactors(
        shear_heating=inlet_shear_factor(speed, counted, mean_diameter(bearing)),
        replenishment=supplied,
        replenishment_source=why_supplied,
        limit=_limit(viscosity, supplied),
        extrapolated_replenishment=extrapolated,
    )


def _limit(viscosity: float, replenishment: float) -> str:
    """The end of the range at which factors of a viscosity [m^2/s] are held; empty inside."""
    nu = from_si("viscosity_mm2_s", viscosity)
    end = RANGES["skf"].viscosity[1]
    limits = []
    if nu > end:
        limits.append(
            f"SKF's factors of the inlet are those at {end:g} mm2/s, the oil has {nu:.3g}"
        )
    if replenishment <= LEAST_REPLENISHMENT:
        limits.append(f"phi_rs is held at {LEAST_REPLENISHMENT:g}, where its range ends")
    elif replenishment < FALLING_REPLENISHMENT:
        limits.append(
            f"phi_rs is {replenishment:.2g}; below {FALLING_REPLENISHMENT:.2g} SKF's rolling "
            "moment falls as the oil thickens"
        )
    return "; ".join(limits)


def mean_diameter(bearing: Bearing) -> float:
    """(d + D)/2 where both are given, else the pitch diameter.

    Parameters
    ----------
    bearing : Bearing
        the bearing

    Returns
    -------
    float
        diameter [m]
    """
    return 0.5 * sum(diameters(bearing))


def diameters(bearing: Bearing) -> tuple[float, float]:
    """Bore and outside diameter; where one is not given, about the pitch diameter, a section of
    `BALL_TO_SECTION` apart.

    Parameters
    ----------
    bearing : Bearing
        the bearing

    Returns
    -------
    bore
        [m]
    outside
        [m]
    """
    if bearing.bore is not None and bearing.outside_diameter is not None:
        return bearing.bore, bearing.outside_diameter
    section = bearing.ball_diameter / BALL_TO_SECTION
    return bearing.pitch_diameter - 0.5 * section, bearing.pitch_diameter + 0.5 * section


def bearing_kind(bearing: Bearing) -> Series:
    """Kind of a bearing in SKF's tables: deep groove or angular contact.

    Parameters
    ----------
    bearing : Bearing
        the bearing

    Returns
    -------
    skf.Series
        kind
    """
    return Series.ANGULAR_CONTACT if bearing.angular_contact else Series.DEEP_GROOVE


def viscous_factor(kind: str, lubrication: str) -> float:
    """Palmgren's f_0.

    Parameters
    ----------
    kind : str
        "deep groove" or "angular contact"
    lubrication : str
        "grease", "oil bath", "low oil bath" (as a bath), "oil jet" (twice the bath) or "oil air"
        (half of it)

    Returns
    -------
    float
        f_0 [-]
    """
    factors = library_data(PALMGREN_DATA)["viscous"]
    base = factors[kind]["grease" if lubrication == "grease" else "oil bath"]
    return float(factors.get(lubrication, 1.0) * base)


def load_factor(kind: str, equivalent_static_load: float, static_rating: float) -> float:
    """Palmgren's f_1 = z (P_0/C_0)^y, in the middle of the range for z (unverified).

    Parameters
    ----------
    kind : str
        "deep groove" or "angular contact"
    equivalent_static_load : float
        P_0 [N]
    static_rating : float
        C_0 [N]

    Returns
    -------
    float
        f_1 [-]
    """
    low, high, power = library_data(PALMGREN_DATA)["load"][kind]
    return float(0.5 * (low + high) * (equivalent_static_load / static_rating) ** power)


def directed_load(kind: str, radial: float, axial: float) -> float:
    """P_1: 3.3 F_a - 0.1 F_r (deep groove), F_a - 0.1 F_r (angular contact), not less than F_r.

    Parameters
    ----------
    kind : str
        "deep groove" or "angular contact"
    radial : float
        F_r [N]
    axial : float
        F_a [N]

    Returns
    -------
    float
        P_1 [N]
    """
    slope = 3.3 if kind == "deep groove" else 1.0
    return max(slope * abs(axial) - 0.1 * abs(radial), abs(radial))


def palmgren_torque(
    mean_diameter: float, speed: float, viscosity: float, viscous: float, load: tuple[float, float]
) -> tuple[float, float]:
    """M_0 and M_1: f_0 1e-7 (nu n)^(2/3) d_m^3 above nu n = 2000, f_0 160e-7 d_m^3 below; f_1 P_1
    d_m.

    Parameters
    ----------
    mean_diameter : float
        d_m [m]
    speed : float
        of the rotating ring [rad/s]
    viscosity : float
        kinematic [m^2/s]
    viscous : float
        f_0 [-]
    load : tuple[float, float]
        f_1 [-] and P_1 [N]

    Returns
    -------
    viscous
        M_0 [N m]
    load
        M_1 [N m]
    """
    product = from_si("viscosity_mm2_s", viscosity) * abs(speed) / RPM
    growth = 1e-7 * product ** (2 / 3) if product >= BRANCH else 160e-7
    viscous_moment = viscous * growth * (mean_diameter / MILLIMETRE) ** 3 * NEWTON_MILLIMETRE
    return viscous_moment, load[0] * load[1] * mean_diameter
