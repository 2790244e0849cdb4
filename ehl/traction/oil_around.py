"""The oil around a solved contact: its gap beyond the box, along rays up to the meniscus."""

from collections.abc import Callable

import numpy as np

from ..arrays import Array
from ..multigrid.far_field import FarField, far_field
from ..scaling import ScaledContact
from ..solution import ContactSolution
from .oil_extent import HALVINGS, PARABOLA_SHARE, ray_curvature, sections

DIRECTIONS = 720  # rays from the centre
RAY_NODES = 24  # of Gauss and Legendre on each, in the logarithm of the distance
SMALLEST_DISTANCE = 1e-12  # from the centre over a [-]: a direction at the centre itself


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
