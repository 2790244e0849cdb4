"""The part of a contact that pictures show, in its frame and in the units of its fields."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, degrees, hypot, inf, pi, sin
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from oilfilm.ehl import ContactSolution
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.solution import OilSupply
from oilfilm.ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, from_si, unit_of

# suffix of the unit in which a variable is shown, by its name and its unit in the file
SHOWN_UNITS = {("x", "m"): "mm", ("h", "m"): "um", ("P", "Pa"): "GPa", ("T", "K"): "C"}
ALL = (slice(None), slice(None))  # of the nodes of a grid
ROUND_OFF = 1e-6  # of the window: a box that ends so near does not cut it [-]
# ends of the part shown, in Hertz semi-axes along and across the entrainment; chosen by eye
SHOWN_INLET = -2.5
SHOWN_OUTLET = 1.5
SHOWN_SIDE = 1.35
STRETCHED = 2.0  # ellipses longer than this are drawn with stretched axes
# share of the largest pressure [-]: the shown part reaches beyond where the pressure is smaller
QUIET_PRESSURE = 0.1
# share of the central film [-]: a contact with a minimum nearer to it has no horseshoe
FLAT_FILM = 0.03


def film_range(central: float, minimum: float) -> tuple[float, float]:
    """Ends of a film's colour scale in the unit of the films, as [um]; the inlet is beyond.

    Chosen by eye, so that plateau and horseshoe of most contacts take most of the colours.

    Parameters
    ----------
    central : float
        Central film in the unit of the map.
    minimum : float
        Minimum film, in that unit.

    Returns
    -------
    tuple[float, float]
        Lower and upper end.
    """
    spread = central - minimum
    if not central > 0.0:  # a failed solution
        return 0.0, 1.0
    if spread < FLAT_FILM * central:
        return minimum, 1.6 * central
    return minimum, min(central + 2.5 * spread, 2.0 * central)


def common_film_range(central: Sequence[float], minimum: Sequence[float]) -> tuple[float, float]:
    """Ends of the logarithmic scale that many contacts share, in the unit of films, as [um].

    Parameters
    ----------
    central : Sequence[float]
        Central films, all in one unit.
    minimum : Sequence[float]
        Minimum films, in that unit.

    Returns
    -------
    tuple[float, float]
        Lower and upper end.
    """
    low = min((h for h in minimum if h > 0.0), default=0.5)
    high = max((h for h in central if h > 0.0), default=1.0)
    return low, max(1.3 * high, 1.1 * low)


def shown(name: str, unit: str, values: Any) -> tuple[Any, str]:
    """Values of a variable in the unit in which it is shown.

    Parameters
    ----------
    name : str
        Name of the variable, "x" for y as well.
    unit : str
        Unit in the file.
    values : Any
        Values in that unit.

    Returns
    -------
    value
        Values in the unit in which they are shown.
    value
        That unit.
    """
    suffix = SHOWN_UNITS.get((name, unit))
    key = f"{name}_{suffix}"
    return (values, unit) if suffix is None else (from_si(key, values), unit_of(key))


def shown_scales(solution: ContactSolution) -> tuple[float, float, float]:
    """Scales of lengths, films and pressures; 1 where the solution has none.

    Parameters
    ----------
    solution : ContactSolution
        Solved film of the contact.

    Returns
    -------
    value
        Length scale [mm].
    value
        Film scale [um].
    value
        Pressure scale [GPa].
    """
    a = solution.semi_axis_x
    h = solution.film_scale
    length = 1.0 if a is None else a / MILLIMETRE
    film = 1.0 if h is None else h / MICROMETRE
    pressure = solution.hertz_pressure / GIGAPASCAL if solution.hertz_pressure > 0.0 else 1.0
    return length, film, pressure


def principal_coordinates(x: Array, y: Array, angle: float) -> tuple[Array, Array]:
    """Principal coordinates of nodes along and across the entrainment.

    Parameters
    ----------
    x : Array
        Nodes along the entrainment, shape (nx,) [m].
    y : Array
        Nodes across it, shape (ny,) [m].
    angle : float
        Angle of the entrainment from the principal direction x towards y [rad].

    Returns
    -------
    value
        x, shape (nx, ny) [m].
    value
        y, shape (nx, ny) [m].
    """
    along, across = np.meshgrid(x, y, indexing="ij")
    c, s = np.cos(angle), np.sin(angle)
    return c * along - s * across, s * along + c * across


def within(values: Array, low: float, high: float) -> slice:
    """Index range of the values that lie in [low, high].

    Parameters
    ----------
    values : Array
        Ascending values [any unit].
    low : float
        Lower end, in that unit.
    high : float
        Upper end, in that unit.

    Returns
    -------
    slice
        The range.
    """
    return slice(
        int(np.searchsorted(values, low, "left")), int(np.searchsorted(values, high, "right"))
    )


def resampled(
    x: Array, y: Array, values: Array, new_x: Array, new_y: Array, outside: float | None = None
) -> Array:
    """Values at other nodes, linear in both directions.

    Parameters
    ----------
    x : Array
        Nodes, shape (nx,), which need not be even [any unit].
    y : Array
        Nodes, shape (ny,).
    values : Array
        Field at the nodes, shape (nx, ny).
    new_x : Array
        Other nodes, shape (n,).
    new_y : Array
        Other nodes, shape (m,).
    outside : float | None, optional
        Value beyond the ends; those at the ends if None.

    Returns
    -------
    Array
        Values, shape (n, m).
    """

    def along(new: Array, old: Array, lines: Array) -> Array:
        return np.array([np.interp(new, old, line, outside, outside) for line in lines])

    return along(new_y, y, along(new_x, x, values.T).T)


def refined(x: Array, y: Array, field: Array, least: int) -> tuple[Array, Array, Array]:
    """Positions and values between the nodes of a field, at equal steps.

    Cubic, with a continuous slope and without new extremes (Fritsch and Carlson, SIAM J. Numer.
    Anal. 17, 1980), so that a coarse mesh shows no kinks; linear where values are not finite.

    Parameters
    ----------
    x : Array
        Nodes, shape (nx,) [any unit].
    y : Array
        Nodes, shape (ny,).
    field : Array
        Values, shape (nx, ny).
    least : int
        Nodes each way, at least [-].

    Returns
    -------
    value
        Positions along, shape (n,).
    value
        Positions across, shape (m,).
    value
        Values, shape (n, m).
    """
    fine_x = np.linspace(x[0], x[-1], max(least, len(x)))
    fine_y = np.linspace(y[0], y[-1], max(least, len(y)))
    if min(field.shape) < 2 or not np.isfinite(field).all():
        return fine_x, fine_y, resampled(x, y, field, fine_x, fine_y)
    along = PchipInterpolator(x, field, axis=0)(fine_x)
    return fine_x, fine_y, PchipInterpolator(y, along, axis=1)(fine_y)


def around(values: Array, low: float, high: float) -> slice:
    """Index range of the values that cover [low, high]: one more than `within` at each end.

    Parameters
    ----------
    values : Array
        Ascending values [any unit].
    low : float
        Lower end, in that unit.
    high : float
        Upper end, in that unit.

    Returns
    -------
    slice
        The range.
    """
    inner = within(values, low, high)
    return slice(max(inner.start - 1, 0), min(inner.stop + 1, len(values)))


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactView:
    """The shown part of one contact, in the units of the plots."""

    x: Array  # along the entrainment, shape (nx,) [mm], or in semi-axes a in Moes input
    y: Array  # across the entrainment, shape (ny,), likewise
    film: Array  # shape (nx, ny) [um], or in units of a^2/Rx
    pressure: Array  # shape (nx, ny) [GPa], or in units of p_h
    hertz: float  # largest Hertz pressure, in the unit of `pressure`
    reach_x: float  # where the Hertz pressure vanishes along y = 0, in the unit of x
    reach_y: float  # and along x = 0
    ellipse: Array  # outline of the Hertz ellipse, shape (2, n), in the unit of x and y
    half_x: float  # half extents of the Hertz ellipse, in the unit of x and y
    half_y: float
    central: float  # extrapolated films, in the unit of `film`
    central_uncertainty: float
    minimum: float
    minimum_uncertainty: float
    length_unit: str
    film_unit: str
    pressure_unit: str
    box: tuple[float, float, float, float]  # first and last x, first and last y, in the unit of x
    window: tuple[float, float, float, float]  # the part to show, likewise; may leave the box
    doubt: str  # "not converged" or "not resolved"; empty for a sound solution
    oblique: float = 0.0  # angle of the entrainment to the axis x, towards y [deg]
    filled: Array | None = None  # shape (nx, ny), share of the gap [-]; None: flooded
    # shape (ny,), oil that leaves the box on both surfaces, at ambient density; in film_unit
    outlet: Array | None = None

    @property
    def names(self) -> tuple[str, str]:
        """Names of the axes: rolling and transverse direction, or plain principal directions."""
        if self.oblique:
            return "principal direction $x$", "principal direction $y$"
        return "rolling direction $x$", "transverse $y$"

    @property
    def shown(self) -> tuple[float, float, float, float]:
        """Window as far as the box reaches: first and last x, first and last y, unit of `x`."""
        x_in, x_out, y_first, y_last = self.window
        box = self.box
        return max(x_in, box[0]), min(x_out, box[1]), max(y_first, box[2]), min(y_last, box[3])

    @property
    def cut(self) -> bool:
        """True if the computed box ends within the window."""
        size = self.window[1] - self.window[0]
        return not np.allclose(self.shown, self.window, rtol=0.0, atol=ROUND_OFF * size)

    @property
    def stretched(self) -> bool:
        """True if the ellipse is too long for equal axes."""
        return max(self.half_x / self.half_y, self.half_y / self.half_x) > STRETCHED

    @property
    def pressure_top(self) -> float:
        """Largest pressure shown, in the unit of `pressure`; or of Hertz in a failed solution."""
        top = float(np.nanmax(self.pressure, initial=0.0))
        return top if 0.0 < top < inf else self.hertz

    @property
    def film_range(self) -> tuple[float, float]:
        """Film at the ends of the colour scale, in the unit of `film`: the inlet saturates."""
        return film_range(self.central, self.smallest)

    @property
    def smallest(self) -> float:
        """Smallest film, of the map or extrapolated, in the unit of `film`."""
        least = float(np.nanmin(self.film, initial=inf))
        return min(least, self.minimum) if least > 0.0 else self.minimum


def contact_view(
    solution: ContactSolution, window: tuple[float, float, float] | None = None
) -> ContactView:
    """Part of a contact that pictures show, about [-2.5, 1.5] semi-axes along the entrainment.

    Parameters
    ----------
    solution : ContactSolution
        Solved film of the contact.
    window : tuple[float, float, float] | None, optional
        First and last position along the entrainment and half width across it [mm]; chosen by the
        pressure if None.

    Returns
    -------
    ContactView
        The part.
    """
    angle = solution.frame_angle
    kappa = solution.semi_axis_ratio
    half_x, half_y = half_extents(angle, kappa)
    a, h, p = shown_scales(solution)
    if window is None:
        ends = shown_ends(solution.X, solution.Y, solution.P, half_x, half_y)
        x_in, x_out, side = (a * end for end in ends)
    else:
        x_in, x_out, side = window
    x = a * solution.X
    y = a * solution.Y
    rows = around(x, x_in, x_out)
    columns = around(y, -side, side)
    central, minimum = solution.film_central_dimensionless, solution.film_minimum_dimensionless
    doubt = "" if solution.resolved else "not resolved"
    return ContactView(
        x=x[rows],
        y=y[columns],
        film=h * solution.H[rows, columns],
        pressure=p * solution.P[rows, columns],
        hertz=p,
        reach_x=a / hypot(cos(angle), sin(angle) / kappa),
        reach_y=a / hypot(sin(angle), cos(angle) / kappa),
        ellipse=a * _ellipse(angle, kappa),
        half_x=a * half_x,
        half_y=a * half_y,
        central=h * central.value,
        central_uncertainty=h * central.uncertainty,
        minimum=h * minimum.value,
        minimum_uncertainty=h * minimum.uncertainty,
        length_unit="a" if solution.semi_axis_x is None else "mm",
        film_unit="$a^2/R_x$" if solution.film_scale is None else "µm",
        pressure_unit="GPa" if solution.hertz_pressure > 0.0 else "$p_h$",
        box=(float(x[0]), float(x[-1]), float(y[0]), float(y[-1])),
        window=(float(x_in), float(x_out), -float(side), float(side)),
        oblique=oblique_angle(solution),
        doubt=doubt if solution.converged else "not converged",
        **_layer_fields(solution.supply, rows, columns, h),
    )


def _layer_fields(
    supply: OilSupply | None, rows: slice, columns: slice, h: float
) -> dict[str, Array]:
    """Share of the gap filled, and oil left behind in the unit of films, of the part shown."""
    if supply is None or supply.filled is None or supply.outlet_layer is None:
        return {}
    return {"filled": supply.filled[rows, columns], "outlet": h * supply.outlet_layer[columns]}


def oblique_angle(solution: ContactSolution) -> float:
    """Angle of the entrainment to the grid's x, zero where it is noise.

    Parameters
    ----------
    solution : ContactSolution
        Solved film of the contact.

    Returns
    -------
    float
        The angle [deg].
    """
    angle = degrees(solution.conditions.entrainment_angle - solution.frame_angle)
    return angle if abs(angle) > 1e-6 else 0.0


def _ellipse(angle: float, kappa: float) -> Array:
    """Outline of the Hertz ellipse in the grid's axes, turned by the entrainment; units of a."""
    t = np.linspace(0.0, 2.0 * pi, 241)
    x = np.cos(t)
    y = kappa * np.sin(t)
    return np.stack([cos(angle) * x + sin(angle) * y, -sin(angle) * x + cos(angle) * y])


