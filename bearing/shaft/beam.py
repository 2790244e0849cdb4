"""Stepped shaft as a beam of Timoshenko elements: bending with shear, tension, torsion.

Elements of two nodes with six degrees of freedom each, displacements along x, y, z and rotations
about them; x is the axis of the shaft. Their shape functions are the exact deflection under loads
at the nodes, so that the statics of a stepped shaft under point loads has no error of a mesh
(Przemieniecki, Theory of Matrix Structural Analysis, 1968, section 5.6). Mass and gyroscopic
matrix are consistent with them (Nelson, 1980).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, pi

import numpy as np

from oilfilm.ehl.arrays import Array

from ..material import Material

FREEDOMS = 6  # of a node: x, y, z, rotations about x, y, z
RING = np.array([0, 1, 2, 4, 5])  # of these, those of an inner ring: all but torsion
# place in an element's twelve of deflection and slope at both ends, and the sign of the slope:
# in the plane x-y the slope is +rotation about z, in the plane x-z -rotation about y
PLANES = ((np.array([1, 5, 7, 11]), 1.0), (np.array([2, 4, 8, 10]), -1.0))
GAUSS = 4  # points of quadrature: exact for the squares of cubic shape functions [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """Hollow cylinder, a piece of a shaft."""

    start: float  # place of its ends along the shaft [m]
    end: float  # [m]
    outside_diameter: float  # [m]
    inside_diameter: float  # zero where solid [m]
    material: Material

    @property
    def area(self) -> float:
        """Area of the cross section [m^2]."""
        return 0.25 * pi * (self.outside_diameter**2 - self.inside_diameter**2)

    @property
    def second_moment(self) -> float:
        """Second moment of the area about a diameter [m^4]."""
        return pi / 64.0 * (self.outside_diameter**4 - self.inside_diameter**4)

    @property
    def shear_modulus(self) -> float:
        """G = E/(2 (1 + nu)) [Pa]."""
        return self.material.youngs_modulus / (2.0 * (1.0 + self.material.poisson_ratio))

    @property
    def shear_coefficient(self) -> float:
        """Fraction of the area that carries shear [-], Cowper (1966), hollow circle."""
        nu = self.material.poisson_ratio
        m = self.inside_diameter / self.outside_diameter
        round_part = (1.0 + m**2) ** 2
        return (
            6.0
            * (1.0 + nu)
            * round_part
            / ((7.0 + 6.0 * nu) * round_part + (20.0 + 12.0 * nu) * m**2)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Beam:
    """Matrices of a stepped shaft, free in space."""

    positions: Array  # of the nodes along the shaft (n,) [m]
    stiffness: Array  # (6n, 6n) [N/m], [N], [N m]
    mass: Array  # (6n, 6n) [kg], [kg m], [kg m^2]
    gyroscopic: Array  # (6n, 6n) over the speed, times velocities a force; skew
    weight: Array  # (6n, 3) force and moment per acceleration along x, y, z [kg], [kg m]

    def node(self, position: float) -> int:
        """Number of the node at a position.

        Parameters
        ----------
        position : float
            Place along the shaft, one of those that the beam was made with [m].

        Returns
        -------
        int
            Number, from 0 [-].
        """
        return nearest_node(self.positions, position)


def nearest_node(positions: Array, position: float) -> int:
    """Number of the node at a position.

    Parameters
    ----------
    positions : Array
        Of the nodes along the shaft (n,) [m].
    position : float
        Place along the shaft [m].

    Returns
    -------
    int
        Number, from 0 [-].
    """
    return int(np.argmin(np.abs(positions - position)))


def stepped_beam(
    sections: Sequence[Section], stations: Sequence[float], longest: float | None = None
) -> Beam:
    """Beam of the sections of a shaft, with nodes at their ends and at stations.

    Parameters
    ----------
    sections : sequence of Section
        Pieces of the shaft, each beginning where the one before ends.
    stations : sequence of float
        Places of bearings and loads [m].
    longest : float, optional
        Longest element [m]; only vibration needs a limit.

    Returns
    -------
    Beam
        Nodes and matrices.

    Raises
    ------
    ValueError
        If a station lies outside the shaft.
    """
    first = sections[0].start
    last = sections[-1].end
    for place in stations:
        if not first <= place <= last:
            raise ValueError(
                f"a station at {place:g} m lies outside the shaft, {first:g} to {last:g} m"
            )
    places = {first, *(section.end for section in sections), *stations}
    positions = np.array(_refined(sorted(places), longest))
    size = FREEDOMS * positions.size
    stiffness, mass, gyroscopic = (np.zeros((size, size)) for _ in range(3))
    weight = np.zeros((size, 3))
    for k, (left, right) in enumerate(zip(positions[:-1], positions[1:], strict=True)):
        section = next(s for s in sections if 0.5 * (left + right) < s.end)
        element = slice(FREEDOMS * k, FREEDOMS * (k + 2))
        length = float(right - left)
        stiffness[element, element] += element_stiffness(section, length)
        inertia, turning = element_inertia(section, length)
        mass[element, element] += inertia
        gyroscopic[element, element] += turning
        weight[element] += inertia @ _translations()
    return Beam(
        positions=positions, stiffness=stiffness, mass=mass, gyroscopic=gyroscopic, weight=weight
    )


def _refined(places: list[float], longest: float | None) -> list[float]:
    """Places with others between them that are further apart than `longest` [m]."""
    if longest is None:
        return places
    refined = places[:1]
    for left, right in zip(places[:-1], places[1:], strict=True):
        pieces = max(1, ceil((right - left) / longest))
        refined += [left + (right - left) * k / pieces for k in range(1, pieces)]
        refined.append(right)  # exactly: a section ends here
    return refined


def _translations() -> Array:
    """Motion of an element's nodes as a rigid body along x, y, z, (12, 3) [-]."""
    return np.vstack([np.eye(FREEDOMS, 3)] * 2)


