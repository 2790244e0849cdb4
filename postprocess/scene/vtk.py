"""Fields and bodies for ParaView: fields.pvd -> fields.vtm -> one block per ball and race.

Stress below contacts comes as volumes, on request only; rings with their displacement or stress
come as hexahedra, by meshio. Only VTK's data and file modules are used, none that could open a
window.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import degrees, nan
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import meshio
import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLStructuredGridWriter

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.files import atomic_path, write_bytes
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.quasistatic.ring import ring_displacements
from oilfilm.ehl import ContactSolution
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.solid.bodies.ring import RingStress
from oilfilm.ehl.solid.subsurface import subsurface_stress
from oilfilm.ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, ZERO_CELSIUS

from ..bearing.results import BearingResults
from ..contact.shown_part import principal_coordinates, resampled, shown_scales
from ..contact.summary import ContactResults
from ..files import contact_name, write_text
from ..shaft.results import ShaftResults
from . import geometry

CELLS = 81  # each way
LEFT_OUT = 0.01  # pressure over the largest one below which the box may end [-]
MARGIN = 1.15  # of the box beyond the nodes with more pressure than that [-]
# in half the shorter side of the box; the largest shear lies at 0.48 (circle) to 0.78 (line) of
# the shorter semi-axis, Johnson, Contact Mechanics (1985), section 4.2
DEEPEST = 2.0
LEVELS = 26  # depths from the surface to there
Blocks = dict[str, dict[str, str]]  # files by group and name
Facts = dict[str, float | str]  # of a whole block, the unit in the name
COLLECTION_FILE = "fields.pvd"
STRESS_FILE = "subsurface.pvd"
BLOCK_FOLDER = "vtk"
AZIMUTH_FILE = "azimuth.pvd"
FILM = "film thickness [um]"
PRESSURE = "pressure [GPa]"
TEMPERATURE = "film temperature [degC]"
FILLED = "filled share of the gap [-]"
# level of zlib, 1 to 9; by the default of VTK, 5, a third slower, files 1 % smaller
COMPRESSION_LEVEL = 1
SHAFT_FACETS = 96
OPENING = np.pi  # sector cut out of the outer ring, about the most loaded ball [rad]
DISPLACEMENT = "displacement [um]"
DISTANCE = "displacement, size [um]"
RADIAL = "displacement, radial [um]"
COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "xz")


@dataclass(frozen=True, slots=True, kw_only=True)
class StressVolume:
    """Stress in the race below one contact."""

    points: Array  # in the bearing's frame, shape (nx, ny, nz, 3) [m]
    depth: Array  # shape (nz,) [m]
    # xx, yy, zz, xy, yz, xz in the contact's frame, z into the race, shape (6, nx, ny, nz) [Pa]
    stress: Array
    von_mises: Array  # shape (nx, ny, nz) [Pa]
    maximum_shear: Array  # shape (nx, ny, nz) [Pa]


def stress_volume(
    contact: BearingContact, solution: ContactSolution, ball_radius: float, poisson_ratio: float
) -> StressVolume:
    """Stress in a race below the solved pressure, which acts without friction on a half-space.

    Parameters
    ----------
    contact : BearingContact
        Contact of a ball and a race.
    solution : ContactSolution
        Solved film of the contact.
    ball_radius : float
        Radius of the ball [m].
    poisson_ratio : float
        Poisson's ratio of the race [-].

    Returns
    -------
    StressVolume
        Stress in the race.

    Raises
    ------
    ValueError
        If the contact has no lengths.
    """
    long = solution.x
    wide = solution.y
    pressure = solution.pressure
    if long is None or wide is None or solution.semi_axis_x is None:
        raise ValueError("a contact given by Moes' groups has no lengths and no stress in pascals")
    a = solution.semi_axis_x
    b = solution.semi_axis_x * solution.semi_axis_ratio
    pressed = pressure > LEFT_OUT * pressure.max()
    x, y = _span(long, pressed.any(axis=1), a), _span(wide, pressed.any(axis=0), b)
    depth = np.linspace(0.0, DEEPEST, LEVELS) * 0.5 * min(float(np.ptp(x)), float(np.ptp(y)))
    even = resampled(long, wide, pressure, x, y, outside=0.0)
    field = subsurface_stress(even, x, y, depth, poisson_ratio)
    frame = geometry.contact_frame(contact, ball_radius)
    along, across = principal_coordinates(x, y, solution.frame_angle)
    levels = [
        geometry.place_patch(along, across, frame, geometry.Placement(), np.full(along.shape, z))
        for z in depth
    ]
    return StressVolume(
        points=np.stack(levels, axis=2),
        depth=depth,
        stress=field.stress,
        von_mises=field.von_mises,
        maximum_shear=field.maximum_shear,
    )


def _span(axis: Array, pressed: NDArray[np.bool_], semi_axis: float) -> Array:
    """Even nodes over the Hertz ellipse and all nodes that carry pressure [m]."""
    ends = np.array([min(axis[pressed].min(), -semi_axis), max(axis[pressed].max(), semi_axis)])
    middle = ends.mean()
    half = 0.5 * np.ptp(ends)
    return np.asarray(middle + MARGIN * half * np.linspace(-1.0, 1.0, CELLS))


def write_collection(
    results: BearingResults | ContactResults,
    directory: Path,
    patch_magnification: tuple[float, float] = (1.0, 1.0),
    film_exaggeration: float = 0.0,
) -> Path:
    """Write the VTK collection of a run into a directory and return its .pvd file.

    Lengths in [mm]; paths relative, so that the folder can be moved. Patches may be magnified
    along and across the rolling direction, films drawn as height, exaggerated [-].

    Parameters
    ----------
    results : BearingResults | ContactResults
        Results of a bearing or of a single contact.
    directory : Path
        Folder to write into.
    patch_magnification : tuple[float, float], default (1.0, 1.0)
        Magnification of patches along and across the rolling direction [-].
    film_exaggeration : float, default 0.0
        Film drawn as height, times this [-].

    Returns
    -------
    Path
        The .pvd file.
    """
    if isinstance(results, ContactResults):
        grid = flat_patch(results.solution, film_exaggeration)
        blocks = {"contact": {"contact": _write(grid, directory, "contact.vts")}}
        return _write_collection(directory, COLLECTION_FILE, blocks)
    rolling, transverse = patch_magnification
    placement = geometry.Placement(rolling=rolling, transverse=transverse, film=film_exaggeration)
    radius = 0.5 * results.quasistatic.bearing.ball_diameter
    draw = partial(placed_patch, ball_radius=radius, placement=placement)
    blocks = _write_contacts(results, directory, "", draw)
    blocks["bodies"] = {
        name: _write(poly_data(surface), directory, f"{name.replace(' ', '_')}.vtp")
        for name, surface in bodies(results).items()
    }
    _write_azimuths(results, directory, blocks)
    return _write_collection(directory, COLLECTION_FILE, blocks)


def write_shaft_collection(results: ShaftResults, directory: Path) -> Path:
    """Write a shaft with its displacement, and its bearings at their places, as a VTK collection.

    Parameters
    ----------
    results : ShaftResults
        Results of a shaft.
    directory : Path
        Folder to write into.

    Returns
    -------
    Path
        The .pvd file.
    """
    blocks: Blocks = {"shaft": {"shaft": _write(_shaft_data(results), directory, "shaft.vtp")}}
    supports = results.solution.system.supports
    for k, (support, bearing) in enumerate(zip(supports, results.bearings, strict=True), 1):
        if bearing is None:
            continue
        files = {}
        for name, surface in bodies(bearing).items():
            place = surface.points + support.position * np.eye(3)[0]
            moved = geometry.Surface(points=place, quads=surface.quads)
            file = f"bearing_{k}_{name.replace(' ', '_')}.vtp"
            files[name] = _write(poly_data(moved), directory, file)
        blocks[f"bearing {k}"] = files
    return _write_collection(directory, COLLECTION_FILE, blocks)


def _shaft_data(results: ShaftResults) -> vtkPolyData:
    """Surface of a shaft, and how far its axis moves there."""
    solution = results.solution
    places = solution.positions
    outside, inside = [], []
    for section in solution.system.sections:
        within = places[(places > section.start) & (places < section.end)]
        x = np.concatenate([[section.start], within, [section.end]])
        outside.append(np.stack([x, np.full(x.size, 0.5 * section.outside_diameter)]))
        inside.append(np.stack([x, np.full(x.size, 0.5 * section.inside_diameter)]))
    around = np.concatenate([*outside, *(line[:, ::-1] for line in inside[::-1])], axis=1)
    x, r = np.concatenate([around, around[:, :1]], axis=1)
    turn = np.linspace(0.0, 2.0 * np.pi, SHAFT_FACETS + 1)
    data = poly_data(geometry.revolved(x, r, turn))
    moved = np.stack([np.interp(x, places, u) for u in solution.displacement[:, :3].T], axis=1)
    add_array(data, DISPLACEMENT, np.tile(moved / MICROMETRE, (turn.size, 1)))
    return data


def write_subsurface(results: BearingResults, directory: Path) -> Path | None:
    """Write the stress [GPa] below the solved contacts, if the case asks for it; the .pvd file.

    A volume [mm] for each contact, in its frame: x along the rolling direction, z into the race.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.
    directory : Path
        Folder to write into.

    Returns
    -------
    Path | None
        The .pvd file; None if the case does not ask for it.
    """
    if not results.case.get("ehl", {}).get("subsurface_stress"):
        return None
    bearing = results.quasistatic.bearing
    radius = 0.5 * bearing.ball_diameter

    def draw(contact: BearingContact, solution: ContactSolution) -> vtkStructuredGrid:
        is_inner = contact.race.value == "inner"
        ring = bearing.inner_ring_material if is_inner else bearing.outer_ring_material
        return volume_grid(stress_volume(contact, solution, radius, ring.poisson_ratio))

    blocks = _write_contacts(results, directory, "_stress", draw)
    return _write_collection(directory, STRESS_FILE, blocks)


def _write_contacts(
    results: BearingResults,
    directory: Path,
    ending: str,
    draw: Callable[[BearingContact, ContactSolution], vtkStructuredGrid],
) -> Blocks:
    """Write a block for each contact with a film; their files by ball and race."""
    blocks: Blocks = {}
    for contact, field in zip(results.contacts, results.fields, strict=True):
        if field is not None:
            ball, race = contact_name(contact.ball, contact.race.value).split("/")
            name = f"{ball}_{race}{ending}.vts"
            blocks.setdefault(ball, {})[race] = _write(draw(contact, field), directory, name)
    return blocks


def volume_grid(volume: StressVolume) -> vtkStructuredGrid:
    """The stress below a contact as a grid.

    Parameters
    ----------
    volume : StressVolume
        Stress below a contact.

    Returns
    -------
    vtkStructuredGrid
        Grid in [mm], stresses in [GPa].
    """
    largest = "largest shear [GPa]"
    depth = np.broadcast_to(volume.depth, volume.maximum_shear.shape)
    fields = {
        largest: volume.maximum_shear / GIGAPASCAL,
        "von Mises stress [GPa]": volume.von_mises / GIGAPASCAL,
        "depth [mm]": depth / MILLIMETRE,
    }
    grid = structured_grid(volume.points / MILLIMETRE, fields, {"coordinates": "mm"})
    stress = np.stack([part.ravel(order="F") for part in volume.stress], axis=1)
    add_array(grid, "stress xx yy zz xy yz xz [GPa]", stress / GIGAPASCAL)
    grid.GetPointData().SetActiveScalars(largest)
    return grid


def placed_patch(
    contact: BearingContact,
    solution: ContactSolution,
    ball_radius: float,
    placement: geometry.Placement,
) -> vtkStructuredGrid:
    """One contact on its ball.

    Parameters
    ----------
    contact : BearingContact
        Contact of a ball and a race.
    solution : ContactSolution
        Solved film of the contact.
    ball_radius : float
        Radius of the ball [m].
    placement : Placement
        Magnification of patches and films.

    Returns
    -------
    vtkStructuredGrid
        Grid in [mm].

    Raises
    ------
    ValueError
        If the contact has no lengths.
    """
    long = solution.x
    wide = solution.y
    film = solution.film
    if long is None or wide is None or film is None:
        raise ValueError(
            "a contact given by Moes' groups has no lengths and cannot be placed in a bearing"
        )
    part = geometry.crop_to_ball(long, wide, ball_radius, placement)
    x, y = principal_coordinates(long[part[0]], wide[part[1]], solution.frame_angle)
    height = placement.film * film[part]
    points = geometry.place_patch(
        x, y, geometry.contact_frame(contact, ball_radius), placement, height
    )
    fields = {FILM: film[part] / MICROMETRE, PRESSURE: solution.pressure[part] / GIGAPASCAL}
    fields |= {name: values[part] for name, values in _oil_fields(solution).items()}
    fields |= {"rolling [mm]": x / MILLIMETRE, "transverse [mm]": y / MILLIMETRE}
    facts: Facts = {
        "ball": float(contact.ball),
        "race": contact.race.value,
        "azimuth [deg]": degrees(contact.azimuth),
        "load [N]": contact.load,
        "central film [um]": _micrometres(solution.film_central),
        "minimum film [um]": _micrometres(solution.film_minimum),
        "coordinates": "mm",
        "patch magnification rolling [-]": placement.rolling,
        "patch magnification transverse [-]": placement.transverse,
        "film exaggeration [-]": placement.film,
    }
    return structured_grid(points / MILLIMETRE, fields, facts)


def _micrometres(film: float | None) -> float:
    """A film [um]; not a number where there is none."""
    return nan if film is None else film / MICROMETRE


def flat_patch(solution: ContactSolution, film_exaggeration: float) -> vtkStructuredGrid:
    """A single contact in its plane.

    Parameters
    ----------
    solution : ContactSolution
        Solved film of the contact.
    film_exaggeration : float
        Film drawn as height, times this [-].

    Returns
    -------
    vtkStructuredGrid
        Grid in [mm], or in semi-axes a where no length is known.
    """
    a, h, p = shown_scales(solution)
    is_long = solution.film_scale is not None
    height = film_exaggeration * (h * MICROMETRE / MILLIMETRE if is_long else h)
    x, y = principal_coordinates(solution.X, solution.Y, solution.frame_angle)
    fields = {
        FILM if is_long else "film thickness [a^2/Rx]": h * solution.H,
        PRESSURE if solution.hertz_pressure > 0.0 else "pressure [p_h]": p * solution.P,
    }
    unit = "a" if solution.semi_axis_x is None else "mm"
    facts: Facts = {"coordinates": unit, "film exaggeration [-]": film_exaggeration}
    points = np.stack([a * x, a * y, height * solution.H], axis=-1)
    return structured_grid(points, fields | _oil_fields(solution), facts)


def _oil_fields(solution: ContactSolution) -> dict[str, Array]:
    """Fields of the oil by their names, as far as they were solved.

    Mean temperature over the film [degC], and the share of the gap that oil fills [-].
    """
    fields = {}
    if solution.state is not None and solution.state.temperature is not None:
        fields[TEMPERATURE] = solution.state.temperature - ZERO_CELSIUS
    if solution.supply is not None and solution.supply.filled is not None:
        fields[FILLED] = solution.supply.filled
    return fields


def bodies(results: BearingResults) -> dict[str, geometry.Surface]:
    """Balls and rings as surfaces [m], set back behind the patches; the outer ring is cut open.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Surface]
        Surfaces by name [m].
    """
    state = results.quasistatic
    bearing = state.bearing
    lengths = geometry.bearing_lengths(bearing)
    radius = (0.5 - geometry.SET_BACK) * bearing.ball_diameter
    centres = np.stack(
        [
            state.ball_axial,
            state.ball_radial * np.cos(state.azimuth),
            state.ball_radial * np.sin(state.azimuth),
        ],
        axis=1,
    )
    most_loaded = float(state.azimuth[int(np.argmax(state.outer_load))])
    surfaces = {
        "balls": geometry.merge([geometry.ball_surface(centre, radius) for centre in centres])
    }
    for race, opening in (("inner", 0.0), ("outer", OPENING)):
        shape = geometry.ring_shape(lengths, inner=race == "inner")
        rings = [
            geometry.ring_surface(shape, groove_axial(results, race, row), (most_loaded, opening))
            for row in range(1, len(state.rows) + 1)
        ]
        surfaces[f"{race} ring"] = geometry.merge(rings)
    return surfaces | {"cage": _cages(results)}


def _cages(results: BearingResults) -> geometry.Surface:
    """A simplified cage for each row, its bars between the balls [m]."""
    state = results.quasistatic
    bearing = state.bearing
    cages = []
    for number in range(len(state.rows)):
        row = state.row(number)
        pitch = 2.0 * float(np.mean(row.ball_radial))
        cage = geometry.cage_surface(pitch, bearing.ball_diameter, bearing.balls)
        place = float(np.mean(row.ball_axial)) * np.eye(3)[0]
        points = place + cage.points @ geometry.about_axis(float(row.azimuth[0])).T
        cages.append(geometry.Surface(points=points, quads=cage.quads))
    return geometry.merge(cages)


def groove_axial(results: BearingResults, race: str, row: int) -> float:
    """Axial position of a race's groove centre: behind the contact, along the normal.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.
    race : str
        "inner" or "outer".
    row : int
        Number of the row, from 1.

    Returns
    -------
    float
        Axial position [m].
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


