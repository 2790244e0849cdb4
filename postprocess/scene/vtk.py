"""Fields and bodies for ParaView and pyvista: fields.pvd -> fields.vtm -> one block per ball and
race.

Only VTK's data and file modules are used, none that could open a window.
"""

from math import degrees
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLStructuredGridWriter

from bearing.contacts.contacts import BearingContact
from ehl import ContactSolution
from ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, ZERO_CELSIUS

from ..contact.frame import principal_coordinates
from ..files import atomic_path, contact_name
from ..results import BearingResults, ContactResults
from .geometry import (
    SET_BACK,
    ContactFrame,
    Placement,
    Surface,
    ball_surface,
    crop_to_ball,
    merge,
    place_patch,
    ring_surface,
)
from .subsurface import StressVolume, stress_volume

Array = NDArray[np.float64]

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
    patch_magnification: float | tuple[float, float] = 1.0,
    film_exaggeration: float = 0.0,
) -> Path:
    """Write the VTK collection of a run; paths inside are relative, so that the folder can be
    moved.

    Parameters
    ----------
    results : BearingResults or ContactResults
    directory : Path
        Result directory; the blocks go to its folder `vtk`.
    patch_magnification : float or tuple of float
        Patches are drawn this many times larger on their ball, or (along, across) the rolling
        direction [-].
    film_exaggeration : float
        Film drawn as height, times this [-].

    Returns
    -------
    Path
        The .pvd file. Lengths in it are in [mm], the factors are field data of each patch.
    """
    both = (
        patch_magnification
        if isinstance(patch_magnification, tuple)
        else (patch_magnification,) * 2
    )
    placement = Placement(rolling=both[0], transverse=both[1], film=film_exaggeration)
    blocks: dict[str, dict[str, str]] = {}
    if isinstance(results, ContactResults):
        grid = flat_patch(results.solution, film_exaggeration)
        blocks["contact"] = {"contact": _write_grid(grid, directory, "contact")}
    else:
        ball_radius = 0.5 * results.quasistatic.bearing.ball_diameter
        for contact, solution in zip(results.contacts, results.solutions, strict=True):
            if solution is not None:
                grid = placed_patch(contact, solution, ball_radius, placement)
                ball, race = contact_name(contact.ball, contact.race.value).split("/")
                blocks.setdefault(ball, {})[race] = _write_grid(grid, directory, f"{ball}_{race}")
        blocks["bodies"] = {
            name: _write_body(surface, directory, name.replace(" ", "_"))
            for name, surface in bodies(results).items()
        }
        _write_azimuths(results, directory, blocks)
    _write_text(directory / BLOCK_FOLDER / "fields.vtm", _multiblock(blocks))
    collection = directory / COLLECTION_FILE
    _write_text(collection, collection_text({0.0: f"{BLOCK_FOLDER}/fields.vtm"}))
    return collection


def write_subsurface(results: BearingResults, directory: Path) -> Path | None:
    """Write the stress in the races below the solved contacts, one volume each, if the case asks
    for it.

    Parameters
    ----------
    results : BearingResults
    directory : Path
        Result directory; the blocks go to its folder `vtk`.

    Returns
    -------
    Path or None
        The .pvd file; lengths in [mm], stresses in [GPa], in the frame of the contact: x along the
        rolling direction, z into the race.
    """
    if not results.case.get("ehl", {}).get("subsurface_stress"):
        return None
    bearing = results.quasistatic.bearing
    blocks: dict[str, dict[str, str]] = {}
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        if solution is not None:
            race = contact.race.value
            ring = bearing.inner_ring_material if race == "inner" else bearing.outer_ring_material
            volume = stress_volume(
                contact, solution, 0.5 * bearing.ball_diameter, ring.poisson_ratio
            )
            ball, _ = contact_name(contact.ball, race).split("/")
            blocks.setdefault(ball, {})[race] = _write_grid(
                volume_grid(volume), directory, f"{ball}_{race}_stress"
            )
    _write_text(directory / BLOCK_FOLDER / "subsurface.vtm", _multiblock(blocks))
    _write_text(directory / STRESS_FILE, collection_text({0.0: f"{BLOCK_FOLDER}/subsurface.vtm"}))
    return directory / STRESS_FILE