def shear_flexibility(section: Section, length: float) -> float:
    """Ratio of the deflections by shear and by bending, Phi = 12 E I/(kappa G A L^2).

    Parameters
    ----------
    section : Section
        Cross section and material.
    length : float
        Of the element [m].

    Returns
    -------
    float
        Ratio [-].
    """
    material = section.material
    shear = section.shear_coefficient * section.shear_modulus * section.area * length**2
    return 12.0 * material.youngs_modulus * section.second_moment / shear


def element_stiffness(section: Section, length: float) -> Array:
    """Stiffness of one element.

    Parameters
    ----------
    section : Section
        Cross section and material.
    length : float
        Of the element [m].

    Returns
    -------
    Array
        Shape (12, 12) [N/m], [N], [N m].
    """
    material = section.material
    phi = shear_flexibility(section, length)
    matrix = np.zeros((2 * FREEDOMS, 2 * FREEDOMS))
    # 1. bending with shear, in both planes
    l = length
    bending = np.array(
        [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, (4.0 + phi) * l**2, -6.0 * l, (2.0 - phi) * l**2],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, (2.0 - phi) * l**2, -6.0 * l, (4.0 + phi) * l**2],
        ]
    ) * (material.youngs_modulus * section.second_moment / (l**3 * (1.0 + phi)))
    for places, sign in PLANES:
        signs = np.array([1.0, sign, 1.0, sign])
        matrix[np.ix_(places, places)] += bending * np.outer(signs, signs)
    # 2. tension and torsion
    pair = np.array([[1.0, -1.0], [-1.0, 1.0]])
    axial = material.youngs_modulus * section.area / length
    torsional = section.shear_modulus * 2.0 * section.second_moment / length
    for first, value in ((0, axial), (3, torsional)):
        places = np.array([first, first + FREEDOMS])
        matrix[np.ix_(places, places)] += value * pair
    return matrix


def element_inertia(section: Section, length: float) -> tuple[Array, Array]:
    """Mass matrix of one element with rotatory inertia, and its gyroscopic matrix over the speed.

    Parameters
    ----------
    section : Section
        Cross section and material.
    length : float
        Of the element [m].

    Returns
    -------
    mass
        Shape (12, 12) [kg], [kg m], [kg m^2].
    gyroscopic
        Shape (12, 12), skew [kg], [kg m], [kg m^2].
    """
    density = section.material.density
    phi = shear_flexibility(section, length)
    points, weights = np.polynomial.legendre.leggauss(GAUSS)
    mass = np.zeros((2 * FREEDOMS, 2 * FREEDOMS))
    gyroscopic = np.zeros_like(mass)
    for point, weight in zip(0.5 * (points + 1.0), 0.5 * length * weights, strict=True):
        deflection, slope = _shapes(point, length, phi)
        rotation = np.zeros((2, 2 * FREEDOMS))  # about z, about y
        for row, (places, sign) in enumerate(PLANES):
            signs = np.array([1.0, sign, 1.0, sign])
            moved = np.zeros(2 * FREEDOMS)
            moved[places] = deflection * signs
            rotation[row, places] = sign * slope * signs
            mass += weight * density * section.area * np.outer(moved, moved)
        linear = np.array([1.0 - point, point])
        for first, inertia in ((0, section.area), (3, 2.0 * section.second_moment)):
            along = np.zeros(2 * FREEDOMS)
            along[[first, first + FREEDOMS]] = linear
            mass += weight * density * inertia * np.outer(along, along)
        diametral = weight * density * section.second_moment
        mass += diametral * rotation.T @ rotation
        about_z, about_y = rotation
        gyroscopic += 2.0 * diametral * (np.outer(about_y, about_z) - np.outer(about_z, about_y))
    return mass, gyroscopic


def _shapes(s: float, length: float, phi: float) -> tuple[Array, Array]:
    """Deflection and slope at s = x/L by deflection and slope of both ends, (4,) each."""
    l = length
    deflection = np.array(
        [
            1.0 - 3.0 * s**2 + 2.0 * s**3 + phi * (1.0 - s),
            l * (s - 2.0 * s**2 + s**3 + 0.5 * phi * (s - s**2)),
            3.0 * s**2 - 2.0 * s**3 + phi * s,
            l * (-(s**2) + s**3 - 0.5 * phi * (s - s**2)),
        ]
    )
    slope = np.array(
        [
            6.0 / l * (s**2 - s),
            1.0 - 4.0 * s + 3.0 * s**2 + phi * (1.0 - s),
            6.0 / l * (s - s**2),
            -2.0 * s + 3.0 * s**2 + phi * s,
        ]
    )
    return deflection / (1.0 + phi), slope / (1.0 + phi)
