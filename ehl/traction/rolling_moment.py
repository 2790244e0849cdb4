r"""Hydrodynamic rolling moment of a contact's oil, in the solver's box and out to a stated
distance.

Far from a flooded contact Kapitza's (1955) pressure is :math:`-k_x x/H^2` with H a paraboloid
(`ehl.multigrid.far_field`), so that the moment :math:`-\iint x p` of the oil between two distances
from the centre is

.. math:: \frac{24 \pi\,\eta_0 u R_x^2}{(3 + 2 R_x/R_y)\sqrt{R_x/R_y}}\,\ln\frac{r_2}{r_1},

whatever the load: it grows with the logarithm of the box, and has no limit on an infinite
paraboloid. What ends it is the shape of the bodies. Here the oil counts up to a distance from the
contact's centre (`SHARE_OF_RADIUS` of the smaller reduced radius, an assumption): in the box the
solved pressure, from the box's edge on Kapitza's, which the solver has set on that edge.

With rupture where pressure and its slope vanish the far field is :math:`r^{-3} f(\theta)`,
:math:`(q^3 f')' - 9 q^3 f = 8\lambda S\cos\theta` for the gap :math:`q(\theta) r^2/2`; the moment
of Kapitza's positive half is below that by 1.4 % of the part outside for a sphere and 3.5 % for
:math:`R_x/R_y = 1/45` (`tests/ehl/traction/test_rolling_moment.py`).
"""

from dataclasses import dataclass
from math import log

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ..multigrid.far_field import FarField, far_field
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution
from .shear import trapezoidal_weights

# assumed; there the gap under a sphere is 8 (1 - sqrt(3)/2) = 1.07 of the parabola
SHARE_OF_RADIUS = 0.5
DIRECTIONS = 720  # rays from the centre
RAY_NODES = 24  # of Gauss and Legendre on each, in the logarithm of the distance
SAME_ANGLE = 1e-9  # [rad]
SMALLEST = 1e-12  # keeps the node at the centre finite


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingMoment:
    """Moment of the pressure ahead of the centre about y, positive where it resists rolling along
    x.
    """

    box: float  # of the solved box, minus `TractionResult.hydrodynamic_moment` [N m]
    # of Kapitza's pressure from the edge of the box out to the extent [N m]
    beyond_box: float | None = None
    beyond_extent: float | None = None  # part of `box` farther out than the extent [N m]
    extent: float  # distance from the contact's centre up to which oil counts [m]
    note: str = ""  # why there is only that of the box

    @property
    def within_extent(self) -> float | None:
        """Moment of all oil up to the extent, in the box and beyond it [N m]."""
        if self.beyond_box is None or self.beyond_extent is None:
            return None
        return self.box - self.beyond_extent + self.beyond_box


def rolling_moment(solution: ContactSolution, extent: float | None = None) -> RollingMoment:
    """Hydrodynamic rolling moment in the box, beyond it, and within a distance from the centre.

    Kapitza (1955); his field holds far outside the ellipse, where the oil is isoviscous and the
    deflection small. Only the moment of the box is given, with a note, where the box was fixed
    (its edge has no pressure: the oil ends there) or the ellipse reaches beyond the extent.
    extent: distance up to which oil counts [m]; None: `SHARE_OF_RADIUS` of the smaller reduced
    radius. ValueError where conditions have no dimensions.
    """
    conditions, a = _dimensions(solution)
    if extent is None:
        extent = SHARE_OF_RADIUS * min(conditions.radius_x, conditions.radius_y)
    if not extent > 0.0:
        raise ValueError(f"extent must be positive, got {extent!r}")
    scale = solution.hertz_pressure * a**3
    reach = extent / a
    moments = (
        -trapezoidal_weights(solution.X, solution.Y) * solution.X[:, None] * solution.P * scale
    )
    box = float(moments.sum())
    note = ""
    if solution.options.domain is not None:
        note = "the box is fixed by [ehl] domain, the oil ends on its edge"
    elif reach < max(1.0, solution.semi_axis_ratio):
        note = "the contact ellipse reaches beyond the extent of the oil"
    if note:
        return RollingMoment(box=box, extent=extent, note=note)
    return RollingMoment(
        box=box,
        beyond_box=scale * _kapitza_moment(solution, reach),
        beyond_extent=float(np.sum(moments * _share_outside(solution, reach))),
        extent=extent,
    )


