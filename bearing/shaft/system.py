"""A shaft with its bearings and loads, as data."""

from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from oilfilm.ehl.arrays import Array

from ..geometry import SINGLE, Bearing, Row
from ..operation import QuasistaticModel
from .beam import FREEDOMS, Beam, Section, stepped_beam


class AxialLocation(Enum):
    """Sides on which shoulders hold the outer ring of a support in its housing."""

    BOTH = "both"
    LEFT = "left"  # holds against motion to -x
    RIGHT = "right"  # holds against motion to +x
    NONE = "none"  # the ring floats


@dataclass(frozen=True, slots=True, kw_only=True)
class Support:
    """One bearing on the shaft."""

    position: float  # of its middle along the shaft [m]
    bearing: Bearing
    rows: tuple[Row, ...] = SINGLE
    temperature: float = 313.15  # [K]
    model: QuasistaticModel = field(default_factory=QuasistaticModel)
    location: AxialLocation = AxialLocation.BOTH
    # stiffness of its seat in the order x, y, z, tilt y, tilt z (5, 5) [N/m], [N], [N m]; rigid
    # where it is None
    seat_stiffness: Array | None = None
    growth: float = 0.0  # thermal, of the shaft less that of the housing, at its place [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class PointLoad:
    """Load and mass of a gear, pulley or disc."""

    position: float  # along the shaft [m]
    force: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [N]
    moment: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [N m]
    mass: float = 0.0  # [kg]
    polar_inertia: float = 0.0  # about the axis of the shaft [kg m^2]
    diametral_inertia: float = 0.0  # [kg m^2]
    unbalance: float = 0.0  # [kg m]
    unbalance_angle: float = 0.0  # from y towards z [rad]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftSystem:
    """Shaft, its bearings and its loads, SI; x along the shaft."""

    sections: tuple[Section, ...]
    supports: tuple[Support, ...]
    loads: tuple[PointLoad, ...]
    speed: float = 0.0  # about +x [rad/s]
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)  # acceleration [m/s^2]

    @property
    def stations(self) -> list[float]:
        """Places of bearings and loads [m]."""
        return [*(s.position for s in self.supports), *(load.position for load in self.loads)]

    def beam(self, longest: float | None = None) -> Beam:
        """Beam of the shaft with the masses of its loads.

        Parameters
        ----------
        longest : float, optional
            Longest element [m].

        Returns
        -------
        Beam
            Nodes and matrices.
        """
        beam = stepped_beam(self.sections, self.stations, longest)
        mass, gyroscopic, weight = beam.mass.copy(), beam.gyroscopic.copy(), beam.weight.copy()
        for load in self.loads:
            first = FREEDOMS * beam.node(load.position)
            inertia = (*[load.mass] * 3, load.polar_inertia, *[load.diametral_inertia] * 2)
            places = np.arange(first, first + FREEDOMS)
            mass[places, places] += inertia
            gyroscopic[first + 4, first + 5] += load.polar_inertia
            gyroscopic[first + 5, first + 4] -= load.polar_inertia
            weight[places[:3], np.arange(3)] += load.mass
        return replace(beam, mass=mass, gyroscopic=gyroscopic, weight=weight)

    def load_vector(self, beam: Beam) -> Array:
        """Forces and moments on the nodes: point loads and weight.

        Parameters
        ----------
        beam : Beam
            Of the shaft, with the masses of the loads.

        Returns
        -------
        Array
            Shape (6 nodes,) [N], [N m].
        """
        vector = beam.weight @ np.array(self.gravity)
        for load in self.loads:
            first = FREEDOMS * beam.node(load.position)
            vector[first : first + FREEDOMS] += (*load.force, *load.moment)
        return vector
