"""netCDF-4 files of results, written without xarray and looked through before it reads them, and
the files of a study.

Loading xarray and its libraries takes longer than writing the fields of a bearing. The files are
HDF5 with dimensions as scales, as the netCDF-4 format describes them: h5py writes them in half the
time that h5netcdf takes.
"""

import io
import json
from collections.abc import Callable, Collection, Container, Iterable, Iterator
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any, TypeVar

import h5netcdf
import h5py
import numpy as np

from oilfilm.bearing.files import atomic_path, require_room, write_bytes
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.foreign_files import DAMAGE, DamagedFileError, open_file

from .files import SUMMARY_FILE, CsvTable, attempt, write_csv, write_json

# dimensions, values, attributes by name
Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]]
# format of the file, raised when an older reader would misread it; 1: x along the entrainment
FORMAT = 2
VALUE_BYTES = 24  # of a value that comes in parts, short texts included [bytes]
MARGIN = 2**20  # of what HDF5 adds to the values [bytes]
FIELDS_FILE = "results.nc"
FIELDS = ("P", "h", "T", "filled")  # over the plane of a contact, as float32
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}
SPEED_COLUMN = "speed [r/min]"  # of studies over the speed of the inner ring
# filters of HDF5 that are read: deflate, shuffle, a checksum; deflate packs a thousand equal bytes
# into one
FILTERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32}
PACKED_ONCE = 1100
WITHOUT_VALUES = 64  # of a variable without values [bytes]
NO_VARIABLE = b"This is a netCDF dimension but not a netCDF variable"
PROVENANCE = f"version=2,h5py={h5py.version.version},hdf5={h5py.version.hdf5_version}"
T = TypeVar("T")


@dataclass(frozen=True, slots=True, kw_only=True)
class DataGroup:
    """A group of a netCDF file; coordinates are the variables named as their dimension."""

    variables: Variables = field(default_factory=dict)
    attributes: dict[str, Any] = field(default_factory=dict)


def write_dataset(
    variables: Variables, attributes: dict[str, Any], path: Path, coordinates: Collection[str] = ()
) -> None:
    """Write a netCDF-4 file of one group.

    Parameters
    ----------
    variables : Variables
        Dimensions, values and attributes of each variable by name.
    attributes : dict[str, Any]
        Attributes of the file.
    path : Path
        File to write.
    coordinates : Collection[str], default ()
        Names of variables that are coordinates beside those named as their dimension.
    """
    head = _head(attributes, coordinates, variables)
    write_groups({"/": DataGroup(variables=variables, attributes=head)}, path)


def _head(
    attributes: dict[str, Any], coordinates: Iterable[str], names: Container[str]
) -> dict[str, Any]:
    """Attributes of a file with its format and its coordinates."""
    listed = " ".join(name for name in coordinates if name in names)
    form = {"oilfilm_format": FORMAT}
    return attributes | form | ({"coordinates": listed} if listed else {})


def write_groups(groups: dict[str, DataGroup], path: Path) -> None:
    """Write the groups of one file by their paths, parents first.

    Parameters
    ----------
    groups : dict[str, Group]
        Groups by their paths, parents first.
    path : Path
        File to write.
    """
    content = io.BytesIO()  # HDF5 may end the program on a full disk
    numbers = count()
    with _new_file(content) as file:
        for name, group in groups.items():
            own = file if name == "/" else file.create_group(name, track_order=True)
            _write_group(own, group, numbers)
    write_bytes(path, content.getvalue())


def _new_file(target: Any) -> h5py.File:
    """A file whose groups keep the order in which their variables were written."""
    file = h5py.File(target, "w", track_order=True)
    file.attrs["_NCProperties"] = np.bytes_(PROVENANCE)
    return file


