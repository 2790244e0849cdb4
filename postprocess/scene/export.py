"""Meshes for other programs, written by meshio: films on their patches, elements of a coating,
elastic rings with their displacement.
"""

import os
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import meshio
import numpy as np
import xarray
from numpy.typing import NDArray

from oilfilm.bearing.files import require_room
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.conditions import Coating
from oilfilm.ehl.solid.layered import layered_mesh
from oilfilm.ehl.units import GIGAPASCAL, MILLIMETRE

from ..contact.shown_part import ALL, principal_coordinates, shown
from ..files import write_csv
from ..open_results import film_maps, open_results, require_contacts
from .geometry import Placement, contact_frame, crop_to_ball, grid_quads, place_patch
from .vtk import ring_files

TITLES = {"P": "pressure", "h": "film thickness", "T": "film temperature"}
RACES = ("inner", "outer")
# quadrilaterals of Abaqus
SHELL = "S4"
AXISYMMETRIC = "CAX4"
ABAQUS_QUAD = "CAX4P"  # what meshio writes for any of them
HDF5_OVERHEAD = 2**18  # of a file beside its numbers, at most [bytes]


@dataclass(frozen=True, slots=True, kw_only=True)
class PatchMesh:
    """Quadrilaterals with values at their nodes and cells; lengths and units in the names."""

    points: Array  # shape (nodes, 3) [mm or a]
    quads: NDArray[np.int64]  # corner numbers, shape (cells, 4)
    fields: dict[str, Array]  # at the nodes
    cells: dict[str, Array]  # at the cells
    groups: dict[str, NDArray[np.int64]]  # numbers of cells by the name of their group
    abaqus: str = SHELL


def export_results(
    directory: str | Path, file: str | Path, coating: Coating | None = None
) -> tuple[Path, ...]:
    """Write the fields of a result directory as meshes, and beside them the elements of a coating.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    file : str | Path
        Mesh file, whose suffix names its format, one of `WRITERS`.
    coating : Coating | None, optional
        Coating whose elements are written, too.

    Returns
    -------
    tuple[Path, ...]
        The meshes, then the files of values that belong to them.

    Raises
    ------
    ValueError
        Without films or elastic rings, or for another format.
    """
    path = Path(file)
    extension = path.suffix.lower().removeprefix(".")
    if extension not in WRITERS:
        allowed = ", ".join(WRITERS)
        raise ValueError(f"{path.name}: unknown mesh format {extension!r}; allowed: {allowed}")
    write = WRITERS[extension]
    rings = ring_files(Path(directory)) if write is _write_fields else ()
    meshes: dict[str, Callable[[Path], None]] = {}
    films = contact_meshes(directory, needed=not rings)
    if films is not None:
        meshes[path.name] = partial(write, films)
    if coating is not None:
        meshes[f"{path.stem}_coating{path.suffix}"] = partial(write, coating_mesh(coating))
    for ring in rings:
        meshes[f"{path.stem}_{ring.stem}{path.suffix}"] = partial(_write, meshio.read(ring))
    path.parent.mkdir(parents=True, exist_ok=True)
    # files of one mesh name each other: they are written under their names elsewhere, and moved
    with tempfile.TemporaryDirectory(".partial", f".{path.name}-", path.parent) as folder:
        for name, write_mesh in meshes.items():
            write_mesh(Path(folder) / name)
        others = sorted({part.name for part in Path(folder).iterdir()} - meshes.keys())
        for name in (*others, *reversed(meshes)):
            os.replace(Path(folder) / name, path.with_name(name))
    return tuple(path.with_name(name) for name in (*meshes, *others))


def contact_meshes(directory: str | Path, *, needed: bool = True) -> PatchMesh | None:
    """All contacts with a film as one mesh, on their balls [mm]; a single contact in its plane.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    needed : bool, default True
        Refuse results without films.

    Returns
    -------
    PatchMesh | None
        The mesh; None without films.

    Raises
    ------
    ValueError
        Without films, if they are needed.
    """
    with open_results(directory) as tree:
        require_contacts(directory, tree, "films to export")
        leaves = film_maps(tree)
        films = {name: leaf.to_dataset(inherit=False).load() for name, leaf in leaves.items()}
        if not films and needed:
            raise ValueError(f"{directory} holds no film maps")
        diameter = tree["ring"].attrs["ball_diameter"] if "ring" in tree.children else 0.0
    meshes = [patch_mesh(name, data, 0.5 * diameter) for name, data in films.items()]
    return merged(meshes) if meshes else None


def patch_mesh(contact: str, data: xarray.Dataset, ball_radius: float) -> PatchMesh:
    """One contact as cells between the nodes of its grid, on its ball.

    Parameters
    ----------
    contact : str
        Name of the contact.
    data : xarray.Dataset
        Fields of the contact.
    ball_radius : float
        Radius of the ball [m].

    Returns
    -------
    PatchMesh
        The mesh.
    """
    attributes = data.attrs
    x, y = data["x"].values, data["y"].values
    is_placed = "origin" in attributes
    part = crop_to_ball(x, y, ball_radius, Placement()) if is_placed else ALL
    angle = float(attributes["frame_angle"])
    along, across = principal_coordinates(x[part[0]], y[part[1]], angle)
    points = np.stack([along, across, np.zeros_like(along)], axis=-1)
    if is_placed:
        points = place_patch(along, across, contact_frame(attributes, ball_radius), Placement())
    columns = [("rolling", "x", along), ("transverse", "x", across)]
    for name, title in TITLES.items():
        if name in data:
            columns.append((title, name, data[name].values[part].astype(np.float64)))
    fields = {}
    for title, name, values in columns:
        values, unit = shown(name, data[name].attrs["units"], values)
        fields[f"{title} [{unit}]"] = values.ravel()
    quads = grid_quads(*along.shape)
    cells = {}
    if is_placed:
        cells["ball"] = np.full(len(quads), int(attributes["ball"]))
        cells["race, 1 inner, 2 outer"] = np.full(len(quads), 1 + RACES.index(attributes["race"]))
    return PatchMesh(
        points=shown("x", data["x"].attrs["units"], points.reshape(-1, 3))[0],
        quads=quads,
        fields=fields,
        cells=cells,
        groups={contact: np.arange(len(quads))},
    )


