"""Table of a contact's traction over load, entrainment speed, sliding along both axes, and spin.

The approximation: the film is that of the Newtonian oil without sliding, solved at each load and
speed, isothermal or, with the thermal properties of both bodies, with its heat; the shear of the
rheology is evaluated in it at each motion, then with the heat of sliding
(`generalized.heated_film`).
Coordinates keep the nodes few: minus load^(-1/5), as light contacts change more with the load,
ln(speed), and those of the motion, with scales of the film's own, which are splines over load and
speed, too. Values are the forces and moments of sliding over units whose logarithms are splines:
the largest of their film, kappa_max Q for the forces, smoothed over load and speed, as they bend
where another motion has the largest. The mirror image in y halves the table: with slide_y and spin
reversed F_y and M_n are. All are cubic B-splines.

The coordinates of a motion lie in [-1, 1]. For a slide S over the speed u, a scale s of the film's
own (a share of where the traction has risen by half) and the largest slide L

    X = (1 - w) asinh(S/(u s))/asinh(L/s) + w e(S/u)/e(L),

e(t) = t across the rolling direction, sqrt(1 + r) - sqrt(1 + r - t/2) along it, r = `REST_SHARE`,
the same from t = 2 on: near a slide-roll ratio of 2 one body is slow, and the heat that it takes
up, and with it the traction, turns as the root of its speed; at rest it conducts, too. S_x is
taken at the vertex of the parabola of spin and curvature slip, near zero; spin counts as
Omega R_x/u, without e.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf, isfinite, log, nan

import numpy as np

from ..arrays import Array
from ..closed_form.hertz import hertz_contact
from ..conditions import ContactConditions
from ..oil.lubricant import Lubricant
from ..oil.rheology import Rheology
from ..options import require_positive
from ..solid.heat import SolidThermal
from ..traction import _kernels
from ..traction._kernels import (
    LIMIT_SHARE,
    LOAD_POWER,
    REST_SHARE,
    SHIFT_MARGIN,
    SPIN_SHARE,
    SPIN_SHARE_Y,
    STANDING,
)
from ..traction.law import TractionForces
from .compression import Numbers, Values, whole_numbers
from .splines import spline_weights

# bits of the kernel
FLAGS = ("load below", "load above", "speed below", "speed above", "slide_x", "slide_y", "spin")

FurtherTerm = Callable[[Array | float], Array]
STEPS = 60  # of an inversion at most; some ten are needed
INVERTED = 1e-14  # of a place that is inverted, or of the last step to it


@dataclass(frozen=True, slots=True, kw_only=True)
class TableContact:
    """Inputs of a table: the pair of bodies, the oil, its rheology and temperature."""

    radius_x: float  # reduced radius of curvature along the entrainment [m]
    radius_y: float  # and across [m]
    reduced_modulus: float  # E' [Pa]
    lubricant: Lubricant  # oil of the contact
    rheology: Rheology  # its shear law
    temperature: float  # of the oil at the inlet [K]
    # radius of the loaded surface across the entrainment; infinite: no curvature slip [m]
    curvature_radius: float = inf
    curvature_difference: float = 0.0  # 1/R_2x - 1/R_1x of the bodies [1/m]
    # body 1, the ball, and body 2; None: the oil stays at its temperature
    solids: tuple[SolidThermal, SolidThermal] | None = None
    ball_radius: float | None = None  # of body 1 [m]; None: body 2 counts as a plane

    def conditions(self, load: float, speed: float) -> ContactConditions:
        """Give the conditions of a film without sliding.

        Parameters
        ----------
        load : float
            load [N]
        speed : float
            entrainment speed [m/s]

        Returns
        -------
        ContactConditions
            conditions of the contact
        """
        shared = ("radius_x", "radius_y", "reduced_modulus", "lubricant", "ball_radius")
        bodies = {name: getattr(self, name) for name in shared}
        return ContactConditions(load=load, entrainment_speed=speed, **bodies)

    @property
    def unit_semi_axes(self) -> tuple[float, float]:
        """Semi-axes along the rolling direction and across it at 1 N [m]; they grow with the cube
        root of the load.
        """
        at_one = hertz_contact(1.0, self.radius_x, self.radius_y, self.reduced_modulus)
        return at_one.semi_axis_x, at_one.semi_axis_y


@dataclass(frozen=True, slots=True, kw_only=True)
class TableRange:
    """Range of a table."""

    load: tuple[float, float]  # smallest and largest [N]
    speed: tuple[float, float]  # of entrainment [m/s]
    slide_x: float = 2.0  # largest, over the speed; 2: one surface at rest [-]
    slide_y: float = 1.0  # largest, over the speed [-]
    spin: float = 0.6  # largest, over the relative rolling speed u_m/R_x [-]

    def __post_init__(self) -> None:
        for field in ("load", "speed"):
            low, high = getattr(self, field)
            if not (isfinite(high) and 0.0 < low < high):
                raise ValueError(f"{field} must be a range of positive numbers, got {(low, high)}")
        require_positive(self, "slide_x", "slide_y", "spin")

    @property
    def motions(self) -> tuple[float, float, float]:
        """Largest slide_x, slide_y and spin, over u and u/R_x [-]."""
        return self.slide_x, self.slide_y, self.spin


def latin_hypercube(ends: Array, count: int, rng: np.random.Generator) -> Array:
    """Draw points between ends, one in each of `count` layers along every axis.

    Parameters
    ----------
    ends : Array
        lowest and highest value of each axis, shape (d, 2) [any unit]
    count : int
        number of points [-]
    rng : np.random.Generator
        generator of random numbers

    Returns
    -------
    Array
        points, shape (d, count) [same unit]
    """
    layers = np.stack([rng.permutation(count) for _ in ends])
    fractions = (layers + rng.random(layers.shape)) / count
    return np.asarray(ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * fractions)


@dataclass(frozen=True, slots=True, kw_only=True)
class TableError:
    """Error at films and motions that are not in the table, against shear evaluated there.

    Forces are measured against kappa_max Q, moments about n against their own largest, about y
    against their largest by sliding and the hydrodynamic one together, at each load and speed.
    """

    largest: float  # of the force vector over kappa_max Q [-]
    quantile: float  # exceeded by 5 % of the points [-]
    rms: float  # root of the mean square [-]
    largest_spin: float  # of the spin moment over its largest [-]
    largest_rolling: float  # of the rolling moment over its largest [-]
    films: int  # films solved for the check
    motions: int  # motions at each
    tolerance: float  # asked for, on the largest [-]
    # error of the force vector over kappa_max Q at as many motions without spin or with little,
    # from slides of 1e-7 of the entrainment on; NaN in files written before it was known [-]
    largest_straight: float = nan
    # over those solved at `responses` films of the check; NaN where none converged and in files
    # written before they were measured
    largest_stiffness: float = nan  # of the stiffness over that solved [-]
    largest_damping: float = nan  # of the damping [-]
    responses: int = 0  # films of the check with both

    @property
    def reached(self) -> bool:
        """True if every point of the check is within the tolerance, those drawn evenly in the
        table's coordinates; `largest_straight` counts near rolling without spin.
        """
        return self.largest <= self.tolerance


@dataclass(frozen=True, slots=True, kw_only=True)
class FullSolve:
    """Traction on the table's film and in a full solve; NaN where that diverged."""

    load: float  # [N]
    speed: float  # of entrainment [m/s]
    slide_ratio: float  # sliding over the entrainment speed [-]
    by_film: float  # force of sliding over the load, sheared on the table's film [-]
    in_full: float  # the same in the full solve [-]
    film_ratio: float  # central film of the full solve over that of the table's film [-]
    converged: bool  # both solves


