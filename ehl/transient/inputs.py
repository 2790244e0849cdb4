r"""Inputs of a run: conditions over time, features of the surfaces (waviness, dents, ridges,
measured profiles), its options, and the equation of the oil that its nodes hold.

A feature is a height z of its surface over the undeformed body, positive into the gap, over
places x from a point that moves with the body, and y; x runs along the entrainment. The film is
thinner by z.

Nodes hold the oil m = rho theta H, carried with the entrainment from step to step. Along the
characteristic, moved back by d nodes a step, Reynolds' equation of step k is

.. math::
    Pois(P^k) - \frac{1}{\Delta T} \left[ c_0 m^k_i - c_1 m^{k-1}_{i-d} + c_2 m^{k-2}_{i-d'}
    \right] = 0, \qquad
    c_0 = \frac{1 + 2r}{1 + r}, \quad c_1 = 1 + r, \quad c_2 = \frac{r^2}{1 + r},

r the step over the one before, d' the nodes of both. With equal steps of a node each these are (3,
-4, 1)/2 along the characteristic, the narrow-upstream scheme of Venner and Wijnant, and what is
steady is so on the equations of the steady solver. Where the gap is full m = rho H; where it is
not, P = 0 and m < rho H: with the residual f - L(P) >= 0 of a node without pressure, m = rho H -
residual/sigma, sigma = c_0/dT. The complementarity of the solver, P >= 0 and residual >= 0, is
that of Jakobsson, Floberg and Olsson, and m is kept for all nodes in this form: oil that the
cycles have not yet put in its place is not lost, but handed on to the next step.
"""

from dataclasses import dataclass
from enum import Enum
from math import cos, inf, pi, sin
from typing import Protocol

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ..options import require_finite, require_positive

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


