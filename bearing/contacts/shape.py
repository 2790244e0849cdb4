"""Shape of a contact between ball and race: curvatures, and the ellipse of friction laws."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.traction.shear import ContactShape

from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from .contact import RACES, BearingContact

UNLOADED = 1e-6  # semi-axis of a contact without load [m]


def groove_radius(bearing: Bearing, race: Race) -> float:
    """Radius r of a race's groove in section.

    Parameters
    ----------
    bearing : Bearing
        the bearing
    race : Race
        inner or outer race

    Returns
    -------
    float
        radius [m]
    """
    return bearing.inner_groove_radius if race is Race.INNER else bearing.outer_groove_radius


def groove_curvature_radius(bearing: Bearing, race: Race) -> float:
    """Radius of the loaded surface across the rolling direction, 2 r D/(2 r + D), Harris and
    Kotzalas.

    The mean of the curvatures of ball and groove, as two equal half spaces under the same pressure
    deform alike.

    Parameters
    ----------
    bearing : Bearing
        the bearing
    race : Race
        inner or outer race

    Returns
    -------
    float
        radius [m]
    """
    groove = groove_radius(bearing, race)
    return 2.0 * groove * bearing.ball_diameter / (2.0 * groove + bearing.ball_diameter)


class DryContacts(NamedTuple):
    """Contacts as friction takes them, each of shape (contacts,); not to be changed."""

    load: Array  # [N]; zero where there is no contact
    semi_axis_x: Array  # along the rolling direction [m]; UNLOADED where there is no contact
    semi_axis_y: Array  # and across it [m]
    radius: Array  # `groove_curvature_radius` [m]


def dry_contacts(bearing: Bearing, contacts: Sequence[BearingContact]) -> DryContacts:
    """Loads, axes and curvatures of contacts.

    Parameters
    ----------
    bearing : Bearing
        The bearing.
    contacts : sequence of BearingContact
        Some of its contacts.

    Returns
    -------
    DryContacts
        In the order of the contacts.
    """
    none = (0.0, UNLOADED, UNLOADED)
    radius = {race: groove_curvature_radius(bearing, race) for race in RACES}
    dry = [contact.hertz for contact in contacts]
    rows = [none if h is None else (h.load, h.semi_axis_x, h.semi_axis_y) for h in dry]
    load, along, across = np.array(rows).reshape(-1, 3).T
    curved = np.array([radius[contact.race] for contact in contacts])
    return DryContacts(load, along, across, curved)


def contact_shape(bearing: Bearing, race: Race, contact_angle: float) -> ContactShape:
    """Ellipse at 1 N and curvatures of the contact of a ball with a race.

    Parameters
    ----------
    bearing : Bearing
        the bearing
    race : Race
        inner or outer race
    contact_angle : float
        of the contact [rad]

    Returns
    -------
    ContactShape
        lengths [m], curvatures [1/m]
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