@dataclass(frozen=True, kw_only=True)
class TractionTable:
    """Traction of one contact over load, speed and motion: a friction law with the film, stiffness
    and damping.

    `scalars` holds spline coefficients of the logarithms of the scales of slide_x, slide_y, spin
    [-], the central film [m], the hydrodynamic moment [N m], stiffness [N/m], damping [N s/m], and
    the units of force [N] and moments about n and y [N m] of sliding; `values` those of the
    sliding forces and moments over these units [-].

    Examples
    --------
    Tables of a bearing are kept as a file by `oilfilm table`, and read again:

    >>> from oilfilm.bearing.friction.tables import load_tables
    >>> tables = load_tables("6208_table.zip")  # doctest: +SKIP
    >>> inner, outer = tables.values()  # doctest: +SKIP
    >>> inner.forces(300.0, 8.0, 0.05, 0.0, 0.0).force_x  # doctest: +SKIP
    """

    contact: TableContact  # bodies, oil and temperature
    range: TableRange  # of load, speed and motion
    points: int  # of the films along x
    # start, nodes per unit, nodes of load_coordinate(load), ln(speed), and the scaled motions, of
    # slide_y the half above zero; shape (5, 3)
    axes: Array
    scalars: Array  # shape (nQ + 2, nU + 2, 10)
    values: Values  # of `stored_values`, shape (nQ + 2, nU + 2, nX + 2, nY + 2, nS + 2, 4)
    kappa_max: float  # largest coefficient of sliding of all films, at the smallest loads [-]
    error: TableError  # of the check
    films: int  # solved in all, with those of the check
    converged: bool  # every film, stiffness and damping, and the tolerance is reached
    message: str  # status of the build
    # LIMIT_SHARE, SPIN_SHARE_Y and REST_SHARE of the coordinates [-]
    spacing: tuple[float, float, float] = (LIMIT_SHARE, SPIN_SHARE_Y, REST_SHARE)
    full_solves: tuple[FullSolve, ...] = ()  # beside films of the table, where requested

    @cached_property
    def constants(self) -> Array:
        """Constants as the kernel takes them, shape (13,): see `_kernels.table_lookup`."""
        contact = self.contact
        bodies = (contact.radius_x, contact.curvature_difference)
        along, across = contact.unit_semi_axes
        ellipse = (across, 0.5 / contact.curvature_radius)
        unit = self._numbers[1]
        return np.array([*bodies, *self.range.motions, *ellipse, unit, along, *self.spacing, 0.0])

    @cached_property
    def _numbers(self) -> tuple[Numbers, float]:
        """The values as the kernel takes them, and their unit."""
        return whole_numbers(self.values)

    def kernel_arguments(self) -> tuple[Array, Array, Array, Numbers]:
        """The arrays that `_kernels.table_lookup` takes before load and motion."""
        return self.axes, self.constants, self.scalars, self._numbers[0]

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Look up the traction, see `TractionLaw.forces`.

        Outside the table's range the nearest point counts, forces in proportion to the load, and
        `outside` names the quantities that lie there.

        Parameters
        ----------
        load : float
            normal load [N]
        speed : float
            entrainment speed [m/s]
        slide_x, slide_y : float
            sliding of body 1 along x and y [m/s]
        spin : float
            spin of body 1 [rad/s]

        Returns
        -------
        TractionForces
            forces and moments on body 1, film, stiffness and damping
        """
        out = np.empty(8)
        motion = (load, speed, slide_x, slide_y, spin)
        flag = _kernels.table_lookup(*self.kernel_arguments(), *motion, out)
        outside = tuple(name for bit, name in enumerate(FLAGS) if flag >> bit & 1)
        return TractionForces._make((*map(float, out), outside))

    def with_rolling(self, factor: float) -> "TractionTable":
        """Scale the hydrodynamic moment of the table: a shift of its logarithm.

        Parameters
        ----------
        factor : float
            factor on the moment [-]

        Returns
        -------
        TractionTable
            table with that moment
        """
        if factor == 1.0:
            return self
        scalars = self.scalars.copy()
        scalars[..., _kernels.HYDRODYNAMIC] += log(factor)
        shifted = replace(self, scalars=scalars)
        vars(shifted)["_numbers"] = self._numbers  # of the same values: a torque point asks anew
        return shifted

    def units(self, load: float, speed: float) -> Array:
        """Evaluate the units of the forces and moments of sliding.

        They are the largest ones, smoothed over load and speed, off by up to 17, 30 and 17 % where
        a film turns.

        Parameters
        ----------
        load : float
            load [N]
        speed : float
            entrainment speed [m/s]

        Returns
        -------
        Array
            units of force [N] and of the moments about n and y [N m], shape (3,)
        """
        scalars = self.scalars
        for axis, place in zip(self.axes, (load_coordinate(load), log(speed)), strict=False):
            first, weights = spline_weights((place - axis[0]) * axis[1], int(axis[2]))
            scalars = np.tensordot(weights, scalars[first : first + 4], axes=1)
        return np.exp(scalars[_kernels.LARGEST_FORCE : _kernels.LARGEST_ROLLING + 1])


def load_coordinate(load: float) -> float:
    """Evaluate the coordinate of a load on its axis.

    Parameters
    ----------
    load : float
        load [N]

    Returns
    -------
    float
        coordinate [N^(-1/5)]
    """
    return float(-(load**LOAD_POWER))


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
