"""Stress in rings as finite bodies below their heaviest contacts, as hexahedra, by meshio."""

from pathlib import Path

import meshio
import numpy as np

from bearing.geometry import Race
from ehl.solid.bodies.ring import RingStress
from ehl.units import GIGAPASCAL, MILLIMETRE

from ..bearing.results import BearingResults
from .hexahedra import hexahedra

COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "xz")


def write_ring_stress(results: BearingResults, directory: Path) -> tuple[Path, ...]:
    """Write ring_stress_inner.vtu and ring_stress_outer.vtu, where finite bodies were computed.

    A box [mm] in the frame of the contact: x along the rolling direction, y across, z into the
    ring; stresses [GPa] of the ring, and of the half-space beside them.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.
    directory : Path
        Folder to write into.

    Returns
    -------
    tuple[Path, ...]
        The files.
    """
    written = []
    bodies = results.finite_bodies
    for race in Race:
        difference = None if bodies is None else bodies.at(race)
        if difference is not None:
            path = directory / f"ring_stress_{race.value}.vtu"
            stress_mesh(difference.ring_stress).write(path)
            written.append(path)
    return tuple(written)


def stress_mesh(stress: RingStress) -> meshio.Mesh:
    """The box as a mesh, nodes in the order x, y, z, the last the fastest.

    Parameters
    ----------
    stress : RingStress
        Stress of ring and half-space in a box.

    Returns
    -------
    meshio.Mesh
        Mesh [mm] with stresses [GPa].
    """
    ring, flat = stress.ring, stress.half_space
    grid = np.meshgrid(ring.x, ring.y, ring.depth, indexing="ij")
    points = np.stack([axis.ravel() for axis in grid], axis=1) / MILLIMETRE
    fields = {"von Mises [GPa]": ring.von_mises, "von Mises, half-space [GPa]": flat.von_mises}
    for name, body in (("", ring), (", half-space", flat)):
        for component, values in zip(COMPONENTS, body.stress, strict=True):
            fields[f"stress {component}{name} [GPa]"] = values
    data = {name: values.ravel() / GIGAPASCAL for name, values in fields.items()}
    number = np.arange(ring.von_mises.size).reshape(ring.von_mises.shape)
    return meshio.Mesh(points, [("hexahedron", hexahedra(number))], data)
