"""Features of the surfaces: waviness, dents, ridges, measured profiles.

A feature is a height z of its surface over the undeformed body, positive into the gap, over
places x from a point that moves with the body, and y; x runs along the entrainment. The film is
thinner by z.
"""

from dataclasses import dataclass
from math import cos, inf, pi, sin
from typing import Protocol

import numpy as np

from ..arrays import Array
from ..ranges import require_finite, require_positive

BODIES = (1, 2)
# widths of a bump ahead of its middle, beyond which it is 1e-4 of its height
REACH = 3.0


class Feature(Protocol):
    """A feature of one of the bodies."""

    @property
    def body(self) -> int:
        """1 or 2."""

    @property
    def start(self) -> float | None:
        """Place of its point at t = 0, along the entrainment from the contact's centre [m]; None:
        so that it enters the box at once, or everywhere on a body at rest.
        """

    @property
    def reach(self) -> float:
        """How far it reaches ahead of its point along x [m]."""

    @property
    def symmetric(self) -> bool:
        """True if the feature is even in y."""

    @property
    def size(self) -> float:
        """Largest height or depth [m]."""

    def height(self, x: Array, y: Array, front: float) -> Array:
        """Evaluate the height z of the feature; a wave without end begins at x = `front`.

        Parameters
        ----------
        x : Array
            distance from the feature along the entrainment, any shape [m]
        y : Array
            distance across, of a shape that fits [m]
        front : float
            distance at which a wave begins [m]

        Returns
        -------
        Array
            height, of the common shape [m]
        """