def structured_grid(
    points: Array, fields: dict[str, Array], facts: Facts | None = None
) -> vtkStructuredGrid:
    """A grid of points with fields on its nodes.

    Parameters
    ----------
    points : Array
        Points, shape (nx, ny, 3) or (nx, ny, nz, 3) [mm or a].
    fields : dict[str, Array]
        Fields at the points, by name with unit.
    facts : Facts | None, optional
        Numbers and words of the whole, by name with unit.

    Returns
    -------
    vtkStructuredGrid
        The grid.
    """
    corners = vtkPoints()
    columns = np.stack([points[..., k].ravel(order="F") for k in range(3)], axis=1)
    corners.SetData(numpy_to_vtk(columns.astype(np.float32), deep=True))
    grid = vtkStructuredGrid()
    grid.SetDimensions(*(*points.shape[:-1], 1)[:3])
    grid.SetPoints(corners)
    for name, values in fields.items():
        add_array(grid, name, values.T.ravel())
    grid.GetPointData().SetActiveScalars(FILM)
    for name, value in (facts or {}).items():
        add_field_data(grid, name, value)
    return grid


def add_array(data: Any, name: str, values: Array) -> None:
    """Add values at the points.

    Parameters
    ----------
    data : Any
        VTK data set.
    name : str
        Name with unit.
    values : Array
        Shape (points,) or (points, components).
    """
    array = numpy_to_vtk(values.astype(np.float32), deep=True)
    array.SetName(name)
    data.GetPointData().AddArray(array)


