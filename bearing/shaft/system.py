"""A shaft with its bearings and loads, as data."""

from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import ZERO_CELSIUS

from ..geometry import SINGLE, Bearing, Row
from ..operation import QuasistaticModel
from .beam import FREEDOMS, Beam, Section, stepped_beam

REFERENCE_TEMPERATURE = ZERO_CELSIUS + 20.0  # of lengths without thermal growth [K]


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
    growth: float = 0.0  # thermal, of the shaft less that of the housing, at its place [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Spring:
    """A bearing that is not computed, as a linear spring to the ground."""

    name: str
    position: float  # along the shaft [m]
    radial_stiffness: float  # along y and z [N/m]
    axial_stiffness: float = 0.0  # [N/m]
    tilting_stiffness: float = 0.0  # against rotation about y and z [N m/rad]

    @property
    def stiffness(self) -> Array:
        """On the six freedoms of a node (6,) [N/m], [N m/rad]."""
        radial, tilting = self.radial_stiffness, self.tilting_stiffness
        return np.array([self.axial_stiffness, radial, radial, 0.0, tilting, tilting])


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
    springs: tuple[Spring, ...] = ()
    speed: float = 0.0  # about +x [rad/s]
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)  # acceleration [m/s^2]
    # stiffness of the housing at the seats, condensed on x, y, z, tilt y, tilt z of each support,
    # symmetric (5 supports, 5 supports) [N/m], [N], [N m]; None: rigid
    housing: Array | None = None
    housing_expansion: float = 0.0  # thermal [1/K]
    # heat along the housing from bearing to bearing [W/K]; None: an estimate
    housing_conductance: float | None = None

    @property
    def stations(self) -> list[float]:
        """Places of bearings, springs and loads [m]."""
        springs = [spring.position for spring in self.springs]
        loads = [load.position for load in self.loads]
        return [*(support.position for support in self.supports), *springs, *loads]

    def beam(self, longest: float | None = None) -> Beam:
        """Beam of the shaft with its springs and the masses of its loads.

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
        stiffness = beam.stiffness + self.spring_stiffness(beam)
        for load in self.loads:
            first = FREEDOMS * beam.node(load.position)
            inertia = (*[load.mass] * 3, load.polar_inertia, *[load.diametral_inertia] * 2)
            places = np.arange(first, first + FREEDOMS)
            mass[places, places] += inertia
            gyroscopic[first + 4, first + 5] += load.polar_inertia
            gyroscopic[first + 5, first + 4] -= load.polar_inertia
            weight[places[:3], np.arange(3)] += load.mass
        return replace(beam, stiffness=stiffness, mass=mass, gyroscopic=gyroscopic, weight=weight)

    def spring_stiffness(self, beam: Beam) -> Array:
        """Stiffness of the springs on the nodes.

        Parameters
        ----------
        beam : Beam
            Of the shaft.

        Returns
        -------
        Array
            Shape (6 nodes, 6 nodes) [N/m], [N m/rad].
        """
        diagonal = np.zeros((beam.positions.size, FREEDOMS))
        for spring in self.springs:
            diagonal[beam.node(spring.position)] += spring.stiffness
        return np.diag(diagonal.ravel())

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

    def thermal_resistance(self, places: Array) -> Array:
        """Resistance of the shaft to heat from its left end to places, sum of l/(k A).

        Parameters
        ----------
        places : Array
            Along the shaft (n,) [m].

        Returns
        -------
        Array
            Shape (n,) [K/W].

        Raises
        ------
        ValueError
            If the conductivity of a section is not known.
        """
        total = np.zeros(places.size)
        for section in self.sections:
            k = section.material.thermal_conductivity
            if k is None:
                name = section.material.name
                raise ValueError(f"materials.{name}: thermal_conductivity_W_m_K is needed")
            inside = np.clip(places - section.start, 0.0, section.end - section.start)
            total += inside / (k * section.area)
        return total

    def axial_growth(self, shaft: float | Array, housing: float | Array) -> Array:
        """Growth of the shaft less that of the housing from the left end to each bearing.

        Between bearings the temperature of the shaft is linear over its resistance to heat, that
        of the housing over its length; beyond the last bearing it stays.

        Parameters
        ----------
        shaft, housing : float or Array
            Temperatures at the bearings, or one of all (supports,) [K].

        Returns
        -------
        Array
            Shape (supports,) [m].
        """
        places = np.array([support.position for support in self.supports])
        marks = np.unique([0.0, *places, *(section.end for section in self.sections)])
        middle = 0.5 * (marks[1:] + marks[:-1])
        steel = np.array([self._section(x).material.thermal_expansion or 0.0 for x in middle])
        mean = []
        for temperature, over in ((shaft, self.thermal_resistance), (housing, np.asarray)):
            rise = np.broadcast_to(temperature, places.shape) - REFERENCE_TEMPERATURE
            if np.ptp(rise) > 0.0:
                order = np.argsort(places)
                ends = np.interp(over(marks), over(places)[order], rise[order])
                mean.append(0.5 * (ends[1:] + ends[:-1]))
            else:  # one temperature needs no conductivity
                mean.append(np.full(middle.size, rise[0]))
        growth = (steel * mean[0] - self.housing_expansion * mean[1]) * np.diff(marks)
        return np.interp(places, marks, np.concatenate([[0.0], np.cumsum(growth)]))

    def _section(self, place: float) -> Section:
        return next(section for section in self.sections if place < section.end)
