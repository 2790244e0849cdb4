"""Speeds and loads of a bearing, and the assumptions it is computed with."""

from dataclasses import dataclass
from enum import Enum
from math import isfinite, pi

from .rings.elastic_ring import ElasticRings

DEGREES_OF_FREEDOM = ("x", "y", "z", "tilt y", "tilt z")


class BallKinematics(Enum):
    """Hypothesis that fixes the attitude of the balls' spin and divides the gyroscopic couple
    among the races.

    OUTER_RACE_CONTROL: no spin at the outer race, which takes the whole couple;
    INNER_RACE_CONTROL: likewise inner; HALF_AND_HALF: the ball spins about the mean contact angle
    and each race takes half of the couple. TRACTION_EQUILIBRIUM: no hypothesis; the friction of
    ball on race is in balance on every ball (`friction.equilibrium`).
    """

    HALF_AND_HALF = "half and half"
    OUTER_RACE_CONTROL = "outer race control"
    INNER_RACE_CONTROL = "inner race control"
    TRACTION_EQUILIBRIUM = "traction equilibrium"


HYPOTHESES = (
    BallKinematics.OUTER_RACE_CONTROL,
    BallKinematics.INNER_RACE_CONTROL,
    BallKinematics.HALF_AND_HALF,
)


class Curvature(Enum):
    """Contact angle at which the curvature of the races in the rolling direction is taken."""

    OPERATING = "operating"
    FREE = "free"


@dataclass(frozen=True, slots=True, kw_only=True)
class QuasistaticModel:
    """Assumptions of the bearing model.

    Examples
    --------
    >>> from oilfilm import QuasistaticModel
    >>> from oilfilm.bearing import BallKinematics
    >>> model = QuasistaticModel(ball_kinematics=BallKinematics.OUTER_RACE_CONTROL)
    >>> model.rings is None
    True
    """

    ball_kinematics: BallKinematics = BallKinematics.HALF_AND_HALF
    curvature: Curvature = Curvature.OPERATING
    rings: ElasticRings | None = (
        None  # rings as elastic bodies; None: they yield at contacts alone
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Operation:
    """Speeds, and per degree of freedom of the inner ring either its load or its displacement, SI.

    Raises
    ------
    ValueError
        if a degree of freedom has both or neither, or a value is not finite

    Examples
    --------
    >>> from math import pi
    >>> from oilfilm.bearing import Operation
    >>> operation = Operation(inner_speed=3000.0 * pi / 30.0, force=(0.0, 1000.0, 0.0))
    >>> f"{operation.shaft_speed:.1f} rad/s"
    '314.2 rad/s'
    """

    inner_speed: float  # of the ring about +x [rad/s]
    outer_speed: float = 0.0  # [rad/s]
    temperature: float = 313.15  # [K]
    # external force (x, y, z) on the inner ring [N]; None where the displacement is given
    force: tuple[float | None, float | None, float | None] = (0.0, 0.0, 0.0)
    # external moment (y, z) on the inner ring about the centre of its groove circle [N m]
    moment: tuple[float | None, float | None] = (None, None)
    # displacement (x, y, z) of the inner ring from facing, concentric grooves [m]; None where the
    # force is given
    displacement: tuple[float | None, float | None, float | None] = (None, None, None)
    tilt: tuple[float | None, float | None] = (0.0, 0.0)  # rotation (y, z) of the inner ring [rad]

    def __post_init__(self) -> None:
        for field in ("inner_speed", "outer_speed"):
            if not isfinite(getattr(self, field)):
                raise ValueError(f"{field} must be finite, got {getattr(self, field)!r}")
        if not (isfinite(self.temperature) and self.temperature > 0.0):
            raise ValueError(f"temperature must be positive and finite, got {self.temperature!r}")
        for field, length in (("force", 3), ("moment", 2), ("displacement", 3), ("tilt", 2)):
            values = getattr(self, field)
            if len(values) != length:
                raise ValueError(f"{field} must have {length} entries, got {len(values)}")
            if any(value is not None and not isfinite(value) for value in values):
                raise ValueError(f"{field} must be finite, got {values!r}")
        pairs = zip(DEGREES_OF_FREEDOM, self.loads, self.displacements, strict=True)
        for name, load, displacement in pairs:
            if (load is None) == (displacement is None):
                load_field, displacement_field = (
                    ("moment", "tilt") if "tilt" in name else ("force", "displacement")
                )
                given = "neither" if load is None else "both"
                raise ValueError(
                    f"{load_field} and {displacement_field}: degree of freedom {name} needs "
                    f"exactly one, has {given}"
                )

    @property
    def shaft_speed(self) -> float:
        """Speed of the inner ring relative to the outer, magnitude [rad/s]."""
        return abs(self.inner_speed - self.outer_speed)

    @property
    def loads(self) -> tuple[float | None, ...]:
        """Loads in the order x, y, z, tilt y, tilt z, [N] and [N m]."""
        return (*self.force, *self.moment)

    @property
    def displacements(self) -> tuple[float | None, ...]:
        """Displacements in the order x, y, z, tilt y, tilt z, [m] and [rad]."""
        return (*self.displacement, *self.tilt)


@dataclass(frozen=True, slots=True, kw_only=True)
class RatingInput:
    """Inputs of a rating beyond the bearing and its loads."""

    # C_r of the catalogue [N]; None computes it from the geometry
    dynamic_rating: float | None = None
    # alpha of the rating formulas [rad], 0 for deep groove bearings
    nominal_contact_angle: float = 0.0
    # e_C [-], from 0 (severe) to 1 (none); None leaves the modified life out
    contamination_factor: float | None = None
    # C_0 of the catalogue [N]; None computes it from the geometry
    static_rating: float | None = None
    reliability: float = 90.0  # of the modified life [%]

    def __post_init__(self) -> None:
        if not 90.0 <= self.reliability <= 99.9:
            raise ValueError(f"reliability must lie in [90, 99.9] %, got {self.reliability!r}")
        for field in ("dynamic_rating", "static_rating"):
            value = getattr(self, field)
            if value is not None and not value > 0.0:
                raise ValueError(f"{field} must be positive, got {value!r} N")
        if not 0.0 <= self.nominal_contact_angle < 0.5 * pi:
            raise ValueError(
                "nominal_contact_angle must lie in [0, pi/2), got "
                f"{self.nominal_contact_angle!r} rad"
            )
        if self.contamination_factor is not None and not 0.0 <= self.contamination_factor <= 1.0:
            raise ValueError(
                f"contamination_factor must lie in [0, 1], got {self.contamination_factor!r}"
            )
