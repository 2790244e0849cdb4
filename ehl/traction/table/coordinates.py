"""Coordinates of a motion on the axes of a traction table, in [-1, 1].

For a slide S over the speed u, a scale s of the film's own (a share of where the traction has
risen by half) and the largest slide L

    X = (1 - w) asinh(S/(u s))/asinh(L/s) + w e(S/u)/e(L),

e(t) = t across the rolling direction, sqrt(1 + r) - sqrt(1 + r - t/2) along it, r = `REST_SHARE`,
the same from t = 2 on: near a slide-roll ratio of 2 one body is slow, and the heat that it takes
up, and with it the traction, turns as the root of its speed; at rest it conducts, too. S_x is
taken at the vertex of the parabola of spin and curvature slip, near zero; spin counts as
Omega R_x/u, without e.
"""

from collections.abc import Callable

import numpy as np

from ...arrays import Array
from .._kernels import LIMIT_SHARE, REST_SHARE, SHIFT_MARGIN, SPIN_SHARE, SPIN_SHARE_Y, STANDING
from .table import TableContact

FurtherTerm = Callable[[Array | float], Array]
STEPS = 60  # of an inversion at most; some ten are needed
INVERTED = 1e-14  # of a place that is inverted, or of the last step to it


def vertex_slide(spin: Array, contact: TableContact, load: float) -> Array:
    """Evaluate the sliding at the vertex of the parabola of spin and curvature slip.

    Added to slide_x it is a coordinate, see `at_vertex`. -Omega y - omega y^2/(2R) is largest at y
    = -Omega R/omega. Where slide_x cancels it the traction changes most sharply. Off the ellipse
    there is no vertex: y = -b r/(1 + r^4)^(1/4) with r = Omega R/(omega b), which is the vertex
    for small r and the end of the ellipse for large ones.

    Parameters
    ----------
    spin : Array
        Omega R_x/u, any shape [-]
    contact : TableContact
        contact of the table
    load : float
        load of the film [N]

    Returns
    -------
    Array
        sliding over u, shape of `spin` [-]
    """
    curvature = 0.5 / contact.curvature_radius
    b = contact.unit_semi_axes[1] * np.cbrt(load)
    if curvature <= 0.0:
        return 0.0 * spin
    far = 0.5 * spin / (curvature * b)
    fraction = far / np.sqrt(np.sqrt(1.0 + far**4))
    return np.asarray(
        b / contact.radius_x * (spin * fraction - curvature * b * fraction * fraction)
    )


def at_vertex(slide_x: Array, shift: Array, limit: float) -> Array:
    """Shift slide_x by the slide of the vertex.

    The shift fades towards the limit or, before it, the slide at which a body stands still, so
    that these have the same coordinate with any spin.

    Parameters
    ----------
    slide_x : Array
        slide over u, any shape [-]
    shift : Array
        `vertex_slide`, of this shape [-]
    limit : float
        largest slide over u [-]

    Returns
    -------
    Array
        coordinate, of this shape [-]
    """
    reach = min(limit, STANDING)
    fraction = np.minimum(np.abs(slide_x) / reach, 1.0)
    return np.asarray(slide_x + _bounded(shift, reach) * (1.0 - fraction * fraction))


def from_vertex(top: Array, shift: Array, limit: float) -> Array:
    """Invert `at_vertex`.

    Parameters
    ----------
    top : Array
        coordinate of slide_x, any shape [-]
    shift : Array
        `vertex_slide`, of this shape [-]
    limit : float
        largest slide over u [-]

    Returns
    -------
    Array
        slide over u, of this shape [-]
    """
    reach = min(limit, STANDING)
    shift = _bounded(shift, reach)
    inside = np.clip(top, -reach, reach)
    apart = inside - shift
    root = np.sqrt(1.0 - 4.0 * shift * apart / reach**2)
    return np.asarray(2.0 * apart / (1.0 + root) + (top - inside))


def _bounded(shift: Array, reach: float) -> Array:
    """A shift below half the reach, so that the coordinate rises with slide_x everywhere [-]."""
    over = (SHIFT_MARGIN * shift / reach) ** 8
    return np.asarray(shift / np.sqrt(np.sqrt(np.sqrt(1.0 + over))))


