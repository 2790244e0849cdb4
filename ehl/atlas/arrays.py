"""Films of many flooded contacts at once from the atlas.

The functions of `table` are evaluated once on a lattice of its slanted x for each of its patches,
and contacts take a cubic through the nodes, which is within their error bars and takes some
microsecond (`python benchmarks/film_atlas.py`). They cover `films.RANGE`, not what `range_of` adds
for ball bearings.
"""

from dataclasses import dataclass
from functools import cache
from math import log, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import Array
from ..closed_form.film import MAX_FILM_OVER_RADIUS
from ..closed_form.hertz import hertz_coefficients
from . import _kernels
from .films import RANGE, STIFFNESS_ERROR
from .table import (
    BASE_ALPHA,
    BASE_Z,
    LIGHT,
    SEAM,
    Patch,
    error_bars,
    heavy_weight,
    oil_features,
    patch_base,
    patch_oils,
    slanted,
    table,
)

# nodes of the slanted x of `table`, of light and heavy contacts: the first axis lies across the
# step of the central film; with 161 of light ones films are within 0.2 % only, with half of all
# heavy ones within 0.4 %
NODES = ((225, 13, 17), (25, 21, 41))
RATIOS = 129  # of ln D for f, within 2e-9; half as many within 3e-8
FUNCTIONS = 3  # ln(Hc A), ln(Hmin A), Hc - H0
TABULATED = FUNCTIONS + 2  # with the derivatives by ln A of first and last


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactArrays:
    """Many flooded contacts with entrainment along x, arrays that NumPy brings to one shape; the
    oil has Roelands' viscosity and the density of Dowson and Higginson.
    """

    load: ArrayLike  # [N]
    radius_x: ArrayLike  # reduced, along and across the entrainment [m]
    radius_y: ArrayLike  # [m]
    reduced_modulus: ArrayLike  # E' [Pa]
    entrainment_speed: ArrayLike  # [m/s]
    viscosity: ArrayLike  # at ambient pressure [Pa s]
    pressure_viscosity: ArrayLike  # likewise [1/Pa]
    roelands_z: ArrayLike  # [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmArrays:
    """Films of contacts, arrays of one shape; not numbers where the atlas does not cover them."""

    central: Array  # [m]
    minimum: Array  # [m]
    approach: Array  # h_0, the constant of the film equation [m]
    stiffness: Array  # -dF/dh_0 [N/m]
    # errors that cover nineteen of twenty contacts, those of the approach in its unit [m], others
    # over the value [-]
    central_error: Array
    minimum_error: Array  # over the film [-]
    approach_error: Array  # in its unit [m]
    stiffness_error: Array  # over the stiffness [-]
    inside: NDArray[np.bool_]  # True where the atlas covers the contact


class _Lattice(NamedTuple):
    """Lattice in which contacts of a patch are looked up [-]."""

    slant: Array  # of the patch
    low: Array  # (3,) of slanted x
    step: Array  # (3,)
    values: Array  # (..., 3) over a lattice of `NODES`, of the oil of the solves
    oils: Array  # (..., 5, 3) there, what each of the `oil_features` is multiplied by


def atlas_arrays(contacts: ContactArrays) -> FilmArrays:
    """Evaluate films of many contacts from the atlas, as `atlas_films` does for one.

    Parameters
    ----------
    contacts : ContactArrays
        contacts, arrays that NumPy brings to one shape

    Returns
    -------
    FilmArrays
        films, arrays of this shape [m], [N/m]

    Raises
    ------
    ValueError
        if the arrays cannot be brought to one shape
    """
    shape, columns = _contact_columns(contacts)
    # 1. places in the table, those of contacts outside anywhere
    place = _positions(columns)
    place.x[~place.inside] = np.log(SEAM[1]), 1.0, 0.0
    # 2. functions, films in a^2/Rx
    x = place.x
    result = _interpolated(place)
    # 3. scales
    base = (place.alpha == BASE_ALPHA) & (place.z == BASE_Z)
    bars = error_bars(x, base)
    height = place.height
    heavy = x[:, 0] >= log(LIGHT)
    central, minimum = (np.exp(result[:, k] - x[:, 0]) * height for k in (0, 1))
    approach = central - result[:, 2] * height
    rise = central * (result[:, 3] - 1.0) - result[:, 4] * height  # dh_0/dlnA
    stiffness = -1.5 * columns[0] / (approach + rise)
    inside = place.inside & (central <= MAX_FILM_OVER_RADIUS * columns[1])

    def covered(values: Array) -> Array:
        return np.where(inside, values, np.nan).reshape(shape)

    return FilmArrays(
        central=covered(central),
        minimum=covered(np.minimum(central, minimum)),
        approach=covered(approach),
        stiffness=covered(stiffness),
        central_error=covered(bars[:, 0]),
        minimum_error=covered(bars[:, 1]),
        approach_error=covered(bars[:, 2] * height + bars[:, 0] * central),
        stiffness_error=covered(np.where(heavy, STIFFNESS_ERROR[1], STIFFNESS_ERROR[0])),
        inside=inside.reshape(shape),
    )


