"""Fields and bodies for ParaView and pyvista: fields.pvd -> fields.vtm -> one block per ball and
race.

Only VTK's data and file modules are used, none that could open a window.
"""

from collections.abc import Iterator
from math import degrees
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLStructuredGridWriter

from bearing.contacts.contact import BearingContact
from ehl import ContactSolution
from ehl.solution import Array
from ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, ZERO_CELSIUS

from ..bearing.results import BearingResults
from ..contact.frame import principal_coordinates
from ..contact.results import ContactResults
from ..files import atomic_path, contact_name
from .geometry import (
    SET_BACK,
    Placement,
    Surface,
    ball_surface,
    bearing_lengths,
    contact_frame,
    crop_to_ball,
    merge,
    place_patch,
    ring_shape,
    ring_surface,
)
from .subsurface import StressVolume, stress_volume

COLLECTION_FILE = "fields.pvd"
STRESS_FILE = "subsurface.pvd"
BLOCK_FOLDER = "vtk"
AZIMUTH_FILE = "azimuth.pvd"
FILM = "film thickness [um]"
PRESSURE = "pressure [GPa]"
TEMPERATURE = "film temperature [degC]"
OPENING = np.pi  # sector cut out of the outer ring, about the most loaded ball [rad]


def write_collection(
    results: BearingResults | ContactResults,
    directory: Path,
    patch_magnification: tuple[float, float] = (1.0, 1.0),
    film_exaggeration: float = 0.0,
) -> Path:
    """Write the VTK collection of a run and return its .pvd file; lengths are in [mm], paths
    relative, so that the folder can be moved.

    Parameters
    ----------
    results : BearingResults or ContactResults
    directory : Path
        Result directory; the blocks go to its folder `vtk`.
    patch_magnification : tuple of float
        Patches are drawn this many times larger along and across the rolling direction [-].
    film_exaggeration : float
        Film drawn as height, times this [-].
    """
    blocks: dict[str, dict[str, str]] = {}
    if isinstance(results, ContactResults):
        grid = flat_patch(results.solution, film_exaggeration)
        blocks["contact"] = {"contact": _write(grid, directory, "contact.vts")}
    else:
        rolling, transverse = patch_magnification
        placement = Placement(rolling=rolling, transverse=transverse, film=film_exaggeration)
        ball_radius = 0.5 * results.quasistatic.bearing.ball_diameter
        for contact, solution, ball, race in _solved(results):
            grid = placed_patch(contact, solution, ball_radius, placement)
            blocks.setdefault(ball, {})[race] = _write(grid, directory, f"{ball}_{race}.vts")
        blocks["bodies"] = {
            name: _write(_body(surface), directory, f"{name.replace(' ', '_')}.vtp")
            for name, surface in bodies(results).items()
        }
        _write_azimuths(results, directory, blocks)
    return _write_collection(directory, COLLECTION_FILE, blocks)


def write_subsurface(results: BearingResults, directory: Path) -> Path | None:
    """Write the stress [GPa] in the races below the solved contacts, if the case asks for it, one
    volume [mm] each, and return the .pvd file.

    Stresses stand in the frame of the contact: x along the rolling direction, z into the race.
    """
    if not results.case.get("ehl", {}).get("subsurface_stress"):
        return None
    bearing = results.quasistatic.bearing
    ball_radius = 0.5 * bearing.ball_diameter
    blocks: dict[str, dict[str, str]] = {}
    for contact, solution, ball, race in _solved(results):
        ring = bearing.inner_ring_material if race == "inner" else bearing.outer_ring_material
        volume = stress_volume(contact, solution, ball_radius, ring.poisson_ratio)
        name = f"{ball}_{race}_stress.vts"
        blocks.setdefault(ball, {})[race] = _write(volume_grid(volume), directory, name)
    return _write_collection(directory, STRESS_FILE, blocks)


def _solved(results: BearingResults) -> Iterator[tuple[BearingContact, ContactSolution, str, str]]:
    """Contacts with a film: contact, solution, names of ball and race."""
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        if solution is not None:
            ball, race = contact_name(contact.ball, contact.race.value).split("/")
            yield contact, solution, ball, race


def volume_grid(volume: StressVolume) -> vtkStructuredGrid:
    """The stress below a contact, lengths in [mm], stresses in [GPa]."""
    grid = structured_grid(volume.points / MILLIMETRE)
    depth = np.broadcast_to(volume.depth, volume.maximum_shear.shape)
    stress = np.stack([part.ravel(order="F") for part in volume.stress], axis=1)
    add_point_data(grid, "largest shear [GPa]", volume.maximum_shear / GIGAPASCAL)
    add_point_data(grid, "von Mises stress [GPa]", volume.von_mises / GIGAPASCAL)
    add_point_data(grid, "depth [mm]", depth / MILLIMETRE)
    add_array(grid, "stress xx yy zz xy yz xz [GPa]", stress / GIGAPASCAL)
    grid.GetPointData().SetActiveScalars("largest shear [GPa]")
    add_field_data(grid, "coordinates", "mm")
    return grid


