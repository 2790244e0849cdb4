"""How the surface of a finite body moves under a contact, less that of a half-space.

The difference is smooth: a constant, which belongs to the approach of the bodies, a tilt across
the track, two curvatures, which change the reduced radii, and a rest.
"""

from dataclasses import dataclass

import numpy as np

from ...arrays import Array

CELLS = (16, 40)  # of the ellipse along and across; 32 by 80 change the curvatures by below 2 %

HIGHEST = (
    6  # power of y, in addition to x^2; 4 and 8 change the curvature along the track by 1e-4 of it
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactPatch:
    """Ellipse with Hertz' pressure, x along the track."""

    load: float  # [N]
    semi_axis_x: float  # a [m]
    semi_axis_y: float  # b [m]

    def cells(self) -> tuple[Array, Array, Array, tuple[float, float]]:
        """Middles x, y [m] of even cells in the ellipse, their loads [N], shape (n,), and the
        sides of a cell [m].
        """
        t, s = (2.0 * (np.arange(n) + 0.5) / n - 1.0 for n in CELLS)
        x, y = (grid.ravel() for grid in np.meshgrid(t, s, indexing="ij"))
        inside = x * x + y * y < 1.0
        x, y = x[inside], y[inside]
        pressure = np.sqrt(1.0 - x * x - y * y)
        sides = (2.0 * self.semi_axis_x / CELLS[0], 2.0 * self.semi_axis_y / CELLS[1])
        loads = self.load * pressure / pressure.sum()
        return self.semi_axis_x * x, self.semi_axis_y * y, loads, sides


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceDifference:
    """Displacement into the body over the ellipse less that of a half-space: positive is softer.

    constant + tilt y + curvature_x x^2/2 + curvature_y y^2/2 + rest, by least squares weighted
    with the pressure.
    """

    constant: float  # [m]
    tilt: float  # [-]
    curvature_x: float  # [1/m]
    curvature_y: float  # [1/m]
    rest: float  # root mean square of the rest, weighted with the pressure [m]
    unknowns: int = 0  # of the finite elements, of the body [-]
    iterations: int = 0  # [-]
    residual: float = 0.0  # relative, of the linear systems [-]

    def with_body(self, other: "SurfaceDifference") -> "SurfaceDifference":
        """The sum for two bodies in contact.

        Parameters
        ----------
        other : SurfaceDifference
            difference of the other body

        Returns
        -------
        SurfaceDifference
            the sum
        """
        return SurfaceDifference(
            constant=self.constant + other.constant,
            tilt=self.tilt + other.tilt,
            curvature_x=self.curvature_x + other.curvature_x,
            curvature_y=self.curvature_y + other.curvature_y,
            rest=self.rest + other.rest,
            unknowns=self.unknowns + other.unknowns,
            iterations=max(self.iterations, other.iterations),
            residual=max(self.residual, other.residual),
        )


def fitted(
    patch: ContactPatch, points: tuple[Array, Array], loads: Array, difference: Array
) -> SurfaceDifference:
    """Constant, tilt and curvatures of a difference of displacements over the ellipse.

    Parameters
    ----------
    patch : ContactPatch
        ellipse of the contact
    points : tuple[Array, Array]
        x and y, shape (n,) each [m]
    loads : Array
        at the points, shape (n,) [N]
    difference : Array
        at the points, shape (n,) [m]

    Returns
    -------
    SurfaceDifference
        the fit, weighted with the loads
    """
    x, y = points[0] / patch.semi_axis_x, points[1] / patch.semi_axis_y
    root = np.sqrt(loads / loads.sum())
    # x^2 together with powers of y, else those of y beyond the second would be fitted by it
    powers = np.stack([*(y**n for n in range(HIGHEST + 1)), 0.5 * x * x], axis=1)
    along = np.linalg.lstsq(root[:, None] * powers, root * difference, rcond=None)[0][-1]
    modes = np.stack([np.ones_like(x), y, 0.5 * y * y], axis=1)
    across = difference - along * 0.5 * x * x
    fit = np.linalg.lstsq(root[:, None] * modes, root * across, rcond=None)[0]
    rest = across - modes @ fit
    return SurfaceDifference(
        constant=float(fit[0]),
        tilt=float(fit[1] / patch.semi_axis_y),
        curvature_x=float(along / patch.semi_axis_x**2),
        curvature_y=float(fit[2] / patch.semi_axis_y**2),
        rest=float(np.sqrt(((root * rest) ** 2).sum())),
    )


def groove_gap(ball_radius: float, groove_radius: float, patch: ContactPatch) -> SurfaceDifference:
    """Gap between ball and groove, arcs in section, less that of parabolas y^2/(2 R_y) in arc
    length y.

    Along the normal of the middle at equal distances R sin(y/R) from it, R the radius between both
    arcs, 2/R = 1/ball + 1/groove: larger by 5 y^2/(12 R^2) of itself.

    Parameters
    ----------
    ball_radius : float
        [m]
    groove_radius : float
        [m]
    patch : ContactPatch
        ellipse of the contact

    Returns
    -------
    SurfaceDifference
        the difference as displacement
    """
    x, y, loads, _ = patch.cells()
    middle = 2.0 * ball_radius * groove_radius / (ball_radius + groove_radius)
    across = middle * np.sin(y / middle)
    ball, groove = (r - np.sqrt(r * r - across * across) for r in (ball_radius, groove_radius))
    parabola = 0.5 * y * y * (1.0 / ball_radius - 1.0 / groove_radius)
    return fitted(patch, (x, y), loads, ball - groove - parabola)
