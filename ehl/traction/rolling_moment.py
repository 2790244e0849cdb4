r"""Hydrodynamic rolling moment of the oil that a contact has, up to its meniscus.

Far from a flooded contact the pressure is :math:`s(\theta) r/H^2`, near Kapitza's (1955)
:math:`-k_x x/H^2` ahead of the contact and zero where oil breaks behind it
(`ehl.multigrid.far_field`), so that the moment :math:`-\iint x p` of the oil between two distances
from the centre of a paraboloid gap is, by Kapitza's,

.. math:: \frac{24 \pi\,\eta_0 u R_x^2}{(3 + 2 R_x/R_y)\sqrt{R_x/R_y}}\,\ln\frac{r_2}{r_1},

whatever the load: it grows with the logarithm of the oil's extent, half of that of the layer's.
The extent is the oil's, not the solver's box. On each ray from the centre oil counts up to the
meniscus, where the gap is as wide as the layer that the bodies carry in
(`Lubricant.flooded_layer`): in the box the solved pressure, beyond its edge that of the far field,
which the solver has set on that edge (1.4 % more than Kapitza's moment for a sphere, 3.5 % for
:math:`R_x/R_y = 1/45`). Farther out than 0.2 of the smaller radius of a ray's section the gap
is that of two circles (`oil_extent`); the pressure goes with its square there.

What that leaves out. The film is solved without a meniscus: at one, where the pressure vanishes,
mass conservation asks for a layer of 0.3675 of the gap under a sphere, and the moment is that of
Kapitza's pressure up to a gap of 1.446 layers: 0.18 of the moment above per unit of logarithm more
(`tests/ehl/traction/test_meniscus.py`), more yet in wide ellipses. And the pressure over the
square of the gap of circles is, up to 0.3 of the radius, 1.2 % above that of Reynolds' equation.
"""

from dataclasses import dataclass
from math import hypot

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ..multigrid.far_field import FarField, far_field
from ..multigrid.supply.oil_supply import pressure_moment
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution
from .oil_extent import HALVINGS, PARABOLA_SHARE, ray_curvature, sections
from .shear import trapezoidal_weights

DIRECTIONS = 720  # rays from the centre
RAY_NODES = 24  # of Gauss and Legendre on each, in the logarithm of the distance
SAME_ANGLE = 1e-9  # [rad]
SMALLEST_DISTANCE = 1e-12  # from the centre over a [-]: a direction at the centre itself
# Error of the lever arm of the load over the contact's half length, times (mesh/half length)^-1.5
# [-]: 0.02 to 0.34 in the sixteen contacts of `benchmarks/uncertainty.py` on 65 to 513 points,
# whose moments approach their limit with an order of 1.45 (median)
MESH_ERROR = 0.4
# Relative error of the moment over the residual [-]: below 1 in most, some 10 at most in 30
# contacts on 129 points and six on 257 and 513, cycled on until the residual had vanished
RESIDUAL_ERROR = 10.0
# Relative error of the moment beyond the box [-]: solved in a box five times as long it changes by
# at most 0.19 of it (five contacts, boxes from 3 semi-axes on)
FAR_FIELD_ERROR = 0.2
# Hamrock and Dowson (1977, part IV): distance of the meniscus over the half length, below which
# the film starves, 1 + 3.06 [(R/b)^2 h/R]^0.58
FLOODED_DISTANCE = (3.06, 0.58)


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingMoment:
    """Moment of the pressure ahead of the centre about y, positive where it resists rolling along
    x.
    """

    value: float  # of the oil up to its meniscus [N m]
    # of the mesh, of the equations left unsolved and of the far field; not of the layer [N m]
    uncertainty: float
    box: float  # of the solved box alone [N m]
    layer: float  # of oil at the inlet, as wide as the gap at the meniscus [m]
    # of the meniscus ahead of the centre [m]; None where the oil ends on the edge of a fixed box
    extent: float | None
    note: str = ""  # why the layer does not end the oil, or does not flood the contact