def add_field_data(grid: Any, name: str, value: float | str) -> None:
    """Add one number or word about the whole block.

    Parameters
    ----------
    grid : Any
        VTK data set.
    name : str
        Name with unit, such as load [N].
    value : float | str
        Number or word.
    """
    array: Any = vtkStringArray() if isinstance(value, str) else vtkDoubleArray()
    array.SetName(name)
    array.InsertNextValue(value)
    grid.GetFieldData().AddArray(array)


def poly_data(surface: geometry.Surface, facts: Facts | None = None) -> vtkPolyData:
    """Turn a surface into vtkPolyData.

    Parameters
    ----------
    surface : Surface
        Surface [m].
    facts : Facts | None, optional
        Numbers and words of the whole, by name with unit.

    Returns
    -------
    vtkPolyData
        Data set in [mm].
    """
    points = vtkPoints()
    cells = vtkCellArray()
    data = vtkPolyData()
    points.SetData(numpy_to_vtk((surface.points / MILLIMETRE).astype(np.float32), deep=True))
    offsets = 4 * np.arange(len(surface.quads) + 1)
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_to_vtkIdTypeArray(surface.quads.ravel().copy(), deep=True),
    )
    data.SetPoints(points)
    data.SetPolys(cells)
    for name, value in ((facts or {}) | {"coordinates": "mm"}).items():
        add_field_data(data, name, value)
    return data


