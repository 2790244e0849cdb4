"""The shown part of one contact, read back from disk, as grids for the scene."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import MICROMETRE, MILLIMETRE

from ..contact.shown_part import (
    ALL,
    film_range,
    principal_coordinates,
    refined,
    shown,
    shown_nodes,
)
from .geometry import Placement, contact_frame, crop_to_ball, place_patch
from .vtk import structured_grid

FINE = 81  # nodes of a patch each way at least, between those of the solution


@dataclass(frozen=True, slots=True, kw_only=True)
class Patch:
    """The shown part of one contact, read from disk; dimensionless in Moes input."""

    x: Array  # principal coordinates, shape (nx, ny) [mm], or in semi-axes a
    y: Array
    film: Array  # [um]
    pressure: Array  # [GPa]
    central: float  # film [um]
    minimum: float  # film [um]
    attributes: dict[str, Any]  # of the contact, as written

    @classmethod
    def read(cls, data: xarray.Dataset) -> "Patch":
        """Take the shown part of a contact's data set; lengths in [m] there.

        Parameters
        ----------
        data : xarray.Dataset
            Fields of a contact, SI.

        Returns
        -------
        Patch
            The part.
        """
        part = shown_nodes(data)

        def values(name: str, quantity: str) -> Any:
            return shown(quantity, data[name].attrs["units"], data[name].values)[0]

        nodes = values("x", "x")[part[0]], values("y", "x")[part[1]]
        x, y, film = refined(*nodes, values("h", "h")[part], FINE)
        pressure = refined(*nodes, values("P", "P")[part], FINE)[2]
        along, across = principal_coordinates(x, y, float(data.attrs["frame_angle"]))
        return cls(
            x=along,
            y=across,
            film=film,
            pressure=pressure,
            central=float(values("film_central", "h")),
            minimum=float(values("film_minimum", "h")),
            attributes=dict(data.attrs),
        )

    @property
    def film_range(self) -> tuple[float, float]:
        """Films at the ends of the colour scale [um]."""
        return film_range(self.central, self.smallest)

    @property
    def smallest(self) -> float:
        """Smallest film, of the mesh or extrapolated [um]."""
        least = float(np.nanmin(self.film))
        return min(least, self.minimum) if least > 0.0 else self.minimum

    def semi_axis(self, name: str) -> float:
        """Semi-axis of the Hertz ellipse along "x" or "y" [m].

        Parameters
        ----------
        name : str
            "x" or "y".

        Returns
        -------
        float
            Semi-axis [m].
        """
        return float(self.attributes[f"semi_axis_{name}"])

    def levels(self, quantity: str) -> list[float]:
        """Contour lines: shares of the central film [um], or of the largest pressure [GPa].

        Parameters
        ----------
        quantity : str
            "film" or "pressure".

        Returns
        -------
        list[float]
            Values [um] or [GPa].
        """
        if quantity == "film":
            return [self.central * share for share in (0.9, 0.95, 1.05, 1.1)]
        return [float(self.pressure.max()) * share for share in (0.1, 0.3, 0.5, 0.7, 0.9)]

    def mesh(self, ball_radius: float, placement: Placement) -> Any:
        """Patch on its ball.

        Parameters
        ----------
        ball_radius : float
            Radius of the ball [m].
        placement : Placement
            Magnification of patches and films.

        Returns
        -------
        Any
            Grid in [mm].
        """
        frame = contact_frame(self.attributes, ball_radius)
        x, y = self.x * MILLIMETRE, self.y * MILLIMETRE
        part = crop_to_ball(x[:, 0], y[0, :], ball_radius, placement)
        depth = np.maximum(self.film_range[1] - self.film[part], 0.0) * MICROMETRE
        points = place_patch(x[part], y[part], frame, placement, -placement.film * depth)
        return self._grid(points / MILLIMETRE, part)

    def relief(self, quantity: str, height: float) -> Any:
        """Contact plane with the quantity as height.

        Parameters
        ----------
        quantity : str
            "film" or "pressure".
        height : float
            Height at the end of the colour scale [mm or a].

        Returns
        -------
        Any
            Grid in [mm], or in semi-axes.
        """
        field = self.film if quantity == "film" else self.pressure
        top = self.film_range[1] if quantity == "film" else float(field.max())
        return self._grid(np.stack([self.x, self.y, height * field / top], axis=-1))

    def _grid(self, points: Array, part: tuple[slice, slice] = ALL) -> Any:
        return structured_grid(points, {"film": self.film[part], "pressure": self.pressure[part]})
