"""A film that is not solved: Hertz' pressure over the ellipse, and a flat film.

In units of the semi-axes all of them are one, so that their nodes are set up at once.
"""

from dataclasses import dataclass, replace
from functools import cache, cached_property
from math import hypot, inf
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ehl.closed_form.hertz import (
    MEAN_PRESSURE_RATIO,
    HertzContact,
    ellipse_ratio,
    hertz_coefficients,
    hertz_deflection,
)
from ehl.closed_form.inlet_heat import HeatShare
from ehl.conditions import ContactConditions
from ehl.options import SolverOptions
from ehl.scaling import ScaledContact, scale_contact
from ehl.solution import ContactSolution, ConvergenceRecord, FilmValue
from ehl.traction.shear import further_lines, trapezoidal_weights

from ..geometry import Array

POINTS = 33  # along and across the ellipse [-]; 65 change the torque of a 6208 by 0.1 %
# of Hertz' pressure, from which on a node counts to the contact, whose gap goes with the film;
# ahead of it the gap is that of the bodies [-]
CONTACT_PRESSURE = 0.01


@dataclass(frozen=True, kw_only=True)
class FlatFilm:
    """Of one contact with entrainment along a principal direction."""

    conditions: ContactConditions
    central: float  # [m]
    minimum: float | None  # [m]; None: not known
    # semi-axes along and across rolling [m], Hertz' pressure [Pa], of the conditions: `flat_size`
    size: tuple[float, float, float]
    share: float = 1.0  # of the gap in the contact that a supply leaves [-]

    @property
    def gap(self) -> float:
        """In the contact [m]; around it the gap is `central`."""
        return self.share * self.central

    @property
    def mean_pressure(self) -> float:
        """Load over the area of the ellipse [Pa]."""
        return MEAN_PRESSURE_RATIO * self.size[2]

    @cached_property
    def solution(self) -> ContactSolution:
        """In the form of one that was solved."""
        contact = scale_contact(self.conditions)
        X = np.linspace(-contact.half_extent_x, contact.half_extent_x, POINTS)
        Y = np.linspace(-contact.half_extent_y, contact.half_extent_y, POINTS)
        pressure = contact.dry_pressure(X[:, None], Y[None, :])
        gap = np.where(pressure > CONTACT_PRESSURE, self.gap, self.central)
        return ContactSolution(
            conditions=self.conditions,
            options=SolverOptions(),
            X=X,
            Y=Y,
            P=pressure,
            H=gap / film_scale(contact),
            semi_axis_ratio=contact.semi_axis_ratio,
            frame_angle=contact.frame_angle,
            domain=(float(X[0]), float(X[-1]), float(Y[-1])),
            resolved=False,
            converged=True,
            message="film of a formula",
            record=_NOT_SOLVED,
            **film_values(contact, self.central, self.minimum),
        )


def flat_size(
    conditions: ContactConditions, dry: HertzContact | None = None
) -> tuple[float, float, float]:
    """Semi-axes along and across rolling [m], Hertz' pressure [Pa] of conditions; those of the dry
    contact where it has the same load and radii.
    """
    c = conditions
    if dry is not None and (c.load, c.radius_x, c.radius_y, c.reduced_modulus) == (
        *(dry.load, dry.radius_x, dry.radius_y, dry.reduced_modulus),
    ):
        return dry.semi_axis_x, dry.semi_axis_y, dry.pressure
    ratio = c.radius_x / c.radius_y
    f, g, _ = hertz_coefficients(ratio)
    load = (c.load / (c.reduced_modulus * c.radius_x**2)) ** (1.0 / 3.0)
    along = f * load * c.radius_x
    return along, ellipse_ratio(ratio) * along, g * load * c.reduced_modulus


_NOT_SOLVED = ConvergenceRecord(
    residual=(),
    force_error=(),
    film_change=(),
    cycles=0,
    fft_equivalents=0.0,
    fallbacks=(),
    wall_time=0.0,
)


def film_values(contact: ScaledContact, central: float, minimum: float | None) -> dict[str, Any]:
    """Numbers of a solution of a film [m], under Hertz' pressure."""
    scale = film_scale(contact)
    least = central if minimum is None else minimum
    ratio = contact.semi_axis_ratio
    approach = central / scale - contact.deformation * contact.load * hertz_deflection(
        0.0, 0.0, ratio
    )
    return {
        "approach_dimensionless": FilmValue(value=approach, uncertainty=inf, finest=approach),
        "film_central_dimensionless": _value(central / scale),
        "film_minimum_dimensionless": _value(least / scale),
        "moes_load": contact.moes_load,
        "moes_lubricant": contact.moes_lubricant,
        "semi_axis_x": contact.semi_axis_x,
        "hertz_pressure": contact.hertz_pressure,
        "film_scale": scale,
    }