def write_block(data: Any, path: Path) -> None:
    """Write a grid (.vts) or a surface (.vtp); the file appears when it is complete.

    VTK writes into memory: a full disk is to be an error of the system's, with its number.

    Parameters
    ----------
    data : Any
        Grid or surface.
    path : Path
        File that ends in .vts or .vtp.

    Raises
    ------
    RuntimeError
        If VTK cannot write it.
    OSError
        If the disk does not take it.
    """
    is_grid = isinstance(data, vtkStructuredGrid)
    writer: Any = vtkXMLStructuredGridWriter() if is_grid else vtkXMLPolyDataWriter()
    writer.WriteToOutputStringOn()
    writer.SetInputData(data)
    writer.SetCompressorTypeToZLib()
    writer.SetCompressionLevel(COMPRESSION_LEVEL)
    writer.EncodeAppendedDataOff()  # bytes as they are: by base64 files are a third larger
    if not writer.Write():
        raise RuntimeError(f"VTK could not write {path.name}")
    content = writer.GetOutputString()
    write_bytes(path, content.encode() if isinstance(content, str) else content)


def _write(data: Any, directory: Path, name: str) -> str:
    write_block(data, directory / BLOCK_FOLDER / name)
    return name


def _write_collection(directory: Path, name: str, blocks: Blocks) -> Path:
    """Write a collection of one step, and the groups of blocks that it shows."""
    groups = f"{BLOCK_FOLDER}/{Path(name).stem}.vtm"
    write_text(directory / groups, _multiblock(blocks))
    write_text(directory / name, collection_text({0.0: groups}))
    return directory / name


