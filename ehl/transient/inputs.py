"""Inputs that change over time, and the options of a run."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from ..conditions import ContactConditions
from ..ranges import require_finite, require_positive
from .features import Feature


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
                raise ValueError(f"{name} of a course must be finite")
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
