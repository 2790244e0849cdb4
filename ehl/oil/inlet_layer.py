"""Layer of oil that both surfaces together carry into a contact."""

from dataclasses import dataclass
from itertools import pairwise
from math import isfinite

import numpy as np

from ..arrays import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class InletLayer:
    """Thickness of the inlet layer at ambient density over positions across the track.

    Both are in [m], or in the units of the solver [-]; beyond its ends the thickness is constant.

    Raises
    ------
    ValueError
        If positions do not rise, a thickness is not positive, or their numbers differ. A dry track
        has no film.
    """

    thickness: tuple[float, ...]  # one for all positions, or one for each
    y: tuple[float, ...] = (0.0,)  # rising

    def __post_init__(self) -> None:
        if len(self.y) != len(self.thickness) or not self.y:
            raise ValueError("inlet layer: as many positions y as thicknesses, one at least")
        if not all(a < b for a, b in pairwise(self.y)):
            raise ValueError("inlet layer: positions y must rise")
        if not all(isfinite(h) and h > 0.0 for h in self.thickness):
            raise ValueError("inlet layer: every thickness must be positive and finite")

    @property
    def uniform(self) -> bool:
        """The thickness is the same everywhere."""
        return min(self.thickness) == max(self.thickness)

    @property
    def central(self) -> float:
        """Thickness at y = 0."""
        return float(np.interp(0.0, self.y, self.thickness))

    def at(self, y: Array) -> Array:
        """Thickness at positions across the track.

        Parameters
        ----------
        y : Array
            positions, any shape [unit of the layer's y]

        Returns
        -------
        Array
            thickness, shape of `y` [unit of the layer's thickness]
        """
        return np.interp(y, self.y, self.thickness)

    def scaled(self, length: float, height: float) -> "InletLayer":
        """The layer in units of a length along y and of a height.

        Parameters
        ----------
        length : float
            unit of the positions [m]
        height : float
            unit of the thickness [m]

        Returns
        -------
        InletLayer
            the dimensionless layer [-]
        """
        return InletLayer(
            thickness=tuple(h / height for h in self.thickness),
            y=tuple(position / length for position in self.y),
        )