def merged(meshes: Sequence[PatchMesh]) -> PatchMesh:
    """One mesh of several; NaN where one lacks a field, such as a temperature.

    Parameters
    ----------
    meshes : Sequence[PatchMesh]
        Meshes with the same fields of cells.

    Returns
    -------
    PatchMesh
        The mesh.
    """
    nodes = np.cumsum([0] + [len(mesh.points) for mesh in meshes])
    cells = np.cumsum([0] + [len(mesh.quads) for mesh in meshes])
    fields = {}
    for title in dict.fromkeys(title for mesh in meshes for title in mesh.fields):
        parts = [m.fields.get(title, np.full(len(m.points), np.nan)) for m in meshes]
        fields[title] = np.concatenate(parts)
    return PatchMesh(
        points=np.concatenate([mesh.points for mesh in meshes]),
        quads=np.concatenate([m.quads + n for m, n in zip(meshes, nodes[:-1], strict=True)]),
        fields=fields,
        cells={key: np.concatenate([m.cells[key] for m in meshes]) for key in meshes[0].cells},
        groups={
            name: numbers + first
            for mesh, first in zip(meshes, cells[:-1], strict=True)
            for name, numbers in mesh.groups.items()
        },
    )


def coating_mesh(coating: Coating) -> PatchMesh:
    """The axisymmetric elements for a coated body: radius as x, and -depth as y [mm].

    Parameters
    ----------
    coating : Coating
        Coating on a half-space.

    Returns
    -------
    PatchMesh
        The mesh.
    """
    nodes, quads, in_coating = layered_mesh()
    r, z = nodes.T * coating.thickness / MILLIMETRE
    young = (coating.youngs_modulus, coating.substrate_youngs_modulus)
    poisson = (coating.poisson_ratio, coating.substrate_poisson_ratio)
    return PatchMesh(
        points=np.stack([r, -z, np.zeros_like(r)], axis=1),
        quads=quads,  # counter-clockwise, as y points up
        fields={},
        cells={
            "Young's modulus [GPa]": np.where(in_coating, *young) / GIGAPASCAL,
            "Poisson's ratio [-]": np.where(in_coating, *poisson),
        },
        groups={"coating": np.flatnonzero(in_coating), "substrate": np.flatnonzero(~in_coating)},
        abaqus=AXISYMMETRIC,
    )


def _group_numbers(mesh: PatchMesh) -> NDArray[np.int32]:
    """Number of the group of each cell, from 1."""
    numbers = np.zeros(len(mesh.quads), dtype=np.int32)
    for number, cells in enumerate(mesh.groups.values(), start=1):
        numbers[cells] = number
    return numbers


def _mesh(mesh: PatchMesh, groups: tuple[str, ...]) -> meshio.Mesh:
    """The mesh with all its fields; the numbers of groups under the names that a format has."""
    cells = dict.fromkeys(groups, _group_numbers(mesh)) | mesh.cells
    cell_data = {name: [values] for name, values in cells.items()}
    return meshio.Mesh(mesh.points, [("quad", mesh.quads)], mesh.fields, cell_data)


def _write_fields(mesh: PatchMesh, path: Path) -> None:
    """VTU, and XDMF with its numbers in an HDF5 file beside it."""
    _write(_mesh(mesh, ("group",)), path)


def _write(mesh: meshio.Mesh, path: Path) -> None:
    """By meshio; HDF5, which XDMF needs, ends the program where the disk is full."""
    if path.suffix.lower() == ".xdmf":
        values = [block for blocks in mesh.cell_data.values() for block in blocks]
        corners = [block.data for block in mesh.cells]
        arrays = [mesh.points, *corners, *mesh.point_data.values(), *values]
        require_room(path.parent, HDF5_OVERHEAD + sum(array.nbytes for array in arrays))
    mesh.write(path)


def _write_msh(mesh: PatchMesh, path: Path) -> None:
    """Gmsh 2.2, binary: groups of cells are physical surfaces."""
    gmsh = _mesh(mesh, ("gmsh:physical", "gmsh:geometrical"))
    gmsh.field_data = {name: np.array([k, 2]) for k, name in enumerate(mesh.groups, start=1)}
    gmsh.write(path, file_format="gmsh22")


def _write_inp(mesh: PatchMesh, path: Path) -> None:
    """Abaqus: nodes, elements and sets; a table by node numbers has the fields."""
    sets = {name.replace("/", "_").upper(): [cells] for name, cells in mesh.groups.items()}
    meshio.Mesh(mesh.points, [("quad", mesh.quads)], cell_sets=sets).write(path)
    text = path.read_text(encoding="utf-8").replace(f"={ABAQUS_QUAD}\n", f"={mesh.abaqus}\n", 1)
    path.write_text(text, encoding="utf-8")
    if mesh.fields:
        columns = [values.tolist() for values in mesh.fields.values()]
        rows = zip(range(1, len(mesh.points) + 1), *columns, strict=True)
        write_csv(path.with_name(f"{path.stem}_fields.csv"), ["node", *mesh.fields], rows)


WRITERS: dict[str, Callable[[PatchMesh, Path], None]] = {
    "xdmf": _write_fields,
    "inp": _write_inp,
    "msh": _write_msh,
    "vtu": _write_fields,
}