class Scheme(Enum):
    """Discretisation of the flow and storage of oil, d_X(u rho H) + d_T(rho H)."""

    # second order backwards along the characteristic, exact where a step moves a node to the next
    CHARACTERISTIC = "characteristic"
    # second order upstream, and second order backwards in time: to compare with
    UPSTREAM = "upstream"


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """A quantity over time by straight lines, constant before the first and after the last."""

    times: tuple[float, ...]  # rising [s]
    values: tuple[float, ...]  # [N] or [m/s]

    def __post_init__(self) -> None:
        for name in ("times", "values"):
            if not np.isfinite(getattr(self, name)).all():
                raise ValueError(f"all {name} of a course must be finite")
        if len(self.times) != len(self.values) or not self.times:
            raise ValueError("a course needs as many values as times, and one at least")
        if any(b <= a for a, b in zip(self.times, self.times[1:], strict=False)):
            raise ValueError("times of a course must rise")

    def at(self, time: float) -> float:
        """Interpolate the value at a time.

        Parameters
        ----------
        time : float
            time [s]

        Returns
        -------
        float
            value [N] or [m/s]
        """
        return float(np.interp(time, self.times, self.values))

    def integral(self, time: float) -> float:
        """Integrate the values from the first time on.

        Parameters
        ----------
        time : float
            end of the integral [s]

        Returns
        -------
        float
            integral [N s] or [m]
        """
        if time <= self.times[0]:
            return (time - self.times[0]) * self.values[0]
        inner = [t for t in self.times if t < time]
        knots = np.array([*inner, time])
        values = np.interp(knots, self.times, self.values)
        return float(np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(knots)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Impact:
    """Bodies of a mass that move freely under the load and the film's reaction."""

    mass: float  # effective, 1/(1/m_1 + 1/m_2) [kg]
    approach_speed: float  # at t = 0, positive towards each other [m/s]
    gap: float  # of the undeformed bodies at t = 0 [m]

    def __post_init__(self) -> None:
        require_positive(self, "mass", "gap")
        require_finite(self, "approach_speed")


@dataclass(frozen=True, slots=True, kw_only=True)
class TransientConditions:
    """One contact over time; its load and speed set the scales, and hold where no course is given.

    The load of the contact is to be the largest, or that of the impact: the box is made for it.
    """

    contact: ContactConditions  # sets the scales
    end_time: float  # [s]
    load: Course | None = None  # [N]
    speed: Course | None = None  # mean surface speed u_m, negative backwards [m/s]
    features: tuple[Feature, ...] = ()  # of both surfaces
    impact: Impact | None = None  # None: the bodies follow the load at once

    def __post_init__(self) -> None:
        require_positive(self, "end_time")
        c = self.contact
        if c.rotation != 0.0 or c.spin != 0.0:
            raise ValueError("spin: contacts over time are solved without spin")
        if c.inlet_layer is not None:
            raise ValueError("inlet_layer: contacts over time are solved flooded")
        if self.impact is None and not self.speed_at(0.0) != 0.0:
            raise ValueError(
                "speed: a contact at rest has no film to start from; begin with motion"
            )
        if self.impact is None and not min(self._loads()) > 0.0:
            raise ValueError("load: must stay positive; bodies that part have a mass (impact)")
        if max(self._loads()) > c.load * (1.0 + 1e-9):
            raise ValueError("load: must not exceed that of the contact, which sets the scales")

    def _loads(self) -> tuple[float, ...]:
        return (self.contact.load,) if self.load is None else self.load.values

    def load_at(self, time: float) -> float:
        """Give the load at a time; none on bodies that meet by their mass, unless it is
        prescribed.

        Parameters
        ----------
        time : float
            time [s]

        Returns
        -------
        float
            load [N]
        """
        if self.load is not None:
            return self.load.at(time)
        return self.contact.load if self.impact is None else 0.0

    def speed_at(self, time: float) -> float:
        """Give the mean surface speed at a time.

        Parameters
        ----------
        time : float
            time [s]

        Returns
        -------
        float
            mean surface speed u_m [m/s]
        """
        return self.contact.entrainment_speed if self.speed is None else self.speed.at(time)

    def displacement(self, time: float) -> float:
        """Integrate the mean surface speed from t = 0 on.

        Parameters
        ----------
        time : float
            time [s]

        Returns
        -------
        float
            displacement [m]
        """
        if self.speed is None:
            return self.contact.entrainment_speed * time
        return self.speed.integral(time) - self.speed.integral(0.0)

    def body_speed_ratio(self, body: int) -> tuple[float, float]:
        """Relate the surface speed of a body to u_m.

        Parameters
        ----------
        body : int
            1 or 2

        Returns
        -------
        along
            ratio along the entrainment [-]
        across
            ratio across it [-]
        """
        sign = 0.5 if body == 1 else -0.5
        c = self.contact
        return 1.0 + sign * c.slide_roll_ratio, sign * c.lateral_slide_ratio

    def body_displacement(self, body: int, time: float) -> tuple[float, float]:
        """Give the displacement of the surface of a body since t = 0.

        Parameters
        ----------
        body : int
            1 or 2
        time : float
            time [s]

        Returns
        -------
        along
            displacement along the entrainment [m]
        across
            displacement across it [m]
        """
        along, across = self.body_speed_ratio(body)
        displacement = self.displacement(time)
        return along * displacement, across * displacement

    @property
    def symmetric(self) -> bool:
        """True if all features stay even in y."""
        return all(
            one.symmetric and (self.body_speed_ratio(one.body)[1] == 0.0) for one in self.features
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class TransientOptions:
    """Options of a run."""

    points: int = 257  # nodes along the entrainment, 2^k + 1 [-]
    # box (x_in, x_out, y_half) in Hertz semi-axes [-]; None: the solver's own, open
    domain: tuple[float, float, float] | None = None
    scheme: Scheme = Scheme.CHARACTERISTIC  # discretisation of flow and storage
    # step at most [s]; None: four times that in which the film moves from node to node
    largest_step: float | None = None
    frames: int = 60  # fields that are kept, at even times, the first and last among them
    cycles: int = 2  # multigrid cycles a step at least
    most_cycles: int = 20  # multigrid cycles a step at most
    tolerance: float = 1e-3  # error of a step over the film, or a feature that is smaller [-]
