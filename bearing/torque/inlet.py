"""What the inlets leave of the oil's rolling resistance: heat of their shear, and how much of the
oil that the last ball displaced has come back.

Both are SKF's factors of its rolling moment (Rolling bearings, 10000 EN, 2013, pages 104 to 106),
here of the integrated one: 1 where films are solved with heat, or where the layer that they run in
is given.
"""

from dataclasses import dataclass

from ..geometry import Bearing
from . import skf

# ball diameter over the section's height D - d, where that is not given [-]: 0.28 to 0.31 of
# catalogue bearings of 60, 62 and 63
BALL_TO_SECTION = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class InletFactors:
    """Of the rolling moment of flooded, isothermal films [-], and where they are from."""

    shear_heating: float = 1.0
    replenishment: float = 1.0
    # of films not solved with heat, where others are and have their loss of their own
    unheated: float = 1.0
    heating_source: str = ""
    replenishment_source: str = ""

    @property
    def rolling(self) -> float:
        """Both together [-]."""
        return self.shear_heating * self.replenishment


NO_LOSS = InletFactors()


def inlet_factors(
    bearing: Bearing,
    speed: float,
    viscosity: float,
    lubrication: skf.Lubrication,
    *,
    heated: bool = False,
    layered: bool = False,
) -> InletFactors:
    """Factors of the rolling moment of flooded, isothermal films.

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
    heated : bool, default False
        whether films that are solved are solved with heat
    layered : bool, default False
        whether the oil at the inlets is given or solved

    Returns
    -------
    InletFactors
        factors [-] and their sources
    """
    shear = supplied = 1.0
    why_shear = "solved with the films; SKF's phi_ish where one is not"
    why_supplied = "the oil at the inlets is that of the stated supply"
    phi = skf.inlet_shear_factor(speed, viscosity, mean_diameter(bearing))
    if not heated:
        shear = phi
        why_shear = "SKF's phi_ish"
    if not layered:
        geometry = skf.geometry_factor(bearing_kind(bearing))
        product = speed * viscosity
        supplied = skf.replenishment_factor(geometry, lubrication, product, diameters(bearing))
        why_supplied = f"SKF's phi_rs, {lubrication.value}"
    return InletFactors(
        shear_heating=shear,
        replenishment=supplied,
        unheated=phi if heated else 1.0,
        heating_source=why_shear,
        replenishment_source=why_supplied,
    )


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


def bearing_kind(bearing: Bearing) -> skf.Series:
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
    return skf.Series.ANGULAR_CONTACT if bearing.angular_contact else skf.Series.DEEP_GROOVE
