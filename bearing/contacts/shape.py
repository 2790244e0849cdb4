"""Shape of a contact between ball and race: curvatures, and the ellipse as friction laws take
it.
"""

from collections.abc import Sequence

import numpy as np

from ehl.closed_form.hertz import hertz_contact
from ehl.traction.laws import ContactShape

from ..geometry import Array, Bearing, Race, contact_modulus, reduced_radii
from .contact import RACES, BearingContact


def groove_radius(bearing: Bearing, race: Race) -> float:
    """Radius r of a race's groove in section [m]."""
    return bearing.inner_groove_radius if race is Race.INNER else bearing.outer_groove_radius


def groove_curvature_radius(bearing: Bearing, race: Race) -> float:
    """Radius of the loaded surface across the rolling direction, 2 r D/(2 r + D) [m], Harris and
    Kotzalas.

    The mean of the curvatures of ball and groove, as two equal half spaces under the same pressure
    deform alike.
    """
    groove = groove_radius(bearing, race)
    return 2.0 * groove * bearing.ball_diameter / (2.0 * groove + bearing.ball_diameter)


def groove_curvature_radii(bearing: Bearing, contacts: Sequence[BearingContact]) -> Array:
    """`groove_curvature_radius` of the race of each contact, (contacts,) [m]."""
    radius = {race: groove_curvature_radius(bearing, race) for race in RACES}
    return np.array([radius[contact.race] for contact in contacts])


def contact_shape(bearing: Bearing, race: Race, contact_angle: float) -> ContactShape:
    """Ellipse at 1 N and curvatures of the contact of a ball with a race at a contact angle
    [rad].
    """
    radius_x, radius_y = reduced_radii(bearing, race, contact_angle)
    hertz = hertz_contact(1.0, radius_x, radius_y, contact_modulus(bearing, race))
    return ContactShape(
        semi_axis_x=hertz.semi_axis_x,
        semi_axis_y=hertz.semi_axis_y,
        radius_x=radius_x,
        curvature_radius=groove_curvature_radius(bearing, race),
        curvature_difference=1.0 / radius_x - 4.0 / bearing.ball_diameter,
    )
