"""Quantities of slip maps: operation of the case and its balls, maps, curves, minimum loads."""

from ..bearing.quantities import BALL_QUANTITY
from ..quantities import Quantity, quantities

SPEED = Quantity("speed_krpm", "speed of the inner ring")  # of the axes of pictures
OPERATION = quantities(
    "",
    "",
    ("speed_rpm", "", "operation.inner_speed"),
    *("ring_force_N", "ring_moment_N_mm", "tilt_mrad"),
)
BALLS = tuple(  # of the equilibrium at the operation of the case
    BALL_QUANTITY[key]
    for key in (
        *("azimuth_deg", "inner_load_N", "outer_load_N", "inner_contact_angle_deg"),
        "centrifugal_force_N",
    )
)
SLIP_FACTOR = Quantity("slip_factor", "slip factor $Q_i\\,\\sin\\alpha_i/F_c$", symbol="SF")
AXIAL_LOAD, RADIAL_LOAD = quantities(
    "", "", ("axial_loads_N", "axial load", "axial_loads"), ("radial_loads_N", "radial load")
)
WORST_FACTOR = Quantity("slip_factor_minimum", "slip factor of the worst ball", "minimum")
SPEEDS = Quantity("speeds_rpm", "speed", "speeds")
SURFACE = (SPEEDS, AXIAL_LOAD, WORST_FACTOR)
CURVE = (Quantity("speed_rpm", "speed", "speed"), RADIAL_LOAD)
NOT_GIVEN = "[slip] {} is not given"
MINIMUM_LOADS = (
    Quantity("hirano_N", "Hirano", "hirano", symbol="Hirano"),
    Quantity(
        *("as_printed_N", "as printed: half the centrifugal force", "as_printed"),
        NOT_GIVEN.format("as_printed"),
        "as printed",
    ),
    Quantity(
        *("skf_axial_N", "SKF minimum axial load", "skf_axial"),
        NOT_GIVEN.format("minimum_axial_load_factor_kN"),
        "SKF axial",
    ),
    Quantity(
        *("skf_radial_N", "SKF minimum radial load", "skf_radial"),
        NOT_GIVEN.format("minimum_radial_load_factor_kN"),
        "radial",
    ),
)