def volume_grid(volume: StressVolume) -> Any:
    """The stress below a contact as a vtkStructuredGrid, lengths in [mm], stresses in [GPa]."""
    grid = structured_grid(volume.points / MILLIMETRE)
    add_point_data(grid, "largest shear [GPa]", volume.maximum_shear / GIGAPASCAL)
    add_point_data(grid, "von Mises stress [GPa]", volume.von_mises / GIGAPASCAL)
    add_point_data(
        grid, "depth [mm]", np.broadcast_to(volume.depth, volume.maximum_shear.shape) / MILLIMETRE
    )
    components = np.stack([part.ravel(order="F") for part in volume.stress], axis=1) / GIGAPASCAL
    tensor = numpy_to_vtk(components.astype(np.float32), deep=True)
    tensor.SetName("stress xx yy zz xy yz xz [GPa]")
    grid.GetPointData().AddArray(tensor)
    grid.GetPointData().SetActiveScalars("largest shear [GPa]")
    add_field_data(grid, "coordinates", "mm")
    return grid


def placed_patch(
    contact: BearingContact, solution: ContactSolution, ball_radius: float, placement: Placement
) -> Any:
    """One contact as a vtkStructuredGrid on its ball, coordinates in [mm]; `ball_radius` in [m]."""
    long, wide, film = solution.x, solution.y, solution.film
    if long is None or wide is None or film is None:
        raise ValueError(
            "a contact given by Moes' groups has no lengths and cannot be placed in a bearing"
        )
    rows, columns = crop_to_ball(long, wide, ball_radius, placement)
    x, y = principal_coordinates(long[rows], wide[columns], solution.frame_angle)
    film = film[rows, columns]
    frame = ContactFrame(
        origin=np.asarray(contact.origin),
        axis_x=np.asarray(contact.axis_x),
        axis_y=np.asarray(contact.axis_y),
        normal=np.asarray(contact.normal),
        ball_radius=ball_radius,
    )
    grid = structured_grid(place_patch(x, y, frame, placement, placement.film * film) / MILLIMETRE)
    add_point_data(grid, FILM, film / MICROMETRE)
    add_point_data(grid, PRESSURE, solution.pressure[rows, columns] / GIGAPASCAL)
    if solution.state is not None and solution.state.temperature is not None:
        add_point_data(grid, TEMPERATURE, solution.state.temperature[rows, columns] - ZERO_CELSIUS)
    add_point_data(grid, "rolling [mm]", x / MILLIMETRE)
    add_point_data(grid, "transverse [mm]", y / MILLIMETRE)
    for name, value in _patch_facts(contact, solution, placement).items():
        add_field_data(grid, name, value)
    return grid