def spinning_scales(
    scales: tuple[float, float], spin: Array, contact: TableContact, load: float
) -> tuple[Array, Array]:
    """Widen the scales of slide_x and slide_y by a spin.

    Along, without a vertex on the ellipse (r > 1 in `vertex_slide`) spin spreads the traction's
    rise over slides of Omega b; across always over those of Omega a.

    Parameters
    ----------
    scales : tuple[float, float]
        scales of slide_x/u and slide_y/u without spin [-]
    spin : Array
        Omega R_x/u, any shape [-]
    contact : TableContact
        contact of the table
    load : float
        load of the film [N]

    Returns
    -------
    along
        scale of slide_x/u, shape of `spin` [-]
    across
        scale of slide_y/u, of this shape [-]
    """
    curvature = 0.5 / contact.curvature_radius
    a, b = (axis * np.cbrt(load) for axis in contact.unit_semi_axes)
    steep = (0.5 * spin) ** 4
    away = steep / (steep + (curvature * b) ** 4 + np.finfo(np.float64).tiny)
    along = np.hypot(scales[0], SPIN_SHARE * away * spin * b / contact.radius_x)
    return along, np.hypot(scales[1], SPIN_SHARE_Y * spin * a / contact.radius_x)


def no_further_term(size: Array | float) -> Array:
    """Give no further term to the coordinate of a spin: asinh alone.

    Parameters
    ----------
    size : Array | float
        absolute spin over u/R_x, any shape [-]

    Returns
    -------
    Array
        not a number, shape of `size` [-]
    """
    return np.full_like(size, np.nan)


def standstill_term(size: Array | float) -> Array:
    """Evaluate the further term of slide_x: a slow body takes up heat as the root of its speed.

    Parameters
    ----------
    size : Array | float
        absolute slide over u, any shape [-]

    Returns
    -------
    Array
        term, shape of `size` [-]
    """
    whole = 1.0 + REST_SHARE
    return np.asarray(np.sqrt(whole) - np.sqrt(whole - np.minimum(size / STANDING, 1.0)))


def linear_term(size: Array | float) -> Array:
    """Evaluate the further term of slide_y: even steps of the slide, where its heat counts.

    Parameters
    ----------
    size : Array | float
        absolute slide over u, any shape [-]

    Returns
    -------
    Array
        term, shape of `size` [-]
    """
    return np.asarray(size)


COORDINATE_TERMS = (standstill_term, linear_term, no_further_term)  # of slide_x, slide_y and spin


def motion_coordinate(
    motion: Array, scale: Array | float, limit: float, further_term: FurtherTerm
) -> Array:
    """Evaluate the coordinate X of a motion on its axis.

    Mostly asinh(S/(u s))/asinh(L/s), s the scale and L the limit, and a further term over that of
    the limit.

    Parameters
    ----------
    motion : Array
        S/u, any shape [-]
    scale : Array | float
        scale s, of a shape that fits [-]
    limit : float
        largest motion L [-]
    further_term : FurtherTerm
        further term by the absolute motion

    Returns
    -------
    Array
        coordinate within [-1, 1], of the common shape [-]
    """
    size = np.abs(motion)
    place = np.arcsinh(size / scale) / np.arcsinh(limit / scale)
    further = further_term(np.minimum(size, limit)) / further_term(limit)
    mixed = (1.0 - LIMIT_SHARE) * place + LIMIT_SHARE * further
    return np.copysign(np.where(np.isnan(further), place, mixed), motion)


def motion_at(
    place: Array, scale: Array | float, limit: float, further_term: FurtherTerm
) -> Array:
    """Invert `motion_coordinate`.

    In asinh(S/(u s)), over which the coordinate is nearly a line, by the secant through two values
    on either side, of which one that stays twice counts half.

    Parameters
    ----------
    place : Array
        coordinate within [-1, 1], any shape [-]
    scale : Array | float
        scale s, of a shape that fits [-]
    limit : float
        largest motion L [-]
    further_term : FurtherTerm
        further term by the absolute motion

    Returns
    -------
    Array
        S/u, of the common shape [-]
    """
    place, scale = np.broadcast_arrays(np.asarray(place, dtype=np.float64), scale)
    wanted = np.minimum(np.abs(place), 1.0)
    ends = [np.zeros(place.shape), np.arcsinh(limit / scale) * np.ones(place.shape)]
    off = [-wanted, 1.0 - wanted]
    side = np.zeros(place.shape)
    at = ends[0]
    for _ in range(STEPS):
        apart = off[1] - off[0]
        fraction = np.divide(-off[0], apart, out=np.zeros(place.shape), where=apart > 0.0)
        last = at
        at = ends[0] + fraction * (ends[1] - ends[0])
        result = (
            motion_coordinate(np.minimum(scale * np.sinh(at), limit), scale, limit, further_term)
            - wanted
        )
        if np.all((np.abs(result) <= INVERTED) | (np.abs(at - last) <= INVERTED * at)):
            break
        below = result < 0.0
        off = [
            np.where(below, result, np.where(side > 0.0, 0.5, 1.0) * off[0]),
            np.where(below, np.where(side < 0.0, 0.5, 1.0) * off[1], result),
        ]
        ends = [np.where(below, at, ends[0]), np.where(below, ends[1], at)]
        side = np.where(below, -1.0, 1.0)
    return np.copysign(np.minimum(scale * np.sinh(at), limit), place)
