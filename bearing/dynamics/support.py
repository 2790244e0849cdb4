"""Supports of the rings: seat of the outer one, what moves with either, a sensor on it."""

from dataclasses import dataclass
from math import isfinite


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor:
    """One oscillator on the outer ring (housing, mount of a sensor), where the motion is felt."""

    mass: float  # [kg]
    frequency: float  # of its resonance on a ring at rest [Hz]
    damping_ratio: float  # [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Support:
    """Supports of the rings."""

    shaft_mass: float = 0.0  # that moves with the inner ring [kg]
    inner_ring_fixed: bool = False  # as on a stiff spindle: it stays where the loads put it
    # outer ring's seat, radial and axial [N/m]; None: it stands still; zero: it is loaded
    # against an inner ring that is held
    seat_stiffness: float | None = None
    seat_axial_stiffness: float | None = None  # None: the radial one [N/m]
    seat_damping: float = 0.0  # [N s/m]
    outer_mass: float | None = None  # of the outer ring [kg]; None: by its dimensions
    housing_mass: float = 0.0  # that moves with the outer ring [kg]
    sensor: Sensor | None = None

    @property
    def outer_moves(self) -> bool:
        """True if the outer ring is a body that moves."""
        return self.seat_stiffness is not None

    def __post_init__(self) -> None:
        for name in ("shaft_mass", "seat_damping", "housing_mass"):
            if not (isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise ValueError(f"{name} must not be negative, got {getattr(self, name)!r}")
        if self.sensor is not None and not self.outer_moves:
            raise ValueError("sensor: needs an outer ring that moves, hence a seat_stiffness")
        if self.inner_ring_fixed and not self.outer_moves:
            raise ValueError("inner_ring_fixed: nothing moves; needs a seat_stiffness, or 0")
        if self.seat_stiffness == 0.0 and not self.inner_ring_fixed:
            raise ValueError(
                "seat_stiffness: 0 leaves both rings without a hold; allowed with "
                "inner_ring_fixed, or give a stiffness"
            )
