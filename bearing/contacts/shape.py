"""Shape of a contact between ball and race, as the laws of friction take it."""

from ehl.closed_form.hertz import hertz_contact
from ehl.traction.laws import ContactShape

from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from .motion import groove_curvature_radius


def contact_shape(bearing: Bearing, race: Race, contact_angle: float) -> ContactShape:
    """Ellipse at 1 N and curvatures of the contact of a ball with a race at a contact angle [rad]."""
    radius_x, radius_y = reduced_radii(bearing, race, contact_angle)
    hertz = hertz_contact(1.0, radius_x, radius_y, contact_modulus(bearing, race))
    return ContactShape(
        semi_axis_x=hertz.semi_axis_x,
        semi_axis_y=hertz.semi_axis_y,
        radius_x=radius_x,
        curvature_radius=groove_curvature_radius(bearing, race),
        curvature_difference=1.0 / radius_x - 4.0 / bearing.ball_diameter,
    )
