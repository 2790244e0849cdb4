"""The contacts of the verification page, by name, and contacts in SI from Moes' groups."""

from dataclasses import dataclass, replace
from math import pi

from oilfilm.ehl import ContactConditions, DensityLaw, Lubricant, MoesConditions, ViscosityLaw
from oilfilm.ehl.closed_form.hertz import ellipse_ratio, hertz_coefficients

Box = tuple[float, float, float]
Conditions = ContactConditions | MoesConditions

OIL = Lubricant(viscosity=0.05, pressure_viscosity=22e-9, roelands_z=0.68)
MINERAL_OIL = Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
CERAMIC_OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
WATER_LIKE = Lubricant(
    viscosity=0.05,
    pressure_viscosity=20e-9,
    viscosity_law=ViscosityLaw.ISOVISCOUS,
    density_law=DensityLaw.INCOMPRESSIBLE,
)
STEEL = 226e9  # E' of steel on steel, E 206 GPa, nu 0.3 [Pa]
CIRCULAR_BOX = (-4.5, 1.5, 3.0)
DEGREE = pi / 180.0


@dataclass(frozen=True, slots=True)
class Named:
    """A contact with its name; box [Hertz half-extents], None leaves it to the solver."""

    name: str
    conditions: Conditions
    box: Box | None = None


def moes(m: float, l: float, ratio: float = 1.0, angle: float = 0.0, oil: Lubricant = MINERAL_OIL) -> MoesConditions:
    """A contact by M, L, Rx/Ry [-] and the angle of its entrainment [rad]."""
    return MoesConditions(
        load_parameter=m, lubricant_parameter=l, radius_ratio=ratio, entrainment_angle=angle, lubricant=oil
    )


# a thin film in an ellipse, the entrainment oblique: cycles alone may fail on coarse grids
SKEWED = moes(
    1924.0, 1.596, 0.0473, 72.0 * DEGREE, Lubricant(viscosity=0.04, pressure_viscosity=20.35e-9, roelands_z=0.6256)
)
# an ellipse whose entrainment turns from place to place
TURNING = ContactConditions(
    load=50.0,
    radius_x=0.006,
    radius_y=0.03,
    reduced_modulus=226e9,
    entrainment_speed=5.0,
    lubricant=replace(OIL, viscosity=0.04),
    mean_spin=1500.0,
)
# a ball of half an inch on a disc, steel
BALL_ON_DISC = ContactConditions(
    load=20.0,
    radius_x=0.0127,
    radius_y=0.0127,
    reduced_modulus=2.2e11,
    entrainment_speed=1.0,
    lubricant=Lubricant(viscosity=0.04, pressure_viscosity=2e-8),
)


def from_groups(
    groups: MoesConditions, rotation: float = 0.0, modulus: float = STEEL, radius: float = 0.01
) -> ContactConditions:
    """The contact in SI: Rx and E' given, the speed and the load that make its M and L.

    Parameters
    ----------
    groups : MoesConditions
        With L > 0 and an oil of pressure-viscosity > 0.
    rotation : float
        Speed of the entrainment's rotation at the end of the longer semi-axis over u_m [-].
    modulus : float
        E' [Pa].
    radius : float
        Rx [m].
    """
    oil = groups.lubricant
    double_speed = (groups.lubricant_parameter / (oil.pressure_viscosity * modulus)) ** 4  # 2U [-]
    load = groups.load_parameter * double_speed**0.75  # W [-]
    speed = 0.5 * double_speed * modulus * radius / oil.viscosity
    semi_axis = hertz_coefficients(groups.radius_ratio)[0] * load ** (1 / 3) * radius
    longer = semi_axis * max(1.0, ellipse_ratio(groups.radius_ratio))
    return ContactConditions(
        load=load * modulus * radius**2,
        radius_x=radius,
        radius_y=radius / groups.radius_ratio,
        reduced_modulus=modulus,
        entrainment_speed=speed,
        lubricant=oil,
        entrainment_angle=groups.entrainment_angle,
        mean_spin=rotation * speed / longer,
    )


def race_6208(load: float, outer: bool = False) -> ContactConditions:
    """Ball on a race of the all-ceramic 6208 at 10 000 r/min under a load [N]."""
    ball = 6e-3
    race = 36e-3 if outer else 24e-3
    groove = 6.29e-3 if outer else 6.17e-3
    return ContactConditions(
        load=load,
        radius_x=1.0 / (1.0 / ball + (-1.0 if outer else 1.0) / race),
        radius_y=1.0 / (1.0 / ball - 1.0 / groove),
        reduced_modulus=310e9 / (1.0 - 0.26**2),
        entrainment_speed=15.0796,
        lubricant=CERAMIC_OIL,
    )


CIRCULAR_20_10 = Named("M 20, L 10", moes(20.0, 10.0, oil=OIL), box=CIRCULAR_BOX)
CIRCULAR_200_10 = Named("M 200, L 10", moes(200.0, 10.0, oil=OIL), box=CIRCULAR_BOX)
INNER_500N = Named("6208 inner race, 500 N", race_6208(500.0), box=(-16.5, 1.5, 2.25))
OBLIQUE = Named("M 100, L 8, R_x/R_y 0.3, entrainment at 30°", moes(100.0, 8.0, 0.3, 30.0 * DEGREE))
SPINNING = Named(
    "M 100, L 8, R_x/R_y 0.1, rotation 0.3 u_m at the end of the ellipse",
    from_groups(moes(100.0, 8.0, 0.1), rotation=0.3),
)
NAMED = (
    CIRCULAR_20_10,
    Named("M 20, L 10", CIRCULAR_20_10.conditions),
    CIRCULAR_200_10,
    Named("M 200, L 10", CIRCULAR_200_10.conditions),
    INNER_500N,
    Named("6208 inner race, 500 N", race_6208(500.0)),
    Named("6208 outer race, 1612 N", race_6208(1611.8, outer=True)),
    Named("6208 outer race, 15 N (thick film)", race_6208(15.48, outer=True)),
    Named("M 700, L 12, R_x/R_y 0.03 (wide ellipse)", moes(700.0, 12.0, 0.03)),
    Named("M 100, L 8, R_x/R_y 5 (along the longer axis)", moes(100.0, 8.0, 5.0)),
    Named("M 5, L 0.5 (thick film)", moes(5.0, 0.5)),
    Named("M 150, L 0, isoviscous, incompressible", moes(150.0, 0.0, oil=WATER_LIKE)),
    OBLIQUE,
    SPINNING,
)
