"""Inputs of a time simulation: cage, contact laws, drag, schedule, accuracy; frozen, SI. Choices
are enumerations in the words of case files.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.options import require_positive

from ..operation import Operation
from .arrays import OIL_VISCOSITY, PRESCRIBED_DISPLACEMENT, PRESCRIBED_RATE
from .choices import Guidance, Integration, LoadType, NormalLaw, Start
from .friction import RaceFriction
from .support import Support


def prescribed_values(operation: Operation) -> tuple[float, ...]:
    """Speeds of the rings, force and moment of an operation.

    Parameters
    ----------
    operation : Operation
        speeds, loads and displacements

    Returns
    -------
    tuple[float, ...]
        seven values, zero on a coordinate with a prescribed displacement [rad/s], [N], [N m]
    """
    loads = (0.0 if load is None else load for load in operation.loads)
    return (operation.inner_speed, operation.outer_speed, *loads)


def prescribed_displacements(operation: Operation) -> tuple[float, ...]:
    """Prescribed displacements of the inner ring.

    Parameters
    ----------
    operation : Operation
        speeds, loads and displacements

    Returns
    -------
    tuple[float, ...]
        x, y, z [m], tilts about y and z [rad]; zero on a coordinate with a load
    """
    return tuple(0.0 if place is None else place for place in operation.displacements)


@dataclass(frozen=True, slots=True, kw_only=True)
class NormalContact:
    """Normal law of all contacts."""

    law: NormalLaw = NormalLaw.LANKARANI_NIKRAVESH
    # e, from which the damping follows; what comes back from an impact differs a little
    # (docs/theory/dynamics.md)
    restitution: float = 0.9  # [-]
    # smallest v_0: a slower contact is no impact; its film damps it, without oil this speed
    impact_floor: float = 0.05  # [m/s]
    # K of a ball on a race; None: Hertz' of the grooved race
    inner_stiffness: float | None = None  # [N/m^1.5]
    outer_stiffness: float | None = None  # [N/m^1.5]

    def __post_init__(self) -> None:
        if not 0.0 < self.restitution <= 1.0:
            raise ValueError(f"restitution must lie in (0, 1], got {self.restitution!r}")
        require_positive(self, "impact_floor")
        stiffnesses = {"inner": self.inner_stiffness, "outer": self.outer_stiffness}
        given = {f"{race}_stiffness": k for race, k in stiffnesses.items() if k is not None}
        require_positive(given)


@dataclass(frozen=True, slots=True, kw_only=True)
class CageBody:
    """The cage as a rigid body; pockets are radial cylinders, or spheres where balls guide it."""

    mass: float  # [kg]
    polar_inertia: float  # [kg m^2]
    transverse_inertia: float  # [kg m^2]
    pocket_clearance: float  # diametral, pocket less ball [m]
    pocket_stiffness: float  # K of ball against pocket [N/m^1.5]
    pocket_friction: float = 0.0  # Coulomb's mu [-]
    pocket_height: float = 0.0  # of its wall along the radius; 0: no film in it [m]
    film_least: float = 1.0e-6  # least film between ball and pocket [m]
    # diametral, pocket by pocket; none: all have `pocket_clearance`
    pocket_clearances: tuple[float, ...] = ()  # [m]
    unbalance: float = 0.0  # mass times eccentricity, towards the first pocket [kg m]
    drag: float = 0.0  # torque over the square of its speed [N m s^2]
    guidance: Guidance = Guidance.BALLS
    # each of the two guiding lands: radius, radial clearance, width, distance from the middle
    land_radius: float = 0.0  # [m]
    land_clearance: float = 0.0  # [m]
    land_width: float = 0.0  # [m]
    land_offset: float = 0.0  # [m]
    land_stiffness: float = 0.0  # of a land without a film [N/m]
    land_friction: float = 0.0  # Coulomb's mu without a film [-]
    assumed: tuple[str, ...] = ()  # what was estimated rather than given

    def __post_init__(self) -> None:
        require_positive(self, "mass", "polar_inertia", "transverse_inertia")
        require_positive(self, "pocket_clearance", "pocket_stiffness")
        if any(not clearance > 0.0 for clearance in self.pocket_clearances):
            raise ValueError(f"pocket_clearances must be positive, got {self.pocket_clearances}")
        if self.guidance is not Guidance.BALLS:
            require_positive(self, "land_radius", "land_clearance", "land_width", "land_stiffness")

    def clearances(self, balls: int) -> tuple[float, ...]:
        """Diametral clearance of each pocket.

        Parameters
        ----------
        balls : int
            number of balls [-]

        Returns
        -------
        tuple[float, ...]
            clearances, one a ball [m]

        Raises
        ------
        ValueError
            if their number is not that of the balls
        """
        if self.pocket_clearances and len(self.pocket_clearances) != balls:
            count = len(self.pocket_clearances)
            raise ValueError(f"pocket_clearances: needs one a ball, {balls}, got {count}")
        return self.pocket_clearances or (self.pocket_clearance,) * balls

    @property
    def even(self) -> bool:
        """True if all pockets are equal and the cage is balanced."""
        return len(set(self.pocket_clearances)) < 2 and self.unbalance == 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RingBody:
    """Inner ring and what turns with it: mass [kg], inertias [kg m^2], damping [N s/m]."""

    mass: float
    polar_inertia: float
    transverse_inertia: float
    damping: float = 0.0
    unbalance: float = 0.0  # mass times eccentricity [kg m]
    unbalance_phase: float = 0.0  # from +y at time zero [rad]
    assumed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        require_positive(self, "mass", "polar_inertia", "transverse_inertia")
        if not self.damping >= 0.0:
            raise ValueError(f"damping must not be negative, got {self.damping!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Surfaces:
    """Heights of the surfaces over a turn, as they enter the contacts, and what is left of loads
    and damping to the forms: laws of the races by their films.
    """

    inner: Array  # shape (n,) [m]
    outer: Array
    balls: Array  # at inner and outer race, shape (2, 1 or Z, n) [m]
    excess: Array  # radius of each ball over the nominal one, shape (Z,) [m]
    even: bool  # no height differs from zero


@dataclass(frozen=True, slots=True, kw_only=True)
class Guide:
    """A cage that turns as prescribed, and the balls in their places in it, without friction."""

    speed: float  # over that of the rings against each other, added to the outer one's [-]
    roll: float  # of a ball about its own axis, likewise [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Settling:
    """Time before zero in which the form grows from nothing and bodies are damped."""

    time: float  # [s]
    growth: float  # of the form [s]
    damped: float  # [s]
    rate: float  # damping over the masses [1/s]


@dataclass(frozen=True, slots=True, kw_only=True)
class RotatingLoad:
    """A force on the inner ring across the axis that goes round at a speed."""

    force: float  # [N]
    speed: float  # about x [rad/s]
    phase: float = 0.0  # from +y at time zero [rad]

    def __post_init__(self) -> None:
        require_positive(self, "force")


@dataclass(frozen=True, slots=True, kw_only=True)
class Schedule:
    """Speeds, loads, places and viscosity over time, linear between the rows, the last one kept;
    places by the cubic that has place and rate of both rows.
    """

    time: tuple[float, ...]  # rising [s]
    # at each: speed of inner and of outer ring, force along x, y, z, moment about y, z
    values: tuple[tuple[float, ...], ...]  # [rad/s], [N], [N m]
    # prescribed x, y, z [m] and tilts [rad] of the inner ring; None: as in the operation
    places: tuple[tuple[float, ...], ...] | None = None
    rates: tuple[tuple[float, ...], ...] | None = None  # of them [m/s], [rad/s]
    # oil in pockets and lands, over `DynamicsModel.film_viscosity`; None: one throughout
    viscosity: tuple[float, ...] | None = None  # [-]

    def __post_init__(self) -> None:
        lengths = {len(row) for row in self.values}
        if lengths != {PRESCRIBED_DISPLACEMENT} or len(self.time) != len(self.values):
            raise ValueError("schedule: needs a row of seven values for each time")
        for rows in (self.places, self.rates):
            if rows is not None and [len(row) for row in rows] != [5] * len(self.time):
                raise ValueError("schedule: needs a row of five places and rates for each time")
        viscosity = (1.0,) * len(self.time) if self.viscosity is None else self.viscosity
        if len(viscosity) != len(self.time) or not min(viscosity) > 0.0:
            raise ValueError("schedule: needs a positive viscosity for each time")
        if any(b <= a for a, b in zip(self.time, self.time[1:], strict=False)):
            raise ValueError(f"schedule: times must rise, got {self.time}")

    @classmethod
    def from_tables(
        cls, operation: Operation, tables: Mapping[int, Sequence[Sequence[float]] | None]
    ) -> "Schedule | None":
        """Tables over time on one set of times; the rest as in the operation.

        Parameters
        ----------
        operation : Operation
            speeds, loads and displacements outside the tables
        tables : Mapping[int, Sequence[Sequence[float]] | None]
            by the first of the columns of `EquationData.schedule` that they fill, rows of time [s]
            and their values in SI; displacements without overshoot, at rest in the first and the
            last row (`smooth`)

        Returns
        -------
        Schedule | None
            schedule; None without any table
        """
        given = {first: np.array(rows) for first, rows in tables.items() if rows is not None}
        if not given:
            return None
        times = np.unique(np.concatenate([table[:, 0] for table in given.values()]))
        row = (
            *prescribed_values(operation),
            *prescribed_displacements(operation),
            *[0.0] * 5,
            1.0,
        )
        values = np.tile(row, (times.size, 1))
        for first, table in given.items():
            for k, column in enumerate(table[:, 1:].T, start=first):
                if PRESCRIBED_DISPLACEMENT <= k < PRESCRIBED_RATE:
                    step = PRESCRIBED_RATE - PRESCRIBED_DISPLACEMENT
                    values[:, k], values[:, k + step] = smooth(table[:, 0], column, times)
                else:
                    values[:, k] = np.interp(times, table[:, 0], column)
        return cls(
            time=tuple(times.tolist()),
            values=_rows(values[:, :PRESCRIBED_DISPLACEMENT]),
            places=_rows(values[:, PRESCRIBED_DISPLACEMENT:PRESCRIBED_RATE]),
            rates=_rows(values[:, PRESCRIBED_RATE:OIL_VISCOSITY]),
            viscosity=tuple(values[:, OIL_VISCOSITY].tolist()),
        )


def smooth(time: Array, position: Array, at: Array) -> tuple[Array, Array]:
    """Position and rate by a piecewise cubic that does not overshoot, at rest at both ends.

    Fritsch and Butland (1984).

    Parameters
    ----------
    time : Array
        times of the rows, rising, shape (n,) [s]
    position : Array
        positions there, shape (n,) [m] or [rad]
    at : Array
        times of the result, shape (m,) [s]

    Returns
    -------
    place
        positions, shape (m,) [m] or [rad]
    rate
        their rates, shape (m,) [m/s] or [rad/s]
    """
    # a row like the first before it, and like the last behind: there the curve is level
    t = np.concatenate([[time[0] - 1.0], time, [time[-1] + 1.0]])
    curve = scipy.interpolate.PchipInterpolator(
        t, np.concatenate([position[:1], position, position[-1:]])
    )
    return np.asarray(curve(at)), np.asarray(curve(at, 1))


def _rows(values: Array) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row) for row in values.tolist())


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamicsOptions:
    """How to simulate."""

    end_time: float  # or the longest one, `until_steady` [s]
    sample_interval: float  # between rows of the history [s]
    start: Start = Start.QUASI_STATIC
    equations: LoadType | None = None  # None: by the load (`load_type`)
    integration: Integration = Integration.EXPLICIT
    # None: a share of the vibration of a loaded ball (`simulation.STEP_ANGLE`)
    longest_step: float | None = None  # [s]
    # tolerance of a step's error in units of contact approach and of speed in its vibration, see
    # docs/theory/dynamics.md
    tolerance: float = 1.0e-4  # [-]
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)  # along x, y, z [m/s^2]
    drag: float = 0.0  # of a ball over the square of its speed, C_D rho A/2 [N s^2/m^2]
    until_steady: bool = False  # end where nothing drifts any more (`statistics.settled`)

    def __post_init__(self) -> None:
        require_positive(self, "end_time", "sample_interval", "tolerance")
        if self.sample_interval > self.end_time:
            text = f"sample_interval must not exceed end_time {self.end_time}"
            raise ValueError(f"{text}, got {self.sample_interval}")
        if not self.drag >= 0.0:
            raise ValueError(f"drag must not be negative, got {self.drag!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamicsModel:
    """Everything beside bearing and operation that a simulation takes."""

    options: DynamicsOptions
    ring: RingBody
    friction: RaceFriction
    cage: CageBody | None = None
    normal: NormalContact = field(default_factory=NormalContact)
    schedule: Schedule | None = None  # None: the operation's speeds and loads throughout
    rotating: RotatingLoad | None = None  # beside them
    film_viscosity: float = 0.0  # of the oil in pockets and lands, at its temperature [Pa s]
    # sliding speed up to which friction of pockets and lands rises [m/s]
    friction_ramp: float = 0.01
    ball_friction: float = 0.0  # Coulomb's mu of ball on ball, without a cage [-]
    oil: Lubricant | None = None  # whose films damp contacts that last; None: the impact floor
    support: Support = field(default_factory=Support)
    surfaces: Surfaces | None = None  # None: even
    race_laws: Array | None = None  # rows of `EquationData.normal`; None: Hertz, the oil's damping
    guide: Guide | None = None  # None: cage and balls go as they are pushed
    settling: Settling | None = None
    notes: Mapping[str, str] = field(default_factory=dict)

    @property
    def times(self) -> tuple[float, ...]:
        """Times of the rows of the schedule [s]."""
        return (0.0,) if self.schedule is None else self.schedule.time

    def rows(self, operation: Operation) -> list[tuple[float, ...]]:
        """`prescribed_values` at each time of the schedule, or those of the operation.

        Parameters
        ----------
        operation : Operation
            speeds and loads without a schedule

        Returns
        -------
        list[tuple[float, ...]]
            a row for each time [rad/s], [N], [N m]
        """
        if self.schedule is not None:
            return list(self.schedule.values)
        return [prescribed_values(operation)]

    def places(self, operation: Operation) -> list[tuple[float, ...]]:
        """`prescribed_displacements` at each time of the schedule, or those of the operation.

        Parameters
        ----------
        operation : Operation
            displacements without a schedule

        Returns
        -------
        list[tuple[float, ...]]
            a row for each time [m], [rad]
        """
        if self.schedule is not None and self.schedule.places is not None:
            return list(self.schedule.places)
        return [prescribed_displacements(operation)] * len(self.times)

    @property
    def viscosities(self) -> tuple[float, ...]:
        """Viscosity of the oil over `film_viscosity` at each time of the schedule [-]."""
        if self.schedule is not None and self.schedule.viscosity is not None:
            return self.schedule.viscosity
        return (1.0,) * len(self.times)
