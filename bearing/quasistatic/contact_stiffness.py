"""Hertz stiffness of ball and race as a smooth function of the contact angle.

The reduced radius in the rolling direction, D/2 (1 -+ D cos(angle)/d_m), and with it K in Q = K
approach^1.5 depend on the cosine of the contact angle c alone, and analytically: the nearest
singularity lies at |c| = d_m/D > 1. A Chebyshev series of ln K over 0 <= c <= 1 with 24 terms is
exact to round-off (d_m/D = 2 loses a factor 5.8 a term), so the equilibrium needs no elliptic
integrals in its loop.
"""

from functools import lru_cache
from math import acos, cos, log, pi

import numpy as np
from numpy.polynomial import chebyshev

from ehl.arrays import Array
from ehl.closed_form.hertz import contact_stiffness

from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from ..operation import Curvature
from .kinematics import Numbers

TERMS = 24


@lru_cache(maxsize=256)
def stiffness_series(bearing: Bearing, race: Race, curvature: Curvature) -> Array:
    """Chebyshev coefficients of ln K and of its slope over the cosine of the contact angle.

    In 2 c - 1 over c in [0, 1]; second column d(ln K)/dc. K in N/m^1.5; with FREE that at the free
    angle.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    race : Race
        raceway in contact
    curvature : Curvature
        contact angle at which the curvature is taken

    Returns
    -------
    Array
        coefficients, shape (TERMS, 2) [-]
    """
    modulus = contact_modulus(bearing, race)

    def log_stiffness(angle: float) -> float:
        return log(contact_stiffness(*reduced_radii(bearing, race, angle), modulus))

    series = np.zeros((TERMS, 2))
    if curvature is Curvature.FREE:
        series[0, 0] = log_stiffness(bearing.free_contact_angle)
        return series
    nodes = [cos(pi * (k + 0.5) / TERMS) for k in range(TERMS)]
    values = np.array([log_stiffness(acos(0.5 * (1.0 + x))) for x in nodes])
    series[:, 0] = chebyshev.chebfit(nodes, values, TERMS - 1)
    series[:-1, 1] = 2.0 * chebyshev.chebder(series[:, 0])
    return series


def stiffness_at(series: Array, cosine: Numbers) -> Numbers:
    """K at cosines of contact angles, real or under a complex step.

    Continued linearly beyond a right angle.

    Parameters
    ----------
    series : Array
        coefficients of `stiffness_series` [-]
    cosine : Numbers
        cosines of contact angles [-]

    Returns
    -------
    Numbers
        K, in the shape of the cosines [N/m^1.5]
    """
    c = np.clip(cosine.real, 0.0, 1.0)
    # the same for all directions of a complex step, along the first axis
    distinct = c[:1] if np.iscomplexobj(cosine) and c.ndim > 1 else c
    polynomials = np.cos(np.arange(TERMS) * np.arccos(2.0 * distinct - 1.0)[..., None])
    both = polynomials @ series
    return np.exp(both[..., 0]) * (1.0 + both[..., 1] * (cosine - c))
