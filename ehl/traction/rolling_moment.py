r"""Hydrodynamic rolling moment of the oil that a contact has, up to its meniscus.

Far from a flooded contact the pressure is :math:`s(\theta) r/H^2`, near Kapitza's (1955)
:math:`-k_x x/H^2` ahead of the contact and zero where oil breaks behind it
(`multigrid/far_field.py`), so that the moment :math:`-\iint x p` of the oil between two distances
from the centre of a paraboloid gap is, by Kapitza's,

.. math:: \frac{24 \pi\,\eta_0 u R_x^2}{(3 + 2 R_x/R_y)\sqrt{R_x/R_y}}\,\ln\frac{r_2}{r_1},

whatever the load: it grows with the logarithm of the oil's extent, half of that of the layer's.
The extent is the oil's, not the solver's box. On each ray from the centre oil counts up to the
meniscus, where the gap is as wide as the layer that the bodies carry in
(`Lubricant.flooded_layer`): in the box the solved pressure, beyond its edge that of the far field,
which the solver has set on that edge (1.4 % more than Kapitza's moment for a sphere, 3.5 % for
:math:`R_x/R_y = 1/45`). In the box the moment is that by which the surfaces turn as much power
into heat as the flow does (`pressure_moment`). The lever of the pressure alone stays above it on
every mesh on which the pressure behind the spike falls within two cells, by 5.1 % on 257 points
and 2.7 % on 1025 (M 300, L 15, :math:`R_x/R_y = 2`); films solved with shear or heat have that
one. Farther out than 0.2 of the smaller radius of a ray's section the gap is that of two circles;
the pressure goes with its square there.

Left out: the film is solved without a meniscus: at one, where the pressure vanishes,
mass conservation asks for a layer of 0.3675 of the gap under a sphere, and the moment is that of
Kapitza's pressure up to a gap of 1.446 layers: 0.18 of the moment above per unit of logarithm more
(`tests/ehl/traction/test_meniscus.py`), more yet in wide ellipses. And the pressure over the
square of the gap of circles is, up to 0.3 of the radius, 1.2 % above that of Reynolds' equation.

Near the contact the gap is a paraboloid with its deflection; farther out it is that of two
circles: in the plane of the normal and a ray body 1, a ball, is cut in a circle, and body 2 is
taken as the circle of its curvature there (Euler), which is exact in both principal planes.
`kapitza_moment` is the moment of Kapitza's pressure, for contacts that are not solved.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache
from math import hypot, inf, nan
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ..multigrid.far_field import FarField, far_field
from ..multigrid.supply.oil_supply import pressure_moment
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution
from ._kernels import circles_loss, kapitza_integral
from .shear import trapezoidal_weights

# share of a circle's radius from which on it is no parabola: its height is there 1.01 of it
PARABOLA_SHARE = 0.2
# fraction of the radius up to which a ray is followed: the circle ends, the slope of the gap is
# infinite
CIRCLE_END = 1.0 - 1e-9
HALVINGS = 40  # of the interval in which the meniscus of a ray lies: to 1e-12 of it

DIRECTIONS = 720  # rays from the centre
RAY_NODES = 24  # of Gauss and Legendre on each, in the logarithm of the distance
SMALLEST_DISTANCE = 1e-12  # from the centre over a [-]: a direction at the centre itself

SOLUTIONS = 32  # last ones of which the moment is kept, some 1 MB each
SAME_ANGLE = 1e-9  # [rad]
# Error by the mesh over the sum of what the balance of power changes and the share of the step of
# the central film from the finest grid to its limit [-]: 95 % of 71 random contacts are within
# 0.16, 0.24, 0.32, 0.39 of it on 65, 129, 257, 513 points (`benchmarks/rolling_moment.py`)
MESH_ERROR = 0.4
# films solved with shear or heat, whose balance has more terms: error of the lever arm of the load
# over the contact's half length, times (mesh/half length)^-1.5 [-]: 0.02 to 0.34 in the sixteen
# contacts of `benchmarks/rolling_moment.py`, without either, on 65 to 513 points
LEVER_ERROR = 0.4
# Relative error of the moment over the residual [-]: below 1 in most, some 10 at most in 30
# contacts on 129 points and six on 257 and 513, cycled on until the residual had vanished
RESIDUAL_ERROR = 10.0
# Relative error of the moment beyond the box [-]: solved in a box five times as long it changes by
# at most 0.19 of it (five contacts, boxes from 3 semi-axes on)
FAR_FIELD_ERROR = 0.2
# Hamrock and Dowson (1977, part IV): distance of the meniscus over the half length, below which
# the film starves, 1 + 3.06 [(R/b)^2 h/R]^0.58
FLOODED_DISTANCE = (3.06, 0.58)

RAYS = 48  # of a quarter, by Gauss and Legendre [-]
NODES = 48  # of each, in the logarithm of the distance [-]
# rays and nodes of what circles lose; 48 and 96 change it by up to 8 %, of the moment by 0.5 %
LOSS_NODES = 24
# solved over this loss: fitted to 24 contacts, `python tools/atlas/circles.py 20261126 24`, as the
# gap along a ray is not that of a circular contact [-]
LOSS = 1.1


class Sections(NamedTuple):
    """Curvatures of both bodies in the plane of the normal and a ray, over 1/a [-]."""

    ball: Array  # of body 1
    race: Array  # of body 2, negative where it is concave

    def excess(self, r: Array, height_scale: float) -> Array:
        """Evaluate the gap of the two circles less that of their parabolas.

        Parameters
        ----------
        r : Array
            distance from the centre over a, at most `end`, any shape [-]
        height_scale : float
            Rx/a [-]

        Returns
        -------
        Array
            difference of the gaps in a^2/Rx [-]
        """
        return height_scale * (_excess(self.ball, r) + _excess(self.race, r))

    def gap(self, r: Array) -> Array:
        """Evaluate the gap of the two circles.

        Parameters
        ----------
        r : Array
            distance from the centre over a, at most `end`, any shape [-]

        Returns
        -------
        Array
            gap over a [-]
        """
        return _height(self.ball, r) + _height(self.race, r)

    @property
    def end(self) -> Array:
        """Distance over a at which the smaller circle ends [-]."""
        return np.asarray(CIRCLE_END / self.largest)

    @property
    def largest(self) -> Array:
        """Curvature of the smaller circle [-]."""
        return np.maximum(np.abs(self.ball), np.abs(self.race))


def _height(curvature: Array, r: Array) -> Array:
    """Height of a circle, signed as its curvature, over a [-]."""
    squared = np.minimum((curvature * r) ** 2, 1.0)
    return np.asarray(curvature * r**2 / (1.0 + np.sqrt(1.0 - squared)))


def _excess(curvature: Array, r: Array) -> Array:
    """Height of a circle less that of its parabola, signed as its curvature, over a [-]."""
    squared = np.minimum((curvature * r) ** 2, 1.0)
    root = np.sqrt(1.0 - squared)
    # c r^2/(1 + root) - c r^2/2, without the cancellation
    return np.asarray(0.5 * curvature * r**2 * squared / (1.0 + root) ** 2)


def sections(contact: ScaledContact, ball_radius: float | None, x: Array, y: Array) -> Sections:
    """Cut both bodies in planes of the normal and a ray.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact of conditions with dimensions
    ball_radius : float | None
        radius of body 1; None: body 2 is a plane [m]
    x : Array
        component of the ray's unit vector along the grid, shape (n,) [-]
    y : Array
        component across it, shape (n,) [-]

    Returns
    -------
    Sections
        curvatures of both circles
    """
    a, scale = contact.semi_axis_x, contact.film_scale
    assert a is not None and scale is not None  # of conditions with dimensions
    both = ray_curvature(contact, x, y) * scale / a
    ball = both if ball_radius is None else np.full_like(both, a / ball_radius)
    return Sections(ball=ball, race=both - ball)


def ray_curvature(contact: ScaledContact | FarField, x: Array, y: Array) -> Array:
    """Evaluate the curvature of the gap along rays.

    Parameters
    ----------
    contact : ScaledContact | FarField
        scaled contact, or far field
    x : Array
        component of the ray's unit vector along the grid, any shape [-]
    y : Array
        component across it, of the same shape [-]

    Returns
    -------
    Array
        curvature in 1/Rx [-]
    """
    along = contact.curvature_x * x**2 + contact.curvature_y * y**2
    return np.asarray(along + 2.0 * contact.curvature_xy * x * y)


class MeniscusRegion:
    """The oil around a contact, up to a layer [m]; lengths over a, films over a^2/Rx."""

    def __init__(
        self,
        solution: ContactSolution,
        contact: ScaledContact,
        ball_radius: float | None,
        inlet_film_thickness: float,
    ) -> None:
        assert contact.film_scale is not None and contact.semi_axis_x is not None
        self.solution = solution
        self.contact = contact
        self.ball_radius = ball_radius
        self.inlet_film_thickness = inlet_film_thickness / contact.film_scale
        self.height_scale = contact.semi_axis_x / contact.film_scale
        self.field: FarField = far_field(contact)

    def dry_moment_fraction(self) -> Array:
        """Evaluate the fraction of each node's moment without oil, shape (nx, ny) [-]: beyond the
        meniscus, whose border is straight in a cell, and by the gap of circles.
        """
        solution, contact = self.solution, self.contact
        X, Y = np.broadcast_arrays(solution.X[:, None], solution.Y[None, :])
        outside = (solution.P > 0.0) & (contact.dry_pressure(X, Y) == 0.0)
        x = X[outside]
        y = Y[outside]
        film = solution.H[outside]
        gap = film + self._excess(x, y)
        # over a cell, of the gap
        rise = np.abs(contact.curvature_x * X + contact.curvature_xy * Y)
        rise = rise * np.gradient(solution.X)[:, None]
        across = np.abs(contact.curvature_y * Y + contact.curvature_xy * X)
        rise = rise + across * np.gradient(solution.Y)
        filled = np.clip(0.5 + (self.inlet_film_thickness - gap) / rise[outside], 0.0, 1.0)
        without = np.zeros_like(solution.P)
        without[outside] = 1.0 - filled * (film / gap) ** 2
        return without

    def moment_beyond_box(self) -> float:
        """Integral of -s P of the far field from the edge of the box to the meniscus, s the
        distance along the entrainment [-].
        """

        def arm(x: Array, y: Array, gap: Array) -> Array:
            return self.field.strength(x, y) / gap**2 * along_entrainment(self.contact, x, y)

        return 0.0 - self.integral_beyond_box(arm)

    def integral_beyond_box(self, integrand: Callable[[Array, Array, Array], Array]) -> float:
        """Integrate a function over the area from the edge of the box to the meniscus.

        Parameters
        ----------
        integrand : Callable[[Array, Array, Array], Array]
            function of x, y and the gap, arrays of shape (rays, nodes), in any unit

        Returns
        -------
        float
            integral, in the unit of the function
        """
        angle = (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS
        every = _Ray(self, np.cos(angle), np.sin(angle))
        wet = every.film < self.inlet_film_thickness  # the meniscus of the others is in the box
        ray = _Ray(self, every.x[wet], every.y[wet])
        span = np.log(ray.meniscus() / ray.start)[:, None]
        positions, weights = np.polynomial.legendre.leggauss(RAY_NODES)
        r = ray.start[:, None] * np.exp(0.5 * span * (positions + 1.0))
        gap = np.maximum(ray.gap(r), ray.film[:, None])  # it opens outwards
        values = integrand(ray.x[:, None] * r, ray.y[:, None] * r, gap)
        rings = np.sum(0.5 * span * weights * values * r**2, axis=1)
        return float(rings.sum()) * 2.0 * np.pi / DIRECTIONS

    def meniscus_ahead(self) -> float:
        """Distance of the meniscus from the centre, against the grid's x [-]."""
        ray = _Ray(self, np.array([-1.0]), np.array([0.0]))
        if ray.film[0] < self.inlet_film_thickness:
            return float(ray.meniscus()[0])
        X = self.solution.X
        ahead = X <= 0.0
        r = -X[ahead][::-1]
        middle = int(np.abs(self.solution.Y).argmin())
        gap = self.solution.H[ahead, middle][::-1] + self._excess(-r, np.zeros_like(r))
        narrow = np.flatnonzero(gap < self.inlet_film_thickness)
        last = int(narrow[-1]) if narrow.size else 0
        return float(
            np.interp(self.inlet_film_thickness, gap[last : last + 2], r[last : last + 2])
        )

    def _excess(self, x: Array, y: Array) -> Array:
        """Evaluate the gap of circles over that of parabolas outside the contact, less that at the
        edge of the ellipse, where the bodies conform. It is infinite where the smaller circle
        ends.
        """
        excess, reach = self._rigid_excess(x, y)
        edge, _ = self._rigid_excess(*self._nearest_edge(x, y))
        return np.asarray(np.where(reach < 1.0, excess - edge, np.inf))

    def _rigid_excess(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Excess at places, where the circles differ from parabolas, and the distance over the
        radius of the smaller circle [-].
        """
        r = np.maximum(np.hypot(x, y), SMALLEST_DISTANCE)
        circles = sections(self.contact, self.ball_radius, x / r, y / r)
        reach = circles.largest * r
        excess = circles.excess(r, self.height_scale)
        return np.where(reach > PARABOLA_SHARE, excess, 0.0), reach

    def _nearest_edge(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Place on the edge of Hertz' ellipse beside one outside it: with the same y or, past its
        ends, the end of its axis; in principal directions.
        """
        contact = self.contact
        c, s = np.cos(contact.frame_angle), np.sin(contact.frame_angle)
        along = x * c - y * s
        across = np.clip(x * s + y * c, -contact.semi_axis_ratio, contact.semi_axis_ratio)
        width = np.sqrt(1.0 - (across / contact.semi_axis_ratio) ** 2)
        along = np.clip(along, -width, width)
        return along * c + across * s, across * c - along * s


def along_entrainment(contact: ScaledContact, x: Array, y: Array) -> Array:
    """Project positions on the direction of the entrainment at the centre.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact
    x : Array
        position along the grid, any shape [-]
    y : Array
        position across it, of the same shape [-]

    Returns
    -------
    Array
        distance along the entrainment [-]
    """
    return contact.velocity_x * x + contact.velocity_y * y


class _Ray:
    """Rays from the centre beyond the edge of the box, in directions (x, y), shape (n,)."""

    def __init__(self, oil: MeniscusRegion, x: Array, y: Array) -> None:
        solution = oil.solution
        self.oil = oil
        self.x = x
        self.y = y
        self.start = _edge_distance(solution, x, y)
        self.curvature = ray_curvature(oil.contact, x, y)
        self.end = sections(oil.contact, oil.ball_radius, x, y).end
        self.film = _edge_film(solution, self.start * x, self.start * y)
        rigid = solution.approach_dimensionless.finest + 0.5 * self.curvature * self.start**2
        self.deflection = self.film - rigid  # on the edge of the box; it falls with 1/r

    def gap(self, r: Array) -> Array:
        """At distances of shape (n, m) [-]."""
        curvature, start = self.curvature[:, None], self.start[:, None]
        deflection = self.deflection[:, None] * start / r
        rigid = self.oil.solution.approach_dimensionless.finest + 0.5 * curvature * r**2
        excess = self.oil._excess(self.x[:, None] * r, self.y[:, None] * r)
        return np.asarray(rigid + deflection + excess)

    def meniscus(self) -> Array:
        """Distance at which the gap is as wide as the layer, or the smaller circle ends; that of
        the box's edge where it lies inside, shape (n,) [-].
        """
        low = self.start
        high = np.maximum(self.end, low)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            narrow = self.gap(middle[:, None])[:, 0] < self.oil.inlet_film_thickness
            low, high = np.where(narrow, middle, low), np.where(narrow, high, middle)
        return low


def _edge_distance(solution: ContactSolution, x: Array, y: Array) -> Array:
    """From the centre to the edge of the box in the directions (x, y) [-]."""
    X, Y = solution.X, solution.Y
    with np.errstate(divide="ignore"):
        along = np.where(x < 0.0, X[0] / x, X[-1] / x)
        across = np.where(y < 0.0, Y[0] / y, Y[-1] / np.abs(y))
    return np.asarray(np.minimum(along, across))


def _edge_film(solution: ContactSolution, x: Array, y: Array) -> Array:
    """Film on the edge of the box at places (x, y) of it, linear between its nodes [-]."""
    X, Y, H = solution.X, solution.Y, solution.H
    rows = np.where(x < 0.0, np.interp(y, Y, H[0]), np.interp(y, Y, H[-1]))
    columns = np.where(y < 0.0, np.interp(x, X, H[:, 0]), np.interp(x, X, H[:, -1]))
    off_row = np.minimum(np.abs(x - X[0]), np.abs(x - X[-1]))
    on_row = off_row < np.minimum(np.abs(y - Y[0]), np.abs(y - Y[-1]))
    return np.asarray(np.where(on_row, rows, columns))


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingMoment:
    """Moment of the pressure ahead of the centre, positive where it resists rolling along the
    entrainment.
    """

    value: float  # of the oil up to its meniscus [N m]
    # error by the mesh, the residual of the equations and the far field; not of the layer [N m]
    uncertainty: float
    box: float  # of the solved box alone [N m]
    layer: float  # of oil at the inlet, as wide as the gap at the meniscus [m]
    # distance of the meniscus ahead of the centre [m]; None where the oil ends on the edge of a
    # fixed box
    extent: float | None
    note: str = ""  # why the layer does not end the oil, or does not flood the contact


@lru_cache(maxsize=SOLUTIONS)
def rolling_moment(
    solution: ContactSolution, inlet_film_thickness: float | None = None
) -> RollingMoment:
    """Integrate the hydrodynamic rolling moment of the oil up to its meniscus, Kapitza (1955).

    His field holds far outside the ellipse, where the oil is isoviscous and the deflection small.
    In a box that was prescribed the oil ends on the edge, without pressure there.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    inlet_film_thickness : float | None, optional
        inlet film thickness, both surfaces together; None: that of the lubricant [m]

    Returns
    -------
    RollingMoment
        moment with its error bar; not a number where the film did not converge

    Raises
    ------
    ValueError
        if the conditions have no dimensions
    """
    conditions, a = _dimensions(solution)
    inlet_film_thickness = (
        conditions.lubricant.flooded_layer
        if inlet_film_thickness is None
        else inlet_film_thickness
    )
    if not inlet_film_thickness > 0.0:
        raise ValueError(f"layer must be positive, got {inlet_film_thickness!r}")
    scale = solution.hertz_pressure * a**3
    if not solution.converged:
        return _unknown(inlet_film_thickness, "the film did not converge")
    contact = scaled_as_solved(solution)
    moments = -trapezoidal_weights(solution.X, solution.Y) * solution.P * scale
    moments *= along_entrainment(contact, solution.X[:, None], solution.Y[None, :])
    box = float(moments.sum())
    if solution.supply is not None:
        return _with_inlet_film(solution, conditions, contact, box)
    change = 0.0 if solution.state else scale * pressure_moment(solution, contact)[1]
    box += change
    if solution.options.domain is not None:
        return RollingMoment(
            value=box,
            uncertainty=_solution_error(solution, contact, (box, change)),
            box=box,
            layer=inlet_film_thickness,
            extent=None,
            note="the box is fixed by [ehl] domain, the oil ends on its edge",
        )
    oil = MeniscusRegion(solution, contact, conditions.ball_radius, inlet_film_thickness)
    beyond = scale * oil.moment_beyond_box()
    value = box - float(np.sum(moments * oil.dry_moment_fraction())) + beyond
    left = _solution_error(solution, contact, (value, change))
    extent = oil.meniscus_ahead()
    return RollingMoment(
        value=value,
        uncertainty=left + FAR_FIELD_ERROR * abs(beyond),
        box=box,
        layer=inlet_film_thickness,
        extent=a * extent,
        note=_starved_note(solution, contact, extent),
    )


def _unknown(inlet_film_thickness: float, note: str) -> RollingMoment:
    return RollingMoment(
        value=nan, uncertainty=inf, box=nan, layer=inlet_film_thickness, extent=None, note=note
    )


def _with_inlet_film(
    solution: ContactSolution, conditions: ContactConditions, contact: ScaledContact, box: float
) -> RollingMoment:
    """Integrate the moment of a film that was solved behind a layer. Its pressure ends at its own
    meniscus, and beyond an open box that the layer floods where the gap is as wide as it.

    box: by the integral of the pressure [N m]. The value is that by the heat of its flow; the
    difference of both is in the error bar whole, with the share of the film's step that a flooded
    one has: the value was off by up to 1.2 of that difference, mostly by less than a half (five
    contacts, r of 0.2 to 2, on 129 and 257 points against 513), and by more where it changes its
    sign.
    """
    assert solution.supply is not None and conditions.inlet_layer is not None
    a = solution.semi_axis_x
    assert a is not None
    inlet_film_thickness = conditions.inlet_layer.central
    scale = solution.hertz_pressure * a**3
    if solution.supply.law is not None:
        return _by_law(solution, inlet_film_thickness, scale)
    change = scale * pressure_moment(solution, contact)[1]
    extent = solution.supply.meniscus
    beyond = 0.0
    note = ""
    if extent is None and solution.options.domain is None:
        oil = MeniscusRegion(solution, contact, conditions.ball_radius, inlet_film_thickness)
        beyond = scale * oil.moment_beyond_box()
        extent = -oil.meniscus_ahead()
    elif extent is None:
        note = "the layer at the inlet floods the box of the film, and the oil ends on its edge"
    value = box + change + beyond
    return RollingMoment(
        value=value,
        uncertainty=abs(change)
        + MESH_ERROR * _film_step(solution) * abs(value)
        + _cycle_error(solution, value)
        + FAR_FIELD_ERROR * abs(beyond),
        box=box + change,
        layer=inlet_film_thickness,
        extent=None if extent is None else -a * extent,
        note=note,
    )


def _by_law(solution: ContactSolution, inlet_film_thickness: float, scale: float) -> RollingMoment:
    """Reduce the moment in the box of the flooded film by the law of starvation. The error bar
    includes the law's, and the difference of the two ways to sum that moment.

    inlet_film_thickness: at the inlet [m]; scale: of moments, p_h a^3 [N m].
    """
    supply = solution.supply
    assert supply is not None and supply.law is not None
    fraction = supply.law.rolling_moment
    flooded = scale * sum(supply.flooded_moment)
    value = fraction.value * flooded
    of_film = scale * abs(supply.flooded_moment[1]) + _cycle_error(solution, flooded)
    return RollingMoment(
        value=value,
        uncertainty=hypot(fraction.value * of_film, fraction.uncertainty * flooded),
        box=value,
        layer=inlet_film_thickness,
        extent=None,
        note="the law of starvation knows no meniscus",
    )


def _dimensions(solution: ContactSolution) -> tuple[ContactConditions, float]:
    """Conditions of a solution and the semi-axis along x [m]."""
    conditions = solution.conditions
    a = solution.semi_axis_x
    if not isinstance(conditions, ContactConditions) or a is None:
        needed = "dimensional conditions, not Moes' groups alone"
        raise ValueError(f"solution: the rolling moment needs {needed}")
    return conditions, a


def scaled_as_solved(solution: ContactSolution) -> ScaledContact:
    """Scale the conditions of a solution in the frame of its grid.

    Parameters
    ----------
    solution : ContactSolution
        solved contact

    Returns
    -------
    ScaledContact
        scaled contact

    Raises
    ------
    ValueError
        if the frame is neither of the solver's two
    """
    for along in (False, True):
        contact = scale_contact(solution.conditions, along_entrainment=along)
        if abs(contact.frame_angle - solution.frame_angle) < SAME_ANGLE:
            return contact
    frame = f"the solution's frame at {solution.frame_angle:g} rad"
    raise ValueError(f"{frame} is none of the solver's")


def _solution_error(
    solution: ContactSolution, contact: ScaledContact, moment: tuple[float, float]
) -> float:
    """Estimate the error of a solution's moment by mesh and residual, of which the second is the
    change by the balance of power [N m].
    """
    value, change = moment
    cycles = _cycle_error(solution, value)
    if solution.state is None:
        return MESH_ERROR * (abs(change) + _film_step(solution) * abs(value)) + cycles
    conditions, a = _dimensions(solution)
    half_length = contact.half_extent_x
    centre = int(np.abs(solution.X).argmin())
    mesh = float(np.gradient(solution.X)[centre]) / half_length
    return LEVER_ERROR * mesh**1.5 * half_length * a * conditions.load + cycles


def _film_step(solution: ContactSolution) -> float:
    """Share of the step of the central film from the finest grid to its limit [-]."""
    film = solution.film_central_dimensionless
    return abs(film.value - film.finest) / abs(film.value)


def _cycle_error(solution: ContactSolution, moment: float) -> float:
    """Estimate the error of a moment by the cycles of a solution, in its unit."""
    residual = solution.record.residual[-1] if solution.record.residual else 0.0
    return RESIDUAL_ERROR * residual * abs(moment)


def _starved_note(solution: ContactSolution, contact: ScaledContact, extent: float) -> str:
    """Note on a layer that does not flood the contact, by its meniscus ahead of the centre [-]."""
    half_length = contact.half_extent_x
    factor, power = FLOODED_DISTANCE
    film = solution.film_central_dimensionless.value
    needed = 1.0 + factor * (film / (contact.curvature_x * half_length**2)) ** power
    if extent >= needed * half_length:
        return ""
    return (
        f"the layer ends {extent / half_length:.1f} half lengths of the contact ahead of its "
        f"centre, and its film is flooded from {needed:.1f} on (Hamrock and Dowson, 1977)"
    )


def kapitza_moment(
    conditions: ContactConditions,
    film: float,
    inlet_film_thickness: float | None = None,
    *,
    circles: bool = True,
) -> float:
    """Integrate the moment of Kapitza's pressure of rigid bodies ahead of the centre.

    The pressure is -K x/h^2 with K = 12 eta_0 u/(3 + 2 Rx/Ry), up to the meniscus.

    Parameters
    ----------
    conditions : ContactConditions
        contact with its lubricant
    film : float
        central film [m]
    inlet_film_thickness : float | None, optional
        inlet film thickness that bounds the oil; None: that of the lubricant [m]
    circles : bool, default True
        whether the gap is that of two circles; else of paraboloids

    Returns
    -------
    float
        moment; zero where the film is thicker than the inlet film [N m]
    """
    c = conditions
    inlet_film_thickness = (
        c.lubricant.flooded_layer if inlet_film_thickness is None else inlet_film_thickness
    )
    if film >= inlet_film_thickness:
        return 0.0
    ball = nan if c.ball_radius is None else 1.0 / c.ball_radius
    radii = (c.radius_x, c.radius_y)
    rays, steps = _nodes(RAYS), _nodes(NODES)
    integral = kapitza_integral(film, inlet_film_thickness, radii, ball, circles, rays, steps)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    return float(2.0 * strength / (3.0 + 2.0 * c.radius_x / c.radius_y) * integral)


def circles_moment_loss(
    conditions: ContactConditions,
    axes: tuple[float, float],
    film: float,
    inlet_film_thickness: float,
) -> float:
    """Integrate the moment that is lost as the bodies part faster than paraboloids do.

    The pressure is Kapitza's, -K x/h^2, outside Hertz' ellipse, the gap there that of elastic
    bodies over the film: rigid ones lose half as much where the load is high, as their gap opens
    from the centre on.

    Parameters
    ----------
    conditions : ContactConditions
        contact with its lubricant
    axes : tuple[float, float]
        semi-axes of Hertz' ellipse along and across the entrainment [m]
    film : float
        central film [m]
    inlet_film_thickness : float
        inlet film thickness that bounds the oil [m]

    Returns
    -------
    float
        moment [N m]
    """
    c = conditions
    if film >= inlet_film_thickness:
        return 0.0
    ball = nan if c.ball_radius is None else 1.0 / c.ball_radius
    nodes = _nodes(LOSS_NODES)
    reciprocal = (1.0 / c.radius_x, 1.0 / c.radius_y)
    lost = circles_loss(film, inlet_film_thickness, reciprocal, ball, axes, nodes, nodes)
    strength = 12.0 * c.lubricant.viscosity * c.entrainment_speed
    return float(2.0 * LOSS * strength / (3.0 + 2.0 * c.radius_x / c.radius_y) * lost)


@cache
def _nodes(count: int) -> Array:
    """Gauss and Legendre's places and weights on [-1, 1], shape (2, count) [-]."""
    return np.stack(np.polynomial.legendre.leggauss(count))