def _patch_facts(
    contact: BearingContact, solution: ContactSolution, placement: Placement
) -> dict[str, float | str]:
    return {
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


def flat_patch(solution: ContactSolution, film_exaggeration: float) -> Any:
    """A single contact as a flat vtkStructuredGrid: coordinates in [mm], or in semi-axes a where
    no length is known.
    """
    length, film_scale = solution.semi_axis_x, solution.film_scale
    unit, a = ("a", 1.0) if length is None else ("mm", length / MILLIMETRE)
    film_name, h = (
        ("film thickness [a^2/Rx]", 1.0) if film_scale is None else (FILM, film_scale / MICROMETRE)
    )
    p_name, p = (
        ("pressure [p_h]", 1.0)
        if solution.hertz_pressure <= 0.0
        else (PRESSURE, solution.hertz_pressure / 1e9)
    )
    x, y = principal_coordinates(solution.X, solution.Y, solution.frame_angle)
    height = (
        film_exaggeration * solution.H * (1.0 if film_scale is None else film_scale / MILLIMETRE)
    )
    grid = structured_grid(np.stack([a * x, a * y, height], axis=-1))
    add_point_data(grid, film_name, h * solution.H)
    add_point_data(grid, p_name, p * solution.P)
    if solution.state is not None and solution.state.temperature is not None:
        add_point_data(grid, TEMPERATURE, solution.state.temperature - ZERO_CELSIUS)
    add_field_data(grid, "coordinates", unit)
    add_field_data(grid, "film exaggeration [-]", film_exaggeration)
    return grid


def bodies(results: BearingResults) -> dict[str, Surface]:
    """Balls and rings as surfaces [m], set back a little so that the patches are seen; the outer
    ring is cut open.
    """
    bearing = results.quasistatic.bearing
    state = results.quasistatic
    radius = (0.5 - SET_BACK) * bearing.ball_diameter
    centres = np.stack(
        [
            state.ball_axial,
            state.ball_radial * np.cos(state.azimuth),
            state.ball_radial * np.sin(state.azimuth),
        ],
        axis=1,
    )
    middle = float(state.azimuth[int(np.argmax(state.outer_load))])
    rows = range(1, len(state.rows) + 1)
    inner = [
        ring_surface(bearing, True, _groove_axial(results, "inner", row), (middle, 0.0))
        for row in rows
    ]
    outer = [
        ring_surface(bearing, False, _groove_axial(results, "outer", row), (middle, OPENING))
        for row in rows
    ]
    return {
        "balls": merge([ball_surface(centre, radius) for centre in centres]),
        "inner ring": merge(inner),
        "outer ring": merge(outer),
    }


def _groove_axial(results: BearingResults, race: str, row: int) -> float:
    """Axial position of a race's groove centre [m]: from the contact point one groove radius back
    along the normal.
    """
    bearing = results.quasistatic.bearing
    radius = bearing.inner_groove_radius if race == "inner" else bearing.outer_groove_radius
    contacts = [
        c for c in results.contacts if c.race.value == race and c.row == row and c.load > 0.0
    ]
    found = [c.origin[0] - radius * c.normal[0] for c in contacts]
    return float(np.mean(found)) if found else results.quasistatic.rows[row - 1].axial_position


def structured_grid(points: Array) -> Any:
    """Build a vtkStructuredGrid of points, shape (nx, ny, 3) or (nx, ny, nz, 3) [mm or a]."""
    nx, ny, nz = (*points.shape[:-1], 1)[:3]
    corners = vtkPoints()
    columns = np.stack([points[..., k].ravel(order="F") for k in range(3)], axis=1)
    corners.SetData(numpy_to_vtk(columns.astype(np.float32), deep=True))
    grid = vtkStructuredGrid()
    grid.SetDimensions(nx, ny, nz)
    grid.SetPoints(corners)
    return grid


def add_point_data(grid: Any, name: str, values: Array) -> None:
    """Add a field on the nodes whose unit stands in its name, such as film [um], as float32."""
    array = numpy_to_vtk(values.T.ravel().astype(np.float32), deep=True)
    array.SetName(name)
    grid.GetPointData().AddArray(array)
    grid.GetPointData().SetActiveScalars(FILM)


def add_field_data(grid: Any, name: str, value: float | str) -> None:
    """Add one number or word about the whole block, its unit in the name, such as load [N]."""
    array: Any = vtkStringArray() if isinstance(value, str) else vtkDoubleArray()
    array.SetName(name)
    array.InsertNextValue(value)
    grid.GetFieldData().AddArray(array)


def poly_data(surface: Surface) -> Any:
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


def _write_grid(grid: Any, directory: Path, name: str) -> str:
    return _write_block(vtkXMLStructuredGridWriter(), grid, directory, f"{name}.vts")


def _write_body(surface: Surface, directory: Path, name: str) -> str:
    data = poly_data(surface)
    add_field_data(data, "coordinates", "mm")
    return _write_block(vtkXMLPolyDataWriter(), data, directory, f"{name}.vtp")


def _write_block(writer: Any, data: Any, directory: Path, name: str) -> str:
    with atomic_path(directory / BLOCK_FOLDER / name) as temporary:
        writer.SetFileName(str(temporary))
        writer.SetInputData(data)
        writer.SetCompressorTypeToZLib()
        if not writer.Write():
            raise OSError(f"{directory / BLOCK_FOLDER / name} could not be written")
    return name


def _write_text(path: Path, text: str) -> None:
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


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
    """XML of a .pvd file: what ParaView shows at each time, or at what else a step is named after.

    Parameters
    ----------
    steps : dict
        Relative path of a file by its step, such as the time [s] or an azimuth [deg].
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
    for azimuth, shown in steps.items():
        first = next(name for name in shown if name != "bodies")
        files[azimuth] = f"{BLOCK_FOLDER}/azimuth_{first}.vtm"
        _write_text(directory / files[azimuth], _multiblock(shown))
    if files:
        _write_text(directory / AZIMUTH_FILE, collection_text(files))
