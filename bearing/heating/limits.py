"""Limits of temperatures."""

from dataclasses import dataclass

# highest film temperature of a balance [K]: 150 C, where mineral oils near their flash points
# (about 150 C for light ones) and the oils' data end; assumed
HIGHEST_TEMPERATURE = 423.15


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatBalance:
    """Temperature at which friction and cooling agree."""

    temperature: float  # [K]
    torque: float  # [N m]
    power: float  # friction power [W]
    evaluations: int  # of the torque
    residual: float  # friction less cooling, over the friction [-]
    converged: bool
    message: str