def _multiblock(blocks: Blocks) -> str:
    """XML of a .vtm file: named groups of named files."""
    lines = []
    for i, (group, files) in enumerate(blocks.items()):
        lines.append(f'<Block index="{i}" name={quoteattr(group)}>')
        for j, (name, file) in enumerate(files.items()):
            place = f"name={quoteattr(name)} file={quoteattr(file)}"
            lines.append(f'<DataSet index="{j}" {place}/>')
        lines.append("</Block>")
    return _xml("vtkMultiBlockDataSet", "1.0", lines)


def collection_text(steps: dict[float, str]) -> str:
    """XML of a .pvd file.

    Parameters
    ----------
    steps : dict[float, str]
        Relative path of a file by time [s], azimuth [deg] or what else names a step.

    Returns
    -------
    str
        The XML.
    """
    lines = [
        f'<DataSet timestep="{step!r}" group="" part="0" file={quoteattr(file)}/>'
        for step, file in sorted(steps.items())
    ]
    return _xml("Collection", "0.1", lines)


def _xml(kind: str, version: str, lines: list[str]) -> str:
    head = f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="{version}">\n<{kind}>'
    return "\n".join([head, *lines, f"</{kind}>\n</VTKFile>\n"])


def _write_azimuths(results: BearingResults, directory: Path, blocks: Blocks) -> None:
    """A collection around the bearing: a step has bodies, and the films at an azimuth [deg]."""
    steps: dict[float, Blocks] = {}
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
        cells.append(geometry.hexahedra(np.concatenate([numbers, numbers[:1]])))  # closed around
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
    return meshio.Mesh(points, [("hexahedron", geometry.hexahedra(number))], data)