def rolling_moment(solution: ContactSolution, layer: float | None = None) -> RollingMoment:
    """Hydrodynamic rolling moment of the oil up to its meniscus.

    Kapitza (1955); his field holds far outside the ellipse, where the oil is isoviscous and the
    deflection small. In a box that was fixed the oil ends on the edge, without pressure there.
    layer: at the inlet, both surfaces together [m]; None: that of the lubricant. ValueError where
    conditions have no dimensions.
    """
    conditions, a = _dimensions(solution)
    layer = conditions.lubricant.flooded_layer if layer is None else layer
    if not layer > 0.0:
        raise ValueError(f"layer must be positive, got {layer!r}")
    scale = solution.hertz_pressure * a**3
    moments = (
        -trapezoidal_weights(solution.X, solution.Y) * solution.X[:, None] * solution.P * scale
    )
    box = float(moments.sum())
    contact = scaled_as_solved(solution)
    if solution.supply is not None:
        return _behind_layer(solution, conditions, contact, box)
    if solution.options.domain is not None:
        return RollingMoment(
            value=box,
            uncertainty=_solution_error(solution, contact, box),
            box=box,
            layer=layer,
            extent=None,
            note="the box is fixed by [ehl] domain, the oil ends on its edge",
        )
    oil = _Oil(solution, contact, conditions.ball_radius, layer)
    beyond = scale * oil.moment_beyond_box()
    value = box - float(np.sum(moments * oil.share_without())) + beyond
    extent = oil.meniscus_ahead()
    return RollingMoment(
        value=value,
        uncertainty=_solution_error(solution, contact, value) + FAR_FIELD_ERROR * abs(beyond),
        box=box,
        layer=layer,
        extent=a * extent,
        note=_starved_note(solution, contact, extent),
    )


def _behind_layer(
    solution: ContactSolution, conditions: ContactConditions, contact: ScaledContact, box: float
) -> RollingMoment:
    """Of a film that was solved behind a layer: its pressure ends at its own meniscus, and beyond
    an open box that the layer floods where the gap is as wide as it.

    box: by the integral of the pressure [N m]. The value is that by the heat of its flow; the
    difference of both is the error bar: the value was off by up to 1.2 of it, mostly by less than
    a half (five contacts, r of 0.2 to 2, on 129 and 257 points against 513).
    """
    assert solution.supply is not None and conditions.inlet_layer is not None
    a = solution.semi_axis_x
    assert a is not None
    layer = conditions.inlet_layer.central
    scale = solution.hertz_pressure * a**3
    if solution.supply.law is not None:
        return _by_law(solution, layer, scale)
    change = scale * pressure_moment(solution, contact)[1]
    extent = solution.supply.meniscus
    beyond = 0.0
    note = ""
    if extent is None and solution.options.domain is None:
        oil = _Oil(solution, contact, conditions.ball_radius, layer)
        beyond = scale * oil.moment_beyond_box()
        extent = -oil.meniscus_ahead()
    elif extent is None:
        note = "the layer at the inlet floods the box of the film, and the oil ends on its edge"
    value = box + change + beyond
    return RollingMoment(
        value=value,
        uncertainty=abs(change) + _left_by_cycles(solution, value) + FAR_FIELD_ERROR * abs(beyond),
        box=box + change,
        layer=layer,
        extent=None if extent is None else -a * extent,
        note=note,
    )


