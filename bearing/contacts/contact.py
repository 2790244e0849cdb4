"""One contact of a ball with a race: its place in the bearing's frame, its curvatures, the
ellipse as friction laws take it, and Hertz' ellipses of many contacts at once:
`ehl.closed_form.hertz.hertz_contact`, to round-off, in a tenth of the time.

n points from the ball into the race, x along the entrainment and y across, x cross y = n. The
outer contact lies at (sin ao, cos ao e_r) from the ball's centre, the inner one opposite to (sin
ai, cos ai e_r).
"""

from dataclasses import dataclass

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import HertzContact
from oilfilm.ehl.conditions import ContactConditions

from ..geometry import Race
from ..material import STEEL_EFFUSIVITY

DRY_NOTE = "dry running: no film"  # why a loaded contact has no conditions
RACES = (Race.INNER, Race.OUTER)  # order of the contacts of a ball


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
    # sqrt(k rho c) of ball and race [W s^(1/2)/(m^2 K)]
    effusivities: tuple[float, float] = (STEEL_EFFUSIVITY, STEEL_EFFUSIVITY)
    note: str = ""  # why there are no conditions; empty where there are
    row: int = 1  # number of the ball's row, from 1
    # gap between ball and race, undeformed, of a light ball between two films, else None [m]
    gap: float | None = None

    @property
    def dry(self) -> bool:
        """Nothing lubricates this loaded contact."""
        return self.note == DRY_NOTE

    @property
    def loaded(self) -> bool:
        """The film of this contact can be solved."""
        return self.conditions is not None


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
    f = np.cbrt(2.0 / np.pi * scipy.special.elliprd(0.0, k**2, 1.0))
    g = 3.0 / (2.0 * np.pi * k * f**2)
    d = 3.0 / np.pi * scipy.special.elliprf(0.0, 1.0, k**2) / f
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
    along_x = scipy.special.elliprd(0.0, k2, 1.0)
    along_y = scipy.special.elliprd(0.0, 1.0, k2)
    away = np.abs(k2 - 1.0) > CIRCLE
    mixed = np.where(
        away, (along_x - along_y) / np.where(away, k2 - 1.0, 1.0), 9.0 * np.pi / 16.0 * k2**-1.25
    )
    return np.log(along_y / along_x), -3.0 + mixed / along_y + k2 * mixed / along_x