def _value(film: float) -> FilmValue:
    return FilmValue(value=film, uncertainty=0.0, finest=film)


def film_scale(contact: ScaledContact) -> float:
    """a^2/Rx of a contact with dimensions [m]."""
    assert contact.film_scale is not None
    return contact.film_scale


def with_gap(film: ContactSolution | FlatFilm, share: float) -> ContactSolution | FlatFilm:
    """A film whose gap in the contact is a share of what it was [-]."""
    if share == 1.0:
        return film
    if isinstance(film, FlatFilm):
        return replace(film, share=share * film.share)
    inside = film.P > CONTACT_PRESSURE
    return replace(film, H=np.where(inside, share * film.H, film.H))


def heated_solution(film: ContactSolution, share: HeatShare) -> ContactSolution:
    """A solved film with what the heat of its inlet leaves of it [-], the range in its error
    bars.
    """
    if share.value == 1.0:
        return film
    thin = with_gap(film, share.value)
    assert isinstance(thin, ContactSolution)
    return replace(
        thin,
        film_central_dimensionless=_heated(film.film_central_dimensionless, share),
        film_minimum_dimensionless=_heated(film.film_minimum_dimensionless, share),
    )


def _heated(film: FilmValue, share: HeatShare) -> FilmValue:
    return FilmValue(
        value=share.value * film.value,
        uncertainty=hypot(share.value * film.uncertainty, share.uncertainty * film.value),
        finest=share.value * film.finest,
    )


class FlatNodes(NamedTuple):
    """Nodes that shear in a flat film, n of them [-]; x over the semi-axis along, y over that
    across, area over both.
    """

    x: Array
    y: Array
    area: Array
    # different pressures over Hertz' (m,), the first is none, and the place of each node in them
    pressure: Array
    level: NDArray[np.int64]
    opening: Array  # (x^2 - 1)/2 of lines behind the ellipse, zero on it
    inside: NDArray[np.bool_]  # in the contact


@cache
def flat_pressures() -> tuple[Array, Array]:
    """Pressure over Hertz' on `POINTS` lines over the ellipse along rolling, of them those with y
    >= 0, shape (POINTS, POINTS // 2 + 1), and how many each of these stands for [-].
    """
    left = _left()[:, POINTS // 2 :]
    count = np.full(left.shape[1], 2.0)
    count[0] = 1.0
    return np.sqrt(left) * 2.0 / (POINTS - 1), count


def _left() -> NDArray[np.int64]:
    """Square of the pressure over Hertz' on `POINTS` lines each way, times that of half their
    number, which is whole.
    """
    steps = POINTS // 2
    places = np.arange(-steps, steps + 1)
    return np.maximum(steps**2 - places[:, None] ** 2 - places**2, 0)


@cache
def flat_nodes() -> FlatNodes:
    """Those of `POINTS` lines over the ellipse, of its lee, and of the lines behind as those of
    `ehl.traction.shear.with_outlet`; ahead of the ellipse nothing shears.
    """
    steps = POINTS // 2
    places = np.arange(-steps, steps + 1)
    further = further_lines(1.0, 1.0 / steps)
    x = np.concatenate([places / steps, further])
    y = places / steps
    left = np.zeros((x.size, y.size), dtype=np.int64)
    left[:POINTS] = _left()
    full = left > 0
    lee = full.any(axis=0) & ~full & (np.arange(x.size)[:, None] > steps)
    chosen = full | lee
    squares, level = np.unique(left[chosen], return_inverse=True)
    opening = np.where(x > 1.0, 0.5 * (x**2 - 1.0), 0.0)[:, None] + np.zeros_like(y)
    X, Y = np.broadcast_arrays(x[:, None], y)
    area = trapezoidal_weights(x, y)
    behind = np.argsort(~full[chosen], kind="stable")  # nodes with pressure first
    return FlatNodes(
        x=X[chosen][behind],
        y=Y[chosen][behind],
        area=area[chosen][behind],
        pressure=np.sqrt(squares) / steps,
        level=level.astype(np.int64)[behind],
        opening=opening[chosen][behind],
        inside=full[chosen][behind],
    )
