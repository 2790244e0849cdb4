"""Options of the contact solver, and checks of input values, whose errors name the field."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

TOLERANCE = 0.01  # of the film without points and tolerance
GENERALIZED_POINTS = 257  # of films with shear or heat, without both
MOST_POINTS = 1025  # at most, to reach a tolerance without points


@dataclass(frozen=True, slots=True, kw_only=True)
class SolverOptions:
    """Options of a contact solve that a user may choose.

    Examples
    --------
    >>> from oilfilm import SolverOptions
    >>> SolverOptions(tolerance=0.005).max_points
    1025
    >>> SolverOptions(points=257).wanted_tolerance is None
    True
    """

    # nodes along x on the finest level, 2^k + 1, or with a tolerance the most of them; None: as
    # many as the tolerance needs, `MOST_POINTS` at most [-]
    points: int | None = None
    # box (x_in, x_out, y_half) in Hertz semi-axes along x and along y [-]; None: by the solver
    domain: tuple[float, float, float] | None = None
    # relative error bar of central and minimum film to reach [-]; None: `TOLERANCE` without
    # points, else none, and the film is solved on the points
    tolerance: float | None = None
    # multigrid cycles on the finest level; from six on three times as many where they lead nearer
    max_cycles: int = 20
    # over which the lines of one contact are distributed; films do not depend on it beyond
    # round-off, and below some 257 points there is no gain
    threads: int = 1
    # after the cycles, Newton's method until the equations of the finest grid hold to 1e-8
    certify: bool = False
    # behind a layer: the flooded film, and what the tabulated law of starvation leaves of it
    tabulated: bool = False

    def __post_init__(self) -> None:
        cells = self.max_points - 1
        if cells < 32 or cells > 4096 or cells & (cells - 1):
            raise ValueError(
                "points must be 2^k + 1 from 33 to 4097 (for example 129, 257, 513), "
                f"got {self.points}"
            )
        if self.tolerance is not None and not 1e-5 <= self.tolerance <= 0.5:
            raise ValueError(f"tolerance must lie between 1e-5 and 0.5, got {self.tolerance}")
        if self.max_cycles < 1:
            raise ValueError(f"max_cycles must be at least 1, got {self.max_cycles}")
        if self.threads < 1:
            raise ValueError(f"threads must be at least 1, got {self.threads}")
        if self.domain is not None:
            x_in, x_out, y_half = self.domain
            if not (x_in < -1.0 and x_out > 1.0 and y_half > 1.0):
                raise ValueError(
                    "domain must enclose the Hertz ellipse: x_in < -1, x_out > 1, y_half > 1, "
                    f"got {self.domain}"
                )

    @property
    def max_points(self) -> int:
        """Nodes along x on the finest level, or the most of them [-]."""
        return MOST_POINTS if self.points is None else self.points

    @property
    def strictness(self) -> float:
        """Factor on the limits at which cycles stop, for a tolerance below the default [-]."""
        return 1.0 if self.tolerance is None else min(1.0, self.tolerance / TOLERANCE)

    @property
    def wanted_tolerance(self) -> float | None:
        """Error bar over the film to reach [-]; None: solve on the points."""
        return TOLERANCE if self.tolerance is None and self.points is None else self.tolerance


def _values(owner: Any, names: tuple[str, ...]) -> Iterable[tuple[str, float]]:
    """Names and values, of many objects a batch: pairs without a dictionary."""
    if isinstance(owner, dict):
        return owner.items()
    return [(name, getattr(owner, name)) for name in names]


def require_finite(owner: Any, *names: str) -> None:
    """Raise ValueError unless the values are finite.

    Parameters
    ----------
    owner : Any
        an object with the attributes, or a dict whose values are all tested
    *names : str
        names of the attributes

    Raises
    ------
    ValueError
        if a value is infinite or not a number; the message has its name
    """
    for name, value in _values(owner, names):
        if not isfinite(value):
            raise ValueError(f"{name} must be finite, got {value!r}")


def require_positive(owner: Any, *names: str) -> None:
    """Raise ValueError unless the values are positive and finite.

    Parameters
    ----------
    owner : Any
        an object with the attributes, or a dict whose values are all tested
    *names : str
        names of the attributes

    Raises
    ------
    ValueError
        if a value is zero, negative, infinite or not a number; the message has its name
    """
    for name, value in _values(owner, names):
        if not 0.0 < value < inf:
            raise ValueError(f"{name} must be positive and finite, got {value!r}")


def require_not_negative(owner: Any, *names: str) -> None:
    """Raise ValueError unless the values are zero or positive, and finite.

    Parameters
    ----------
    owner : Any
        an object with the attributes, or a dict whose values are all tested
    *names : str
        names of the attributes

    Raises
    ------
    ValueError
        if a value is negative, infinite or not a number; the message has its name
    """
    for name, value in _values(owner, names):
        if not (isfinite(value) and value >= 0.0):
            raise ValueError(f"{name} must be zero or positive and finite, got {value!r}")