def _by_law(solution: ContactSolution, layer: float, scale: float) -> RollingMoment:
    """What the law of starvation leaves of the moment in the box of the flooded film; its error
    bar holds the law's, and the difference of the two ways to sum that moment.

    layer: at the inlet [m]; scale: of moments, p_h a^3 [N m].
    """
    supply = solution.supply
    assert supply is not None and supply.law is not None
    share = supply.law.rolling_moment
    flooded = scale * sum(supply.flooded_moment)
    value = share.value * flooded
    of_film = scale * abs(supply.flooded_moment[1]) + _left_by_cycles(solution, flooded)
    return RollingMoment(
        value=value,
        uncertainty=hypot(share.value * of_film, share.uncertainty * flooded),
        box=value,
        layer=layer,
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
    """The dimensionless contact in the frame of the solution's grid [-]; ValueError where that is
    neither of the solver's two.
    """
    for along in (False, True):
        contact = scale_contact(solution.conditions, along_entrainment=along)
        if abs(contact.frame_angle - solution.frame_angle) < SAME_ANGLE:
            return contact
    frame = f"the solution's frame at {solution.frame_angle:g} rad"
    raise ValueError(f"{frame} is none of the solver's")


def _solution_error(solution: ContactSolution, contact: ScaledContact, moment: float) -> float:
    """What mesh and residual of a solution leave open of its moment [N m]."""
    conditions, a = _dimensions(solution)
    half_length = contact.half_extent_x
    centre = int(np.abs(solution.X).argmin())
    mesh = float(np.gradient(solution.X)[centre]) / half_length
    lever = MESH_ERROR * mesh**1.5 * half_length * a
    return lever * conditions.load + _left_by_cycles(solution, moment)


def _left_by_cycles(solution: ContactSolution, moment: float) -> float:
    """What the cycles of a solution leave open of a moment, in its unit."""
    residual = solution.record.residual[-1] if solution.record.residual else 0.0
    return RESIDUAL_ERROR * residual * abs(moment)


def _starved_note(solution: ContactSolution, contact: ScaledContact, extent: float) -> str:
    """That a layer does not flood the contact, by its meniscus ahead of the centre [-]."""
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


class _Oil:
    """The oil around a contact, up to a layer [m]; lengths over a, films over a^2/Rx."""

    def __init__(
        self,
        solution: ContactSolution,
        contact: ScaledContact,
        ball_radius: float | None,
        layer: float,
    ) -> None:
        assert contact.film_scale is not None and contact.semi_axis_x is not None
        self.solution = solution
        self.contact = contact
        self.ball_radius = ball_radius
        self.layer = layer / contact.film_scale
        self.height_scale = contact.semi_axis_x / contact.film_scale
        self.field: FarField = far_field(contact)

    def share_without(self) -> Array:
        """Share of each node's moment that there is no oil for, shape (nx, ny) [-]: beyond the
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
        filled = np.clip(0.5 + (self.layer - gap) / rise[outside], 0.0, 1.0)
        without = np.zeros_like(solution.P)
        without[outside] = 1.0 - filled * (film / gap) ** 2
        return without

    def moment_beyond_box(self) -> float:
        """Integral of -X P of the far field from the edge of the box to the meniscus [-]."""
        angle = (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS
        every = _Ray(self, np.cos(angle), np.sin(angle))
        wet = every.film < self.layer  # the meniscus of the others is in the box
        ray = _Ray(self, every.x[wet], every.y[wet])
        span = np.log(ray.meniscus() / ray.start)[:, None]
        places, weights = np.polynomial.legendre.leggauss(RAY_NODES)
        r = ray.start[:, None] * np.exp(0.5 * span * (places + 1.0))
        gap = np.maximum(ray.gap(r), ray.film[:, None])  # it opens outwards
        x, y = ray.x[:, None], ray.y[:, None]
        pressure = self.field.strength(x * r, y * r) / gap**2
        rings = np.sum(0.5 * span * weights * pressure * x * r**3, axis=1)
        return float(-rings.sum()) * 2.0 * np.pi / DIRECTIONS + 0.0

    def meniscus_ahead(self) -> float:
        """Distance of the meniscus from the centre, against the grid's x [-]."""
        ray = _Ray(self, np.array([-1.0]), np.array([0.0]))
        if ray.film[0] < self.layer:
            return float(ray.meniscus()[0])
        X = self.solution.X
        ahead = X <= 0.0
        r = -X[ahead][::-1]
        middle = int(np.abs(self.solution.Y).argmin())
        gap = self.solution.H[ahead, middle][::-1] + self._excess(-r, np.zeros_like(r))
        narrow = np.flatnonzero(gap < self.layer)
        last = int(narrow[-1]) if narrow.size else 0
        return float(np.interp(self.layer, gap[last : last + 2], r[last : last + 2]))

    def _excess(self, x: Array, y: Array) -> Array:
        """Of the gap of circles over that of parabolas at places outside the contact, less that
        at the edge of the ellipse beside them, where the bodies conform; endless where the smaller
        circle ends.
        """
        excess, reach = self._rigid_excess(x, y)
        edge, _ = self._rigid_excess(*self._edge_beside(x, y))
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

    def _edge_beside(self, x: Array, y: Array) -> tuple[Array, Array]:
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


class _Ray:
    """Rays from the centre beyond the edge of the box, in directions (x, y), shape (n,)."""

    def __init__(self, oil: _Oil, x: Array, y: Array) -> None:
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
            narrow = self.gap(middle[:, None])[:, 0] < self.oil.layer
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