def _interpolated(place: "_Positions") -> Array:
    """The functions and the derivatives by ln A of first and last, shape (n, 5) [-]."""
    fraction, rise = heavy_weight(place.x[:, 0])
    features = oil_features(place.x, place.alpha, place.z)
    result = np.zeros((len(fraction), TABULATED))
    for lattice, fractions in zip(
        _lattices(), ((1.0 - fraction, -rise), (fraction, rise)), strict=True
    ):
        x = slanted(place.x, lattice.slant)
        _kernels.look_up(x, features, np.stack(fractions), *lattice[1:], result)
    return result


def _contact_columns(c: ContactArrays) -> tuple[tuple[int, ...], list[Array]]:
    """Shape of the contacts, and their numbers in the order of the fields, shape (n,)."""
    given = (c.load, c.radius_x, c.radius_y, c.reduced_modulus, c.entrainment_speed, c.viscosity)
    arrays = np.broadcast_arrays(*given, c.pressure_viscosity, c.roelands_z)
    columns = [np.asarray(values, dtype=np.float64).ravel() for values in arrays]
    return arrays[0].shape, columns


class _Positions(NamedTuple):
    """Positions of contacts in the table, shape (n,) but for x of (n, 3) [-]."""

    x: Array
    alpha: Array  # [1/Pa]
    z: Array
    height: Array  # a^2/Rx [m]
    inside: NDArray[np.bool_]


def _positions(columns: list[Array]) -> _Positions:
    """L = alpha E' (2U)^(1/4), D and A = f^2 M^(2/3) = f^2 (F/(E' Rx^2))^(2/3)/sqrt(2U)."""
    force, along, across, modulus, speed, eta, alpha, z = columns
    x = np.empty((len(force), 3))
    with np.errstate(all="ignore"):  # what is not positive is outside
        twice = 2.0 * eta * speed / (modulus * along)
        thick = alpha * modulus * twice**0.25
        ratio = along / across
        x[:, 1] = np.sqrt(thick)
        x[:, 2] = np.log(ratio)
        size = _axes(x[:, 2])
        unit = size**2 * (force / (modulus * along**2)) ** (2.0 / 3.0)
        heavy = unit / np.sqrt(twice)
        x[:, 0] = np.log(heavy)
        inside = _in_range((heavy, thick, ratio, z, alpha))
    return _Positions(
        x=x,
        alpha=np.where(inside, alpha, BASE_ALPHA),
        z=np.where(inside, z, BASE_Z),
        height=np.where(inside, unit * along, 1.0),
        inside=inside,
    )


@cache
def _lattices() -> tuple[_Lattice, _Lattice]:
    """Build the lattices of light and of heavy contacts, once."""
    known = table()
    lightest, heaviest = RANGE["A = a^2/(Rx^2 sqrt(2U))"]
    ends = ((known.light, lightest, SEAM[1]), (known.heavy, SEAM[0], heaviest))
    light, heavy = (_lattice(*end, nodes) for end, nodes in zip(ends, NODES, strict=True))
    return light, heavy


def _lattice(
    patch: Patch, lightest: float, heaviest: float, nodes: tuple[int, int, int]
) -> _Lattice:
    """Build the lattice of a patch between two A."""
    thick, ratio = RANGE["L"], RANGE["Rx/Ry"]
    low = np.array([log(lightest), sqrt(thick[0]), log(ratio[0])])
    high = np.array([log(heaviest), sqrt(thick[1]), log(ratio[1])])
    axes = [np.linspace(low[k], high[k], nodes[k]) for k in range(3)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    slants = (slanted(x, patch.slant) - x)[:, 0]
    low[0] += slants.min()
    high[0] += slants.max()
    x[:, 0] = np.repeat(np.linspace(low[0], high[0], nodes[0]), nodes[1] * nodes[2]) - slants
    parts = np.array_split(x, nodes[0])  # a plane at a time: radial functions of all are large
    values = np.concatenate([patch_base(patch, part)[:, :FUNCTIONS] for part in parts])
    oils = np.concatenate([patch_oils(patch, part)[:, :, :FUNCTIONS] for part in parts])
    return _Lattice(
        slant=patch.slant,
        low=low,
        step=(high - low) / (np.array(nodes) - 1.0),
        values=np.ascontiguousarray(values.reshape(*nodes, FUNCTIONS)),
        oils=np.ascontiguousarray(oils.reshape(*nodes, *oils.shape[1:])),
    )


@cache
def _axis_nodes() -> Array:
    """ln f over even ln D, shape (RATIOS,) [-]."""
    ratios = np.geomspace(*RANGE["Rx/Ry"], RATIOS)
    return np.log([hertz_coefficients(float(ratio))[0] for ratio in ratios])


def _axes(log_ratio: Array) -> Array:
    """f of contacts by ln D, shape (n,) [-]."""
    low, high = np.log(RANGE["Rx/Ry"])
    step = (high - low) / (RATIOS - 1.0)
    return np.asarray(_kernels.axis_ratios(log_ratio, low, step, _axis_nodes()))


def _in_range(values: tuple[Array, ...]) -> NDArray[np.bool_]:
    """Mark where A, L, D, z and alpha lie in the range of the atlas, shape (n,)."""
    result = np.ones(values[0].shape, dtype=np.bool_)
    for (low, high), value in zip(RANGE.values(), values, strict=True):
        result &= (value >= low) & (value <= high)
    return result
