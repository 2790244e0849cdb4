"""What `oilfilm slip` is asked to map, SI."""

from dataclasses import dataclass

# centrifugal force a source evidently used, over the true one [-]
PRINTED_FORCE = {"half centrifugal force": 0.5}


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipPlan:
    """The table [slip] of a case: speeds [rad/s], loads and catalogue factors [N]."""

    speeds: tuple[float, float]
    axial_loads: tuple[float, float]
    points: int
    critical_speeds: tuple[float, ...]
    critical_radial_loads: tuple[float, float]
    critical_points: int
    limit: float
    as_printed: str | None
    minimum_axial_load_factor: float | None
    minimum_radial_load_factor: float | None