def moment_of_doubling(solution: ContactSolution) -> float:
    """What oil up to twice the distance adds to the rolling moment far from the contact [N m],
    positive where it resists rolling: Kapitza (1955), integrated over rings, without the rotation
    of the entrainment.
    """
    _, a = _dimensions(solution)
    field = far_field(scaled_as_solved(solution))
    angle = np.arange(DIRECTIONS) * 2.0 * np.pi / DIRECTIONS
    x, y = np.cos(angle), np.sin(angle)
    # the field is odd: half of all is its positive half
    half = 0.5 * (field.pressure_x * x + field.pressure_y * y) * x
    rings = float(np.sum(half / (0.5 * _curvature(field, x, y)) ** 2))
    per_factor = rings * 2.0 * np.pi / DIRECTIONS
    return per_factor * log(2.0) * solution.hertz_pressure * a**3


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


def _share_outside(solution: ContactSolution, reach: float) -> Array:
    """Share of each node's cell, its border straight, beyond `reach`; shape (nx, ny) [-]."""
    X = solution.X[:, None]
    Y = solution.Y[None, :]
    distance = np.hypot(X, Y)
    spread = np.abs(X) * np.gradient(solution.X)[:, None] + np.abs(Y) * np.gradient(solution.Y)
    width = np.maximum(spread, SMALLEST) / np.maximum(distance, SMALLEST)
    return np.asarray(np.clip(0.5 + (distance - reach) / width, 0.0, 1.0))


def _kapitza_moment(solution: ContactSolution, reach: float) -> float:
    """Integral of -X P of the far field from the edge of the box to a distance [-].

    The gap along a ray is H_0 + q r^2/2 and what is left of the deflection at the box's edge,
    which falls with 1/r.
    """
    contact = scaled_as_solved(solution)
    field = far_field(contact)
    angle = (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS
    x, y = np.cos(angle), np.sin(angle)
    start = _edge_distance(solution, x, y)
    span = np.log(np.maximum(reach / start, 1.0))[:, None]
    places, weights = np.polynomial.legendre.leggauss(RAY_NODES)
    r = start[:, None] * np.exp(0.5 * span * (places + 1.0))
    q = _curvature(field, x, y)
    film = _edge_film(solution, start * x, start * y)
    approach = solution.approach_dimensionless
    deflection = film - approach - 0.5 * q * start**2
    gap = approach + 0.5 * q[:, None] * r**2 + (deflection * start)[:, None] / r
    gap = np.maximum(gap, film[:, None])  # it opens outwards
    pressure = field.strength(x[:, None] * r, y[:, None] * r) / gap**2
    rings = np.sum(0.5 * span * weights * pressure * x[:, None] * r**3, axis=1)
    return float(-rings.sum()) * 2.0 * np.pi / DIRECTIONS + 0.0


def _curvature(field: FarField, x: Array, y: Array) -> Array:
    """Of the gap in the directions (x, y) [-]."""
    return field.curvature_x * x**2 + field.curvature_y * y**2 + 2.0 * field.curvature_xy * x * y


def _edge_distance(solution: ContactSolution, x: Array, y: Array) -> Array:
    """From the centre to the edge of the box in the directions (x, y) [-]."""
    X, Y = solution.X, solution.Y
    along = np.where(x < 0.0, X[0] / x, X[-1] / x)
    return np.asarray(np.minimum(along, np.where(y < 0.0, Y[0] / y, Y[-1] / y)))


def _edge_film(solution: ContactSolution, x: Array, y: Array) -> Array:
    """Film on the edge of the box at places (x, y) of it, linear between its nodes [-]."""
    X, Y, H = solution.X, solution.Y, solution.H
    rows = np.where(x < 0.0, np.interp(y, Y, H[0]), np.interp(y, Y, H[-1]))
    columns = np.where(y < 0.0, np.interp(x, X, H[:, 0]), np.interp(x, X, H[:, -1]))
    off_row = np.minimum(np.abs(x - X[0]), np.abs(x - X[-1]))
    on_row = off_row < np.minimum(np.abs(y - Y[0]), np.abs(y - Y[-1]))
    return np.asarray(np.where(on_row, rows, columns))
