"""One contact of a ball with a race: its place in the bearing's frame, its curvatures, the
ellipse as friction laws take it, and Hertz' ellipses of many contacts at once:
`ehl.closed_form.hertz.hertz_contact`, to round-off, in a tenth of the time.

n points from the ball into the race, x along the entrainment and y across, x cross y = n. The
outer contact lies at (sin ao, cos ao e_r) from the ball's centre, the inner one opposite to (sin
ai, cos ai e_r).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.special import elliprd, elliprf

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import HertzContact, hertz_contact
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.traction.shear import ContactShape

from ..geometry import Bearing, Race, contact_modulus, reduced_radii

RACES = (Race.INNER, Race.OUTER)  # order of the contacts of a ball

UNLOADED = 1e-6  # semi-axis of a contact without load [m]

NEWTON_STEPS = 60
STEP_TOLERANCE = 1.0e-14  # of ln k, relative, at which Newton's method has converged [-]
CIRCLE = 1.0e-4  # k^2 - 1 below which the derivative is that of the circle [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingContact:
    """Contact of one ball with one race."""

    ball: int  # number of the ball, from 1, counted through all rows
    azimuth: float  # [rad]
    race: Race
    # input of the film solver; None where the contact is unloaded or nothing entrains oil
    conditions: ContactConditions | None
    hertz: HertzContact | None  # the dry contact; None where unloaded
    load: float  # [N]
    contact_angle: float  # [rad]
    spin_roll_ratio: float | None  # magnitude of relative spin over relative rolling [-]
    # Qi sin(ai)/Fc [-], at inner races; None at outer ones and without centrifugal force
    hirano_ratio: float | None
    origin: Array  # (3,) contact point in the bearing's frame [m]
    axis_x: Array  # (3,) direction of the entrainment [-]
    axis_y: Array  # (3,) transverse direction [-]
    normal: Array  # (3,) into the race [-]
    note: str = ""  # why there are no conditions; empty where there are
    row: int = 1  # number of the ball's row, from 1

    @property
    def loaded(self) -> bool:
        """The film of this contact can be solved."""
        return self.conditions is not None


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


def hertz_contacts(
    load: Array, radius_x: Array, radius_y: Array, reduced_modulus: Array
) -> list[HertzContact]:
    """Ellipses, pressures and approaches of contacts under loads, Hertz (1882).

    Parameters
    ----------
    load : Array
        normal loads, above zero, shape (N,) [N]
    radius_x, radius_y : Array
        reduced radii of curvature in x and y, shape (N,) [m]
    reduced_modulus : Array
        E', shape (N,) [Pa]

    Returns
    -------
    list[HertzContact]
        one dry contact for each load
    """
    k = ellipse_ratios(radius_x / radius_y)
    f = np.cbrt(2.0 / np.pi * elliprd(0.0, k**2, 1.0))
    g = 3.0 / (2.0 * np.pi * k * f**2)
    d = 3.0 / np.pi * elliprf(0.0, 1.0, k**2) / f
    size = np.cbrt(load / (reduced_modulus * radius_x**2))
    semi_axis_x = f * size * radius_x
    values = {
        "load": load,
        "radius_x": radius_x,
        "radius_y": radius_y,
        "reduced_modulus": reduced_modulus,
        "semi_axis_x": semi_axis_x,
        "semi_axis_y": k * semi_axis_x,
        "pressure": g * size * reduced_modulus,
        "approach": d * size**2 * radius_x,
    }
    return [
        HertzContact(**dict(zip(values, row, strict=True)))
        for row in np.stack(list(values.values()), axis=1).tolist()
    ]


def ellipse_ratios(radius_ratio: Array) -> Array:
    """Ratios of the semi-axes k = b/a, as `ehl.closed_form.hertz.ellipse_ratio` computes one.

    Newton's method in ln k, kept inside the bracket between (Rx/Ry)^-1 and (Rx/Ry)^-1/4.

    Parameters
    ----------
    radius_ratio : Array
        Rx/Ry, shape (N,) [-]

    Returns
    -------
    Array
        b/a, shape (N,) [-]
    """
    target = np.log(radius_ratio)
    low, high = np.minimum(-target, -0.25 * target), np.maximum(-target, -0.25 * target)
    t = -2.0 / 3.0 * target  # exact slope at the circle
    for _ in range(NEWTON_STEPS):
        residual, slope = _log_radius_ratios(t)
        residual -= target
        low, high = np.where(residual > 0.0, t, low), np.where(residual > 0.0, high, t)
        ahead = t - residual / slope
        ahead = np.where((low <= ahead) & (ahead <= high), ahead, 0.5 * (low + high))
        change = np.abs(ahead - t).max(initial=0.0)
        t = ahead
        if change <= STEP_TOLERANCE * max(1.0, float(np.abs(t).max(initial=0.0))):
            break
    return np.exp(t)


def _log_radius_ratios(t: Array) -> tuple[Array, Array]:
    """ln(Rx/Ry) [-] at k = exp(t) and its slope [-]; d(R_D)/dk follows from the common integral of
    both.
    """
    k2 = np.exp(2.0 * t)
    along_x = elliprd(0.0, k2, 1.0)
    along_y = elliprd(0.0, 1.0, k2)
    away = np.abs(k2 - 1.0) > CIRCLE
    mixed = np.where(
        away, (along_x - along_y) / np.where(away, k2 - 1.0, 1.0), 9.0 * np.pi / 16.0 * k2**-1.25
    )
    return np.log(along_y / along_x), -3.0 + mixed / along_y + k2 * mixed / along_x
