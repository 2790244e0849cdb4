"""Elastic rings with their displacement under all balls, as hexahedra, by meshio."""

from pathlib import Path

import meshio
import numpy as np

from bearing.files import atomic_path
from bearing.geometry import Race
from bearing.quasistatic.ring import ring_displacements
from ehl.arrays import Array
from ehl.units import MICROMETRE, MILLIMETRE

from ..bearing.results import BearingResults
from .hexahedra import hexahedra
from .vtk import groove_axial

DISPLACEMENT = "displacement [um]"
DISTANCE = "displacement, size [um]"
RADIAL = "displacement, radial [um]"


def ring_file(race: str) -> str:
    """Name of the file of a ring.

    Parameters
    ----------
    race : str
        "inner" or "outer".

    Returns
    -------
    str
        Name of the file.
    """
    return f"ring_deformed_{race}.vtu"


def ring_files(directory: Path) -> tuple[Path, ...]:
    """The files of deformed rings that a result folder holds, inner ring first.

    Parameters
    ----------
    directory : Path
        Folder of the results.

    Returns
    -------
    tuple[Path, ...]
        The files.
    """
    paths = (directory / ring_file(race.value) for race in Race)
    return tuple(path for path in paths if path.is_file())


def write_ring_deformed(results: BearingResults, directory: Path) -> tuple[Path, ...]:
    """Write ring_deformed_inner.vtu and ring_deformed_outer.vtu, of rings that are elastic bodies.

    Nodes of the undeformed ring [mm] in the bearing's frame, with the displacement [um] from its
    seat under all balls; what the ring moves as a whole is not in it.

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
    for race in Race:
        fields = ring_displacements(results.quasistatic, race)
        if fields:
            rows = [
                (field.points + groove_axial(results, race.value, row) * np.eye(3)[0])
                for row, field in enumerate(fields, 1)
            ]
            mesh = displacement_mesh(rows, [field.displacement for field in fields])
            with atomic_path(directory / ring_file(race.value)) as path:
                mesh.write(path)
            written.append(directory / ring_file(race.value))
    return tuple(written)


def displacement_mesh(points: list[Array], displacements: list[Array]) -> meshio.Mesh:
    """Rings of one or more rows as one mesh.

    Parameters
    ----------
    points : list[Array]
        Nodes of each row, shape (n, m, k, 3) [m].
    displacements : list[Array]
        Displacement at the nodes of each row, shape (n, m, k, 3) [m].

    Returns
    -------
    meshio.Mesh
        Mesh [mm] with displacements [um].
    """
    cells = []
    first = 0
    for place in points:
        count = place[..., 0].size
        numbers = first + np.arange(count).reshape(place.shape[:-1])
        if (place[0, 0, 0, 1:] ** 2).sum() > (place[0, 0, -1, 1:] ** 2).sum():
            numbers = numbers[:, :, ::-1]  # outwards, for a right-handed order
        cells.append(hexahedra(np.concatenate([numbers, numbers[:1]])))  # closed around
        first += count
    place = np.concatenate([part.reshape(-1, 3) for part in points])
    moved = np.concatenate([part.reshape(-1, 3) for part in displacements]) / MICROMETRE
    outward = place[:, 1:] / np.linalg.norm(place[:, 1:], axis=1, keepdims=True)
    data = {
        DISPLACEMENT: moved,
        DISTANCE: np.linalg.norm(moved, axis=1),
        RADIAL: (moved[:, 1:] * outward).sum(axis=1),
    }
    row = [np.full(len(part), number) for number, part in enumerate(cells, 1)]
    block = [("hexahedron", np.concatenate(cells))]
    return meshio.Mesh(place / MILLIMETRE, block, data, {"row": [np.concatenate(row)]})
