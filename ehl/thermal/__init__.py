"""Heat in the lubricated contact: temperature across the film, conduction into the moving bodies."""

from __future__ import annotations

from .formulas import film_reduction_gupta, thermal_loading
from .solids import SolidThermal

__all__ = ["SolidThermal", "film_reduction_gupta", "thermal_loading"]