def _require_body(feature: Feature) -> None:
    if feature.body not in BODIES:
        raise ValueError(f"body must be 1 or 2, got {feature.body!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Waviness:
    """Waves without end, z = A sin(2 pi x/lambda_x + phase) cos(2 pi y/lambda_y).

    Over the first wavelength behind its front the amplitude rises smoothly.
    """

    body: int  # 1 or 2
    amplitude: float  # A [m]
    wavelength: float  # lambda_x [m]
    wavelength_across: float | None = None  # lambda_y [m]; None: no waves across
    phase: float = 0.0  # at its point [rad]
    start: float | None = None  # of its point at t = 0 [m]

    def __post_init__(self) -> None:
        _require_body(self)
        require_positive(self, "wavelength")
        require_finite(self, "amplitude", "phase")
        if self.wavelength_across is not None:
            require_positive(self, "wavelength_across")

    reach = 0.0
    symmetric = True

    @property
    def size(self) -> float:
        """Amplitude [m]."""
        return abs(self.amplitude)

    def height(self, x: Array, y: Array, front: float = inf) -> Array:
        """Evaluate the height z of the waviness.

        Parameters
        ----------
        x : Array
            distance from the feature along the entrainment, any shape [m]
        y : Array
            distance across, of a shape that fits [m]
        front : float, default inf
            distance at which the wave begins [m]

        Returns
        -------
        Array
            height, of the common shape [m]
        """
        wave = self.amplitude * np.sin(2.0 * pi * x / self.wavelength + self.phase)
        if self.wavelength_across is not None:
            wave = wave * np.cos(2.0 * pi * y / self.wavelength_across)
        inside = np.clip((front - x) / self.wavelength, 0.0, 1.0)
        return np.asarray(wave * inside**2 * (3.0 - 2.0 * inside) + 0.0 * y)


@dataclass(frozen=True, slots=True, kw_only=True)
class Dent:
    """A round or oval dent, z = -depth exp(-(x/r_x)^2 - (y/r_y)^2); a bump of negative depth."""

    body: int  # 1 or 2
    depth: float  # [m]
    radius: float  # r_x, at which 1/e of the depth is left [m]
    radius_across: float | None = None  # r_y [m]; None: round
    place_across: float = 0.0  # y of its middle [m]
    start: float | None = None  # of its point at t = 0 [m]

    def __post_init__(self) -> None:
        _require_body(self)
        require_positive(self, "radius")
        require_finite(self, "depth", "place_across")
        if self.radius_across is not None:
            require_positive(self, "radius_across")

    @property
    def reach(self) -> float:
        """Half the extent of the feature on y = 0 [m]."""
        return REACH * self.radius

    @property
    def symmetric(self) -> bool:
        """True if the feature is even in y."""
        return self.place_across == 0.0

    @property
    def size(self) -> float:
        """Depth [m]."""
        return abs(self.depth)

    def height(self, x: Array, y: Array, front: float = inf) -> Array:
        """Evaluate the height z of the dent.

        Parameters
        ----------
        x : Array
            distance from the feature along the entrainment, any shape [m]
        y : Array
            distance across, of a shape that fits [m]
        front : float, default inf
            not used [m]

        Returns
        -------
        Array
            height, of the common shape [m]
        """
        across = self.radius if self.radius_across is None else self.radius_across
        far = (x / self.radius) ** 2 + ((y - self.place_across) / across) ** 2
        return np.asarray(-self.depth * np.exp(-far))


@dataclass(frozen=True, slots=True, kw_only=True)
class Ridge:
    """A straight ridge, z = h exp(-(s/w)^2), s the distance from its crest; a groove of negative
    height. At the angle 0 it lies across the entrainment.
    """

    body: int  # 1 or 2
    ridge_height: float  # h [m]
    width: float  # w, at which 1/e of the height is left [m]
    angle: float = 0.0  # of the crest from y, towards -x [rad]
    start: float | None = None  # of its point at t = 0 [m]

    def __post_init__(self) -> None:
        _require_body(self)
        require_positive(self, "width")
        require_finite(self, "ridge_height", "angle")
        if abs(cos(self.angle)) < 1e-3:
            raise ValueError("angle: a ridge along the entrainment never enters the contact")

    @property
    def reach(self) -> float:
        """Half the extent of the feature on y = 0 [m]."""
        return REACH * self.width / abs(cos(self.angle))

    @property
    def symmetric(self) -> bool:
        """True if the feature is even in y."""
        return self.angle == 0.0

    @property
    def size(self) -> float:
        """Height [m]."""
        return abs(self.ridge_height)

    def height(self, x: Array, y: Array, front: float = inf) -> Array:
        """Evaluate the height z of the ridge.

        Parameters
        ----------
        x : Array
            distance from the feature along the entrainment, any shape [m]
        y : Array
            distance across, of a shape that fits [m]
        front : float, default inf
            not used [m]

        Returns
        -------
        Array
            height, of the common shape [m]
        """
        away = (x * cos(self.angle) + y * sin(self.angle)) / self.width
        return np.asarray(self.ridge_height * np.exp(-(away**2)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Profile:
    """A measured surface: heights at places along x, or over x and y, straight lines between them.

    Its point is its foremost place; outside there is no height, so that the first and last should
    be near zero.
    """

    body: int  # 1 or 2
    x: Array  # rising, shape (n,) [m]
    heights: Array  # shape (n,), or (n, m) with y [m]
    y: Array | None = None  # rising, shape (m,) [m]
    start: float | None = None  # of its point at t = 0 [m]

    def __post_init__(self) -> None:
        _require_body(self)
        shape = (self.x.size,) if self.y is None else (self.x.size, self.y.size)
        if self.heights.shape != shape or self.x.size < 2:
            raise ValueError(f"heights must have the shape {shape}, got {self.heights.shape}")
        for positions in (self.x, self.x if self.y is None else self.y):
            if not (np.diff(positions) > 0.0).all():
                raise ValueError("places of a profile must rise")
        if not np.isfinite(self.heights).all():
            raise ValueError("heights must be finite")

    reach = 0.0

    @property
    def symmetric(self) -> bool:
        """True if the feature is even in y."""
        return self.y is None

    @property
    def size(self) -> float:
        """Largest height or depth [m]."""
        return float(np.abs(self.heights).max())

    def height(self, x: Array, y: Array, front: float = inf) -> Array:
        """Interpolate the height z of the measured profile.

        Parameters
        ----------
        x : Array
            distance from the feature along the entrainment, any shape [m]
        y : Array
            distance across, of a shape that fits [m]
        front : float, default inf
            not used [m]

        Returns
        -------
        Array
            height, of the common shape [m]
        """
        along = x + self.x[-1]
        if self.y is None:
            return np.asarray(np.interp(along, self.x, self.heights, 0.0, 0.0) + 0.0 * y)
        from scipy.interpolate import RegularGridInterpolator

        surface = RegularGridInterpolator(
            (self.x, self.y), self.heights, bounds_error=False, fill_value=0.0
        )
        return np.asarray(surface(np.stack(np.broadcast_arrays(along, y), axis=-1)))