@dataclass(frozen=True, slots=True)
class _Later:
    """Values that come in parts."""

    shape: tuple[int, ...]
    dtype: np.dtype[Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class DatasetParts:
    """Variables over one dimension that come some thousand values at a time.

    `types`: of each variable, `object` for text; `attributes` of those that have any; `values`:
    arrays of all variables, one part of the dimension after the other.
    """

    dimension: str
    size: int
    types: dict[str, type]
    attributes: dict[str, dict[str, Any]]
    values: Iterable[dict[str, Any]]


def write_dataset_in_parts(
    parts: DatasetParts,
    variables: Variables,
    attributes: dict[str, Any],
    path: Path,
    coordinates: Collection[str] = (),
) -> None:
    """Write a file of one group, as `write_dataset`, whose large variables come in parts.

    Parameters
    ----------
    parts : DatasetParts
        Variables that come in parts.
    variables : Variables
        Variables that are in memory.
    attributes : dict[str, Any]
        Attributes of the file.
    path : Path
        File to write.
    coordinates : Collection[str], default ()
        Names of coordinates among the parts.

    Raises
    ------
    OSError
        Before anything is written, if the disk has no room.
    """
    sizes = {d: n for v in variables.values() for d, n in zip(v[0], np.shape(v[1]), strict=True)}
    over = (parts.dimension,)
    later: Variables = {
        name: (over, _Later((parts.size,), np.dtype(kind)), parts.attributes.get(name, {}))
        for name, kind in parts.types.items()
    }
    first = [name for name in variables if name in sizes] + [parts.dimension]
    everything = {name: (later | variables)[name] for name in first} | variables | later
    head = _head(attributes, coordinates, parts.types)
    with atomic_path(path) as temporary:
        # HDF5 may end the program on a full disk
        require_room(path.parent, VALUE_BYTES * parts.size * len(parts.types) + _bytes(variables))
        with _new_file(temporary) as file:
            _write_group(file, DataGroup(variables=everything, attributes=head), count())
            start = 0
            for part in parts.values:
                stop = start + len(next(iter(part.values())))
                for name, array in part.items():
                    file[name][start:stop] = array
                start = stop


def _bytes(variables: Variables) -> int:
    """Room that variables take in a file, text included [bytes]."""
    sizes = [np.asarray(values) for _, values, _ in variables.values()]
    texts = (sum(map(len, array.flat)) for array in sizes if array.dtype == object)
    return MARGIN + sum(array.nbytes for array in sizes) + sum(texts)


def _write_group(target: h5py.Group, group: DataGroup, numbers: Iterator[int]) -> None:
    """Write variables and attributes of a group, its dimensions as scales numbered in the file."""
    _describe(target, group.attributes)
    arrays = {name: _storable(values) for name, (_, values, _) in group.variables.items()}
    sizes: dict[str, int] = {}
    for name, (over, _, _) in group.variables.items():
        sizes |= zip(over, arrays[name].shape, strict=True)
    own = {name for name in sizes if name in arrays and group.variables[name][0] == (name,)}
    scales = {}
    for name in (name for name in sizes if name not in own):
        scales[name] = target.create_dataset(name, (sizes[name],), dtype=">f4", track_order=True)
        scales[name].make_scale(NO_VARIABLE + b".%10d" % sizes[name])
    written = {}
    for name, (_, values, attributes) in group.variables.items():
        if np.asarray(values).dtype == bool:
            attributes = attributes | {"dtype": "bool"}
        free = name if name not in scales else f"_nc4_non_coord_{name}"
        written[name] = _write_variable(target, free, arrays[name], name in FIELDS)
        _describe(written[name], attributes)
        if name in own:
            scales[name] = written[name]
            scales[name].make_scale(name)
    for name in sizes:
        scales[name].attrs["_Netcdf4Dimid"] = np.int32(next(numbers))
    for name, (over, _, _) in group.variables.items():
        for axis, dimension in enumerate(() if name in own else over):
            written[name].dims[axis].attach_scale(scales[dimension])


def _describe(target: Any, attributes: dict[str, Any]) -> None:
    """Write attributes; numbers are lists of one."""
    attrs = target.attrs
    for name, value in attributes.items():
        attrs[name] = value if isinstance(value, str) else np.atleast_1d(value)


def _storable(values: Any) -> Any:
    """Text of any length as objects, truth values as bytes."""
    if isinstance(values, _Later):
        return values
    array = np.asarray(values)
    if array.dtype.kind in "UO":
        return array.astype(object)
    return array.astype("i1") if array.dtype.kind == "b" else array


def _write_variable(target: h5py.Group, name: str, array: Any, field: bool) -> h5py.Dataset:
    """Fields are compressed; a variable whose values come later has none yet."""
    kind: Any = h5py.string_dtype() if array.dtype == object else array.dtype
    form = COMPRESSION if field else {}
    data = None if isinstance(array, _Later) else array
    return target.create_dataset(
        name, array.shape, dtype=kind, data=data, track_order=True, **form
    )


def root_attributes(document: dict[str, Any], kind: str) -> dict[str, Any]:
    """Attributes of every file, from a summary: version, format, kind, input, messages.

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.
    kind : str
        Kind of the results, such as "bearing".

    Returns
    -------
    dict[str, Any]
        Attributes of the root group.
    """
    case = document["case"]
    return {
        "title": str(case.get("title", "")),
        "source": str(case.get("source", "")),
        "oilfilm": document["oilfilm"],
        "oilfilm_format": FORMAT,
        "kind": kind,
        "converged": int(document["converged"]),
        "case": json.dumps(case, ensure_ascii=False),
        "messages": json.dumps(document["messages"], ensure_ascii=False),
    }


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyFiles:
    """Files of a study: its summary, tables by name, and its data set."""

    kind: str
    document: dict[str, Any]
    tables: dict[str, CsvTable]
    variables: Variables
    attributes: dict[str, Any] = field(default_factory=dict)
    number: str = ""  # format of the numbers in tables, in full if it is empty


def write_study(files: StudyFiles, folder: Path, draw: Callable[[], object]) -> tuple[str, ...]:
    """Write pictures, tables, data set, last the summary; pictures that failed are messages.

    Parameters
    ----------
    files : StudyFiles
        Summary, tables and data set.
    folder : Path
        Folder to write into.
    draw : Callable[[], object]
        Writes the pictures.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    problems = attempt("plots", draw)
    for name, (header, rows) in files.tables.items():
        write_csv(folder / f"{name}.csv", header, rows, files.number)
    document = files.document | {"messages": [*files.document["messages"], *problems]}
    attributes = root_attributes(document, files.kind) | files.attributes
    write_dataset(files.variables, attributes, folder / FIELDS_FILE)
    write_json(document, folder / SUMMARY_FILE)
    return problems


def open_netcdf(path: Path, opened: Callable[..., T]) -> T:
    """Open a netCDF-4 file, which holds all of its data itself.

    Parameters
    ----------
    path : Path
        The file.
    opened : Callable[..., T]
        xarray's function that opens it.

    Returns
    -------
    T
        What it has opened, read when it is used.

    Raises
    ------
    DamagedFileError
        If the file is damaged, leads to other files, or declares more than it holds.
    """
    try:
        with open_file(path), h5py.File(path) as file:
            _require_own_data(file, set())
        return opened(path, engine="h5netcdf")
    except (OSError, *DAMAGE) as error:
        fault = f"{path} is damaged or not a netCDF-4 file: {error}"
        raise DamagedFileError(fault) from error


def read_variables(path: Path, *names: str) -> tuple[Array, ...]:
    """Values of variables of the first group of a file, read without xarray.

    Parameters
    ----------
    path : Path
        A netCDF-4 file.
    *names : str
        Of the variables.

    Returns
    -------
    tuple of ndarray
        Their values.

    Raises
    ------
    DamagedFileError
        If the file is damaged.
    """
    with open_netcdf(path, lambda file, engine: h5netcdf.File(file)) as content:
        return tuple(np.asarray(content[name][:]) for name in names)


def _require_own_data(group: h5py.Group, seen: set[int]) -> None:
    """ValueError where a link leads elsewhere, or a variable is larger than what is stored."""
    for name in group:
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise ValueError(f"{name} leads elsewhere")
        item = group[name]
        place = h5py.h5o.get_info(item.id).addr
        if place in seen:
            raise ValueError(f"{name} leads elsewhere")
        seen.add(place)
        if isinstance(item, h5py.Group):
            _require_own_data(item, seen)
        elif isinstance(item, h5py.Dataset):
            _require_own_values(name, item)


def _require_own_values(name: str, data: h5py.Dataset) -> None:
    layout = data.id.get_create_plist()
    filters = {layout.get_filter(k)[0] for k in range(layout.get_nfilters())}
    if data.is_virtual or layout.get_external_count() or not filters <= FILTERS:
        raise ValueError(f"{name} is stored elsewhere")
    is_variable = not bytes(data.attrs.get("NAME", b"")).startswith(NO_VARIABLE)
    if is_variable and data.nbytes > PACKED_ONCE * (data.id.get_storage_size() + WITHOUT_VALUES):
        raise ValueError(f"{name} declares more than it holds")
