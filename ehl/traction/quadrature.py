"""A film as a list of nodes that shear, and its sliding forces for many motions; twin of the
kernels' sums.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from ..kinematics import ContactKinematics
from ..oil.rheology import Rheology, kernel_rheology, limiting_stress, shear_stress
from ..solution import ContactSolution
from . import _kernels
from .shear import Cavitation, pressure_viscosity, sheared_width, with_outlet

Array = NDArray[np.float64]

HERTZ_SHARE = 0.02  # of the largest pressure: what lies above it gets nodes of its own
ROWS = 64  # lines along x there
# of each: shares from edge to edge, nodes; the spike is in the last
PANELS = ((0.0, 0.75, 10), (0.75, 1.0, 14))
# [m] thinner than any molecule: what films that did not converge are held to
SMALLEST_FILM = 1e-12
BLOCK = 10  # nodes of the grid along x and y that become one elsewhere
# of the friction at the largest sliding, in nodes that are not worth their time
SHARE_LEFT_OUT = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmNodes:
    """Nodes of a film: place, area, film, viscosity, limiting stress.

    Attributes
    ----------
    nodes : ndarray, shape (8, n)
        x, y [m], area times sheared width [m^2], film [m], viscosity [Pa s], limiting stress [Pa],
        and a twelfth of the squared size along x and y [m^2]: the mean square of a linear sliding
        over the node exceeds that at its place by the squared slope times these, and keeps the
        sums free of steps where sliding changes its sign.
    half_width : float
        Transverse semi-axis, beyond which curvature slip does not grow [m].
    rheology : Rheology
    """

    nodes: Array
    half_width: float
    rheology: Rheology


def film_nodes(
    solution: ContactSolution,
    rheology: Rheology,
    largest_slide: float,
    *,
    temperature: float | None = None,
    left_out: float = SHARE_LEFT_OUT,
) -> FilmNodes:
    """Nodes of a film that count.

    Parameters
    ----------
    solution : ContactSolution
        Of dimensional conditions [m], [Pa].
    rheology : Rheology
    largest_slide : float
        Sliding speed [m/s] at which the friction of each node is weighed.
    temperature : float, optional
        For the limiting stress [K].
    left_out : float
        Share of the whole friction that the weakest nodes make and that is dropped with them [-].

    Returns
    -------
    FilmNodes
    """
    if solution.x is None or solution.y is None or solution.film is None:
        raise ValueError("solution: traction needs dimensional conditions, not Moes' groups alone")
    zone = hertz_zone(solution)
    rest = low_pressure_blocks(with_outlet(solution))
    fields = np.concatenate([zone.fields.reshape(7, -1), rest], axis=1)
    gap = np.maximum(fields[3], SMALLEST_FILM)
    pressure = fields[4]
    eta = pressure_viscosity(pressure, solution)
    limit = limiting_stress(pressure, rheology, temperature)
    strength = fields[2] * shear_stress(largest_slide / gap, eta, pressure, rheology, temperature)
    counts = counting(strength, left_out * float(strength.sum()))
    nodes = node_rows(fields, eta, limit)[:, counts]
    return FilmNodes(
        nodes=np.ascontiguousarray(nodes),
        half_width=transverse_semi_axis(solution),
        rheology=rheology,
    )


def counting(strength: Array, left_out: float) -> NDArray[np.intp]:
    """Numbers of the nodes without the weakest ones, whose strengths sum to what may be left out
    [same unit].
    """
    order = np.argsort(strength)
    found: NDArray[np.intp] = order[np.cumsum(strength[order]) > left_out]
    return found


def node_rows(fields: Array, viscosity: Array, limit: Array) -> Array:
    """Rows of `FilmNodes.nodes` from x, y, area, film, pressure and sizes (7, n), [Pa s] and [Pa]."""
    x, y, area, gap, _, width, breadth = fields
    limits = np.broadcast_to(limit, x.shape)
    film = np.maximum(gap, SMALLEST_FILM)
    return np.stack([x, y, area, film, viscosity, limits, width**2 / 12.0, breadth**2 / 12.0])


def transverse_semi_axis(solution: ContactSolution) -> float:
    """Of the Hertz ellipse across x [m]."""
    return float(solution.semi_axis_x or 0.0) * solution.semi_axis_ratio


@dataclass(frozen=True, slots=True, kw_only=True)
class HertzZone:
    """Nodes where the pressure is high, on lines along x.

    Attributes
    ----------
    fields : ndarray, shape (7, lines, n)
        x, y [m], area [m^2], film [m], pressure [Pa], size along x and y [m].
    gradient : ndarray, shape (2, lines, n)
        Of the pressure along x and y [Pa/m].
    span : ndarray, shape (lines,)
        Length of each line from edge to edge [m].
    shares : ndarray, shape (n,)
        Places of the nodes from edge to edge [-].
    """

    fields: Array
    gradient: Array
    span: Array
    shares: Array


def hertz_zone(solution: ContactSolution) -> HertzZone:
    """Midpoints of `ROWS` lines across, Gauss-Legendre points of `PANELS` along each from edge to
    edge [m], [Pa].
    """
    x = solution.x
    y = solution.y
    h = solution.film
    p = solution.pressure
    assert x is not None and y is not None and h is not None
    near = p > HERTZ_SHARE * p.max()
    window = tuple(_around(near.any(axis=1 - axis)) for axis in (0, 1))
    x = x[window[0]]
    y = y[window[1]]
    h = h[window]
    p = p[window]
    film, pressure = (RectBivariateSpline(x, y, part) for part in (h, p))
    ends = _crossings(y, p.max(axis=0) - HERTZ_SHARE * p.max())
    width = (ends[1] - ends[0]) / ROWS
    rows = ends[0] + (np.arange(ROWS) + 0.5) * width
    lines = pressure(x, rows) - HERTZ_SHARE * p.max()
    edges = np.array([_crossings(x, line) for line in lines.T])
    shares, weights = _panels()
    span = (edges[:, 1] - edges[:, 0])[:, None]
    places = edges[:, :1] + span * shares
    across = np.broadcast_to(rows[:, None], places.shape)
    values = (
        film(places, across, grid=False),
        np.maximum(pressure(places, across, grid=False), 0.0),
    )
    slopes = (
        pressure(places, across, dx=1, grid=False),
        pressure(places, across, dy=1, grid=False),
    )
    fields = (
        places,
        across,
        span * weights * width,
        *values,
        span * weights,
        np.full_like(places, width),
    )
    return HertzZone(
        fields=np.stack(fields), gradient=np.stack(slopes), span=span[:, 0], shares=shares
    )


def _panels() -> tuple[Array, Array]:
    """Places from edge to edge and their weights [-]."""
    rules = [(low, high, *np.polynomial.legendre.leggauss(count)) for low, high, count in PANELS]
    places = [low + 0.5 * (high - low) * (nodes + 1.0) for low, high, nodes, _ in rules]
    return np.concatenate(places), np.concatenate(
        [0.5 * (high - low) * w for low, high, _, w in rules]
    )


def _around(chosen: NDArray[np.bool_]) -> slice:
    """From a few nodes before the first chosen one to a few after the last."""
    found = np.flatnonzero(chosen)
    return slice(max(int(found[0]) - 3, 0), int(found[-1]) + 4)


def _crossings(places: Array, values: Array) -> tuple[float, float]:
    """First and last place where values, interpolated linearly, pass zero; the ends where they do
    not.
    """
    positive = np.flatnonzero(values > 0.0)
    if positive.size == 0:
        return float(places[values.argmax()]), float(places[values.argmax()])
    first = int(positive[0])
    last = int(positive[-1])
    low, high = float(places[first]), float(places[last])
    if first > 0:
        low -= (
            (places[first] - places[first - 1])
            * values[first]
            / (values[first] - values[first - 1])
        )
    if last < places.size - 1:
        high += (
            (places[last + 1] - places[last]) * values[last] / (values[last] - values[last + 1])
        )
    return float(low), float(high)


def low_pressure_blocks(solution: ContactSolution, *further: Array) -> Array:
    """Nodes where the pressure is low, blocks of the grid: rows as `HertzZone.fields` and one for
    each further field.

    They shear a Newtonian oil as all their nodes do under linear sliding: film A/sum(A/h), place,
    pressure and further fields, of shape (nx, ny) [any unit], weighted by A/h.
    """
    x = solution.x
    y = solution.y
    h = solution.film
    p = solution.pressure
    assert x is not None and y is not None and h is not None
    low = p <= HERTZ_SHARE * p.max()
    size_x = np.gradient(x)[:, None]
    size_y = np.gradient(y)[None, :]
    area = size_x * size_y * sheared_width(h, p, Cavitation.STRIATED) * low
    block = np.add.outer(np.arange(x.size) // BLOCK * y.size, np.arange(y.size) // BLOCK).ravel()

    def total(values: Array) -> Array:
        sums: Array = np.bincount(block, values.ravel()).astype(np.float64)
        return sums

    share = area / np.maximum(h, SMALLEST_FILM)
    weight, thin = total(area), total(share)
    kept = weight > 0.0
    weight, thin = weight[kept], thin[kept]
    weighted = (
        share * x[:, None],
        share * y[None, :],
        share * p,
        *(share * field for field in further),
    )
    means = [total(part)[kept] / thin for part in weighted]
    sizes = [np.full(weight.size, BLOCK * float(np.mean(size))) for size in (size_x, size_y)]
    return np.stack([means[0], means[1], weight, weight / thin, means[2], *sizes, *means[3:]])


def sliding_forces(
    film: FilmNodes, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> Array:
    """F_x, F_y [N] and M_n, M_y [N m] on body 1 by sliding, for each of n motions, shape (n, 4).

    Parameters
    ----------
    film : FilmNodes
    slide : tuple of ndarray, shape (n,)
        slide_x, slide_y [m/s] and spin [rad/s].
    rolling : ndarray, shape (n,)
        Relative rolling speed [rad/s].
    curvature : float
        1/(2R) of the loaded surface [1/m].
    """
    r = kernel_rheology(film.rheology)
    out = np.empty((slide[0].size, _kernels.COLUMNS))
    law = (r.law, r.stress, r.exponent, r.breadth)
    _kernels.sliding_sums_many(film.nodes, *law, *slide, rolling, curvature, film.half_width, out)
    return out


def sliding_forces_twin(film: FilmNodes, kinematics: ContactKinematics) -> Array:
    """`sliding_forces` of one motion in NumPy, shape (4,), [N] and [N m]."""
    x, y, area, gap, eta, limit, along, across = film.nodes
    sliding = mean_sliding(kinematics, x, y, (along, across))
    tau = shear_stress(sliding[2] / gap, eta, 0.0 * eta, film.rheology.unlimited)
    finite = np.isfinite(limit)
    tau = np.where(
        finite, -np.where(finite, limit, 1.0) * np.expm1(-tau / np.where(finite, limit, 1.0)), tau
    )
    return summed_forces(kinematics, (x, y, area), tau, sliding)


def mean_sliding(
    kinematics: ContactKinematics, x: Array, y: Array, sizes: tuple[Array, Array]
) -> tuple[Array, Array, Array]:
    """Sliding at nodes along x and y, and its root mean square over each [m/s].

    Parameters
    ----------
    kinematics : ContactKinematics
    x, y : ndarray
        Places of the nodes [m].
    sizes : tuple of ndarray
        A twelfth of their squared size along x and y [m^2].
    """
    k, (along, across) = kinematics, sizes
    s_x, s_y = k.sliding(x, y)
    slope = k.spin + 2.0 * k.rolling * k.curvature * np.where(
        np.abs(y) < k.curvature_width, y, 0.0
    )
    return s_x, s_y, np.sqrt(s_x**2 + s_y**2 + slope**2 * across + k.spin**2 * along)


def summed_forces(
    kinematics: ContactKinematics,
    nodes: tuple[Array, Array, Array],
    stress: Array,
    sliding: tuple[Array, Array, Array],
) -> Array:
    """F_x, F_y [N] and M_n, M_y [N m] on body 1, shape (4,), of stresses [Pa] at nodes.

    Parameters
    ----------
    kinematics : ContactKinematics
    nodes : tuple of ndarray
        x, y [m] and area [m^2].
    stress : ndarray
        [Pa].
    sliding : tuple of ndarray
        As of `mean_sliding` [m/s].
    """
    (x, y, area), (s_x, s_y, speed) = nodes, sliding
    pull = area * stress / np.where(speed > 0.0, speed, 1.0)
    t_x, t_y = pull * s_x, pull * s_y
    return np.array(
        [-t_x.sum(), -t_y.sum(), (y * t_x - x * t_y).sum(), -(kinematics.bow(y) * t_x).sum()]
    )
