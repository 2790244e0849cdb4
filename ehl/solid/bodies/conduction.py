r"""Heat from the track of a ring to its seat, and the stress that it makes, by finite elements.

.. math:: \int \nabla T \cdot \nabla v\, r\, dA = \int q\, v\, r\, ds, \qquad
          T = 0 \text{ on the seat}

.. math:: \int \sigma : \varepsilon(v)\, r\, dA = 0, \qquad
          \sigma = \lambda\, \mathrm{tr}(\varepsilon) + 2 \mu\, \varepsilon
                   - \frac{E \alpha T}{1 - 2 \nu}

on half the section of the ring, alike on both sides and around its axis: heat of circulating balls
enters a band of the track evenly, the rest is insulated, and nothing holds the ring but its
symmetry. Quadratic quadrilaterals; temperatures are per kelvin of the band's mean, stresses per E
alpha of it.
"""

from dataclasses import dataclass
from functools import cache
from math import pi

import numpy as np
from skfem import (
    Basis,
    BilinearForm,
    ElementQuad2,
    ElementVector,
    FacetBasis,
    LinearForm,
    MeshQuad,
    MeshQuad2,
    condense,
    solve,
)
from skfem.helpers import dot, grad

from ...arrays import Array
from .ring_profile import RingCells, RingProfile, section_points

# halved cells change the conductance of a 6208 inner ring by 1e-3, its largest tension by 3e-3
CELLS = RingCells(groove=24, land=4)
DEPTH = 12  # cells from track to seat [-]
SAME = 1e-9  # places closer than this count as one, relative to the width [-]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeatedRing:
    """Half the section of a ring that takes heat at its track and gives it off at its seat."""

    mesh: MeshQuad2  # coordinates: along the axis from the middle, radius [m]
    temperature: Array  # of the nodes over the mean of the heated band, seat at zero [-]
    conductance: float  # of the whole ring from band to seat, over its conductivity [m]

    @property
    def radius(self) -> Array:
        """Radius of the nodes, shape (n,) [m]."""
        return np.asarray(self.mesh.doflocs[1])


@cache
def heated_ring(
    profile: RingProfile, track_half_width: float, cells: RingCells = CELLS
) -> HeatedRing:
    """Temperature of a ring whose track is heated.

    Parameters
    ----------
    profile : RingProfile
        section of the ring, without shaft or housing
    track_half_width : float
        arc length from the bottom of the groove to which the balls heat it [m]
    cells : RingCells, default CELLS
        sizes of the cells

    Returns
    -------
    HeatedRing
        temperatures and conductance

    Raises
    ------
    ValueError
        if the band is wider than the groove, or the profile has a shaft or housing
    """
    if not 0.0 < track_half_width < profile.edge:
        raise ValueError(f"track_half_width must lie between 0 and {profile.edge:.6g} m")
    if profile.body_radius is not None:
        raise ValueError("body_radius must be None: the conductances of the ring alone")
    half = max(2, cells.groove // 2)
    inside = max(1, round(half * track_half_width / profile.edge))
    lines = np.concatenate(
        [
            np.linspace(0.0, track_half_width, inside + 1),
            np.linspace(track_half_width, profile.edge, half - inside + 2)[1:],
            np.linspace(profile.edge, profile.arc, cells.land + 1)[1:],
        ]
    )
    box = MeshQuad2.from_mesh(MeshQuad.init_tensor(lines, np.linspace(0.0, 1.0, DEPTH + 1)))
    arc, depth = np.array(box.doflocs)
    mesh = MeshQuad2(np.ascontiguousarray(section_points(profile, arc, depth)), box.t)
    if np.ptp(np.sign(mesh.mapping().detDF(np.full((2, 1), 0.5)))) > 0.0:
        raise ValueError("cells of the mesh are turned inside out: profile too flat or thin")
    corners = (depth == 0.0) & (arc <= track_half_width * (1.0 + 1e-9))
    return section_heated(mesh, corners, depth == 1.0)


def section_heated(mesh: MeshQuad2, heated: Array, seat: Array) -> HeatedRing:
    """Temperature of a section that takes heat on some nodes of its surface.

    Parameters
    ----------
    mesh : MeshQuad2
        half the section: along the axis from the middle, radius [m]
    heated, seat : Array
        nodes that take the heat and those at zero, shape (n,) of bool

    Returns
    -------
    HeatedRing
        temperatures and conductance
    """
    basis = Basis(mesh, ElementQuad2())
    facets = np.flatnonzero(heated[mesh.facets].all(axis=0))
    flux = _even.assemble(FacetBasis(mesh, ElementQuad2(), facets=facets))
    heat = 2.0 * pi * flux.sum()
    matrix = _conduction.assemble(basis)
    temperature = solve(*condense(matrix, flux, D=np.flatnonzero(seat)))
    mean = float(flux @ temperature / flux.sum())
    # half the section: twice the heat
    whole = float(2.0 * heat / mean)
    return HeatedRing(mesh=mesh, temperature=temperature / mean, conductance=whole)


@cache
def thermal_hoop(ring: HeatedRing, poisson: float) -> Array:
    """Hoop stress of a heated ring that nothing holds, tension positive.

    Parameters
    ----------
    ring : HeatedRing
        temperatures
    poisson : float
        nu [-]

    Returns
    -------
    Array
        of the nodes, over E alpha times the rise of the heated band over the seat, shape (n,) [-]
    """
    scalar = Basis(ring.mesh, ElementQuad2())
    basis = scalar.with_element(ElementVector(ElementQuad2()))
    constants = {"lame": poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), "nu": poisson}
    warm = scalar.interpolate(ring.temperature)
    matrix = _elasticity.assemble(basis, **constants)
    load = _expansion.assemble(basis, warm=warm, **constants)
    middle = 2 * np.flatnonzero(ring.mesh.doflocs[0] < SAME * np.ptp(ring.mesh.doflocs[0]))
    moved = basis.interpolate(solve(*condense(matrix, load, D=middle)))
    strain = _trace(moved, moved.grad, scalar.global_coordinates()[1])
    around = moved[1] / scalar.global_coordinates()[1]
    hoop = constants["lame"] * strain + around / (1.0 + poisson) - warm / (1.0 - 2.0 * poisson)
    return np.asarray(scalar.project(hoop))


def _trace(u, slope, r):  # type: ignore[no-untyped-def]
    """Sum of the strains along the axis, the radius and around [-]."""
    return slope[0, 0] + slope[1, 1] + u[1] / r


@LinearForm
def _even(v, w):  # type: ignore[no-untyped-def]
    return v * w.x[1]


@BilinearForm
def _conduction(T, v, w):  # type: ignore[no-untyped-def]
    return dot(grad(T), grad(v)) * w.x[1]


@BilinearForm
def _elasticity(u, v, w):  # type: ignore[no-untyped-def]
    r = w.x[1]
    du = grad(u)
    dv = grad(v)
    shear = 0.5 * (du[0, 1] + du[1, 0]) * (dv[0, 1] + dv[1, 0])
    normal = du[0, 0] * dv[0, 0] + du[1, 1] * dv[1, 1] + u[1] * v[1] / r**2
    volume = w.lame * _trace(u, du, r) * _trace(v, dv, r)
    return (volume + (normal + shear) / (1.0 + w.nu)) * r


@LinearForm
def _expansion(v, w):  # type: ignore[no-untyped-def]
    return w.warm * _trace(v, grad(v), w.x[1]) * w.x[1] / (1.0 - 2.0 * w.nu)