def placed_patch(
    contact: BearingContact, solution: ContactSolution, ball_radius: float, placement: Placement
) -> vtkStructuredGrid:
    """One contact on its ball of `ball_radius` [m], coordinates in [mm]."""
    long, wide, film = solution.x, solution.y, solution.film
    if long is None or wide is None or film is None:
        raise ValueError(
            "a contact given by Moes' groups has no lengths and cannot be placed in a bearing"
        )
    part = crop_to_ball(long, wide, ball_radius, placement)
    x, y = principal_coordinates(long[part[0]], wide[part[1]], solution.frame_angle)
    frame = contact_frame(contact, ball_radius)
    height = placement.film * film[part]
    grid = structured_grid(place_patch(x, y, frame, placement, height) / MILLIMETRE)
    add_point_data(grid, FILM, film[part] / MICROMETRE)
    add_point_data(grid, PRESSURE, solution.pressure[part] / GIGAPASCAL)
    if solution.state is not None and solution.state.temperature is not None:
        add_point_data(grid, TEMPERATURE, solution.state.temperature[part] - ZERO_CELSIUS)
    add_point_data(grid, "rolling [mm]", x / MILLIMETRE)
    add_point_data(grid, "transverse [mm]", y / MILLIMETRE)
    field_data = {
        "ball": float(contact.ball),
        "race": contact.race.value,
        "azimuth [deg]": degrees(contact.azimuth),
        "load [N]": contact.load,
        "central film [um]": (solution.film_central or 0.0) / MICROMETRE,
        "minimum film [um]": (solution.film_minimum or 0.0) / MICROMETRE,
        "coordinates": "mm",
        "patch magnification rolling [-]": placement.rolling,
        "patch magnification transverse [-]": placement.transverse,
        "film exaggeration [-]": placement.film,
    }
    for name, value in field_data.items():
        add_field_data(grid, name, value)
    return grid


def flat_patch(solution: ContactSolution, film_exaggeration: float) -> vtkStructuredGrid:
    """A single contact in its plane: coordinates in [mm], or in semi-axes a where no length is
    known.
    """
    unit = "a"
    a = 1.0
    film_name = "film thickness [a^2/Rx]"
    h = 1.0
    height = film_exaggeration
    pressure_name = "pressure [p_h]"
    p = 1.0
    if solution.semi_axis_x is not None:
        unit = "mm"
        a = solution.semi_axis_x / MILLIMETRE
    if solution.film_scale is not None:
        film_name = FILM
        h = solution.film_scale / MICROMETRE
        height = film_exaggeration * solution.film_scale / MILLIMETRE
    if solution.hertz_pressure > 0.0:
        pressure_name = PRESSURE
        p = solution.hertz_pressure / GIGAPASCAL
    x, y = principal_coordinates(solution.X, solution.Y, solution.frame_angle)
    grid = structured_grid(np.stack([a * x, a * y, height * solution.H], axis=-1))
    add_point_data(grid, film_name, h * solution.H)
    add_point_data(grid, pressure_name, p * solution.P)
    if solution.state is not None and solution.state.temperature is not None:
        add_point_data(grid, TEMPERATURE, solution.state.temperature - ZERO_CELSIUS)
    add_field_data(grid, "coordinates", unit)
    add_field_data(grid, "film exaggeration [-]", film_exaggeration)
    return grid


def bodies(results: BearingResults) -> dict[str, Surface]:
    """Balls and rings as surfaces [m], set back a little so that the patches are seen; the outer
    ring is cut open.
    """
    state = results.quasistatic
    bearing = state.bearing
    lengths = bearing_lengths(bearing)
    radius = (0.5 - SET_BACK) * bearing.ball_diameter
    centres = np.stack(
        [
            state.ball_axial,
            state.ball_radial * np.cos(state.azimuth),
            state.ball_radial * np.sin(state.azimuth),
        ],
        axis=1,
    )
    most_loaded = float(state.azimuth[int(np.argmax(state.outer_load))])
    surfaces = {"balls": merge([ball_surface(centre, radius) for centre in centres])}
    for race, opening in (("inner", 0.0), ("outer", OPENING)):
        shape = ring_shape(lengths, inner=race == "inner")
        rings = [
            ring_surface(shape, _groove_axial(results, race, row), (most_loaded, opening))
            for row in range(1, len(state.rows) + 1)
        ]
        surfaces[f"{race} ring"] = merge(rings)
    return surfaces


def _groove_axial(results: BearingResults, race: str, row: int) -> float:
    """Axial position of a race's groove centre [m]: from the contact point one groove radius back
    along the normal.
    """
    state = results.quasistatic
    bearing = state.bearing
    radius = bearing.inner_groove_radius if race == "inner" else bearing.outer_groove_radius
    positions = [
        c.origin[0] - radius * c.normal[0]
        for c in results.contacts
        if c.race.value == race and c.row == row and c.load > 0.0
    ]
    return float(np.mean(positions)) if positions else state.rows[row - 1].axial_position