def shown_part(X: Array, Y: Array, P: Array, half_x: float, half_y: float) -> tuple[slice, slice]:
    """Index ranges of the nodes that cover what is shown; lengths in one unit, as [mm].

    Parameters
    ----------
    X : Array
        Nodes along the entrainment, shape (nx,) [any length].
    Y : Array
        Nodes across it, shape (ny,).
    P : Array
        Pressure, shape (nx, ny) [any unit].
    half_x : float
        Half extent of the Hertz ellipse along, in the unit of X.
    half_y : float
        Half extent across.

    Returns
    -------
    value
        Range along.
    value
        Range across.
    """
    inlet, outlet, side = shown_ends(X, Y, P, half_x, half_y)
    return around(X, inlet, outlet), around(Y, -side, side)


def shown_ends(
    X: Array, Y: Array, P: Array, half_x: float, half_y: float
) -> tuple[float, float, float]:
    """First and last x and half width that are shown, from the pressure; in one unit, as [mm].

    Parameters
    ----------
    X : Array
        Nodes along the entrainment, shape (nx,) [any length].
    Y : Array
        Nodes across it, shape (ny,).
    P : Array
        Pressure, shape (nx, ny) [any unit].
    half_x : float
        Half extent of the Hertz ellipse along, in the unit of X.
    half_y : float
        Half extent across.

    Returns
    -------
    tuple[float, float, float]
        First and last position along, and half width across.
    """
    loud = np.greater(P, QUIET_PRESSURE * np.nanmax(P, initial=0.0))
    rows, columns = np.flatnonzero(loud.any(axis=1)), np.flatnonzero(loud.any(axis=0))
    first = 0.0
    last = 0.0
    side = 0.0
    if rows.size:  # a failed solution may have no pressure
        first = float(X[rows[0]])
        last = float(X[rows[-1]])
        side = float(Y[columns[-1]])
    # margins beyond the pressure by eye, wider at the outlet, where the constriction lies
    inlet = min(SHOWN_INLET * half_x, first - 0.15 * (last - first))
    outlet = max(SHOWN_OUTLET * half_x, last + 0.25 * (last - first))
    side = max(SHOWN_SIDE * half_y, 1.3 * side)
    return inlet, outlet, side


def half_extents(angle: float, kappa: float) -> tuple[float, float]:
    """Half extents of the Hertz ellipse along a grid and across it.

    Parameters
    ----------
    angle : float
        Angle of the grid [rad].
    kappa : float
        Ratio of the semi-axes [-].

    Returns
    -------
    tuple[float, float]
        Half extent along, and across [a].
    """
    return hypot(cos(angle), kappa * sin(angle)), hypot(sin(angle), kappa * cos(angle))


def shown_nodes(data: Any) -> tuple[slice, slice]:
    """Index ranges of the nodes shown of a contact's data set.

    Parameters
    ----------
    data : Any
        Fields of a contact.

    Returns
    -------
    value
        Range along the entrainment.
    value
        Range across it.
    """
    a = float(data.attrs["semi_axis_x"])
    kappa = float(data.attrs["semi_axis_y"]) / a
    half_x, half_y = half_extents(float(data.attrs["frame_angle"]), kappa)
    return shown_part(data["x"].values, data["y"].values, data["P"].values, a * half_x, a * half_y)