def structured_grid(points: Array) -> vtkStructuredGrid:
    """Build a grid of points, shape (nx, ny, 3) or (nx, ny, nz, 3) [mm or a]."""
    corners = vtkPoints()
    columns = np.stack([points[..., k].ravel(order="F") for k in range(3)], axis=1)
    corners.SetData(numpy_to_vtk(columns.astype(np.float32), deep=True))
    grid = vtkStructuredGrid()
    grid.SetDimensions(*(*points.shape[:-1], 1)[:3])
    grid.SetPoints(corners)
    return grid


def add_array(data: Any, name: str, values: Array) -> None:
    """Add values at the points, shape (points,) or (points, components), as float32; the unit
    stands in the name, such as load [N].
    """
    array = numpy_to_vtk(values.astype(np.float32), deep=True)
    array.SetName(name)
    data.GetPointData().AddArray(array)


def add_point_data(grid: Any, name: str, values: Array) -> None:
    """Add a field on the nodes of a grid, in its shape, whose unit stands in its name, such as
    film [um].
    """
    add_array(grid, name, values.T.ravel())
    grid.GetPointData().SetActiveScalars(FILM)


def add_field_data(grid: Any, name: str, value: float | str) -> None:
    """Add one number or word about the whole block, its unit in the name, such as load [N]."""
    array: Any = vtkStringArray() if isinstance(value, str) else vtkDoubleArray()
    array.SetName(name)
    array.InsertNextValue(value)
    grid.GetFieldData().AddArray(array)


def poly_data(surface: Surface) -> vtkPolyData:
    """Turn a surface [m] into vtkPolyData, coordinates in [mm]."""
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk((surface.points / MILLIMETRE).astype(np.float32), deep=True))
    offsets = 4 * np.arange(len(surface.quads) + 1)
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_to_vtkIdTypeArray(surface.quads.ravel().copy(), deep=True),
    )
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def _body(surface: Surface) -> vtkPolyData:
    data = poly_data(surface)
    add_field_data(data, "coordinates", "mm")
    return data


def write_block(data: Any, path: Path) -> None:
    """Write a grid (.vts) or a surface (.vtp); the file appears when it is complete."""
    is_grid = isinstance(data, vtkStructuredGrid)
    writer: Any = vtkXMLStructuredGridWriter() if is_grid else vtkXMLPolyDataWriter()
    with atomic_path(path) as temporary:
        writer.SetFileName(str(temporary))
        writer.SetInputData(data)
        writer.SetCompressorTypeToZLib()
        if not writer.Write():
            raise OSError(f"{path} could not be written")


def write_text(path: Path, text: str) -> None:
    """Write a small file, which appears when it is complete."""
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _write(data: Any, directory: Path, name: str) -> str:
    write_block(data, directory / BLOCK_FOLDER / name)
    return name


def _write_collection(directory: Path, name: str, blocks: dict[str, dict[str, str]]) -> Path:
    """Write a collection of one step, and the groups of blocks that it shows."""
    groups = f"{BLOCK_FOLDER}/{Path(name).stem}.vtm"
    write_text(directory / groups, _multiblock(blocks))
    write_text(directory / name, collection_text({0.0: groups}))
    return directory / name


def _multiblock(blocks: dict[str, dict[str, str]]) -> str:
    """XML of a .vtm file: named groups of named files."""
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="vtkMultiBlockDataSet" version="1.0">',
        "<vtkMultiBlockDataSet>",
    ]
    for i, (group, files) in enumerate(blocks.items()):
        lines.append(f'<Block index="{i}" name={quoteattr(group)}>')
        lines += [
            f'<DataSet index="{j}" name={quoteattr(name)} file={quoteattr(file)}/>'
            for j, (name, file) in enumerate(files.items())
        ]
        lines.append("</Block>")
    return "\n".join([*lines, "</vtkMultiBlockDataSet>", "</VTKFile>", ""])


def collection_text(steps: dict[float, str]) -> str:
    """XML of a .pvd file: relative paths of the files that ParaView shows, by time [s] or by what
    else the steps are named after, such as an azimuth [deg].
    """
    sets = "".join(
        f'<DataSet timestep="{step!r}" group="" part="0" file={quoteattr(file)}/>\n'
        for step, file in sorted(steps.items())
    )
    head = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
    return f"{head}{sets}</Collection>\n</VTKFile>\n"


def _write_azimuths(
    results: BearingResults, directory: Path, blocks: dict[str, dict[str, str]]
) -> None:
    """A collection that goes around the bearing: the films at an azimuth [deg], with the bodies,
    are one step.
    """
    steps: dict[float, dict[str, dict[str, str]]] = {}
    for contact in results.contacts:
        ball = contact_name(contact.ball, contact.race.value).split("/")[0]
        if ball in blocks:
            azimuth = round(degrees(contact.azimuth) % 360.0, 6) % 360.0
            steps.setdefault(azimuth, {"bodies": blocks["bodies"]})[ball] = blocks[ball]
    files = {}
    for azimuth, groups in steps.items():
        first = next(name for name in groups if name != "bodies")
        files[azimuth] = f"{BLOCK_FOLDER}/azimuth_{first}.vtm"
        write_text(directory / files[azimuth], _multiblock(groups))
    if files:
        write_text(directory / AZIMUTH_FILE, collection_text(files))
