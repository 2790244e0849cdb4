"""netCDF-4 files of results, written as `reader` reads them, without xarray.

Loading xarray and its libraries takes longer than writing the fields of a bearing.
"""

import io
import json
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5netcdf
import h5py
import numpy as np

from bearing.files import atomic_path, require_room, write_bytes

# dimensions, values, attributes by name
Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]]
# format of the file, raised when an older reader would misread it; 1: x along the entrainment
FORMAT = 2
VALUE_BYTES = 24  # of a value that comes in parts, short texts included [bytes]
MARGIN = 2**20  # of what HDF5 adds to the values [bytes]
FIELDS_FILE = "results.nc"
FIELDS = ("P", "h", "T", "filled")  # over the plane of a contact, as float32
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """A group of a netCDF file; coordinates are the variables named as their dimension."""

    variables: Variables = field(default_factory=dict)
    attributes: dict[str, Any] = field(default_factory=dict)


def write_dataset(
    variables: Variables, attributes: dict[str, Any], path: Path, coordinates: Collection[str] = ()
) -> None:
    """Write a file of one group; coordinates are those of `Group` and of `coordinates`.

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
    named = " ".join(name for name in coordinates if name in variables)
    available = {"oilfilm_format": FORMAT} | ({"coordinates": named} if named else {})
    write_groups({"/": Group(variables=variables, attributes=attributes | available)}, path)


def write_groups(groups: dict[str, Group], path: Path) -> None:
    """Write the groups of one file by their paths, parents first.

    Parameters
    ----------
    groups : dict[str, Group]
        Groups by their paths, parents first.
    path : Path
        File to write.
    """
    content = io.BytesIO()  # HDF5 may end the program on a full disk
    with h5netcdf.File(content, "w") as file:
        for name, group in groups.items():
            _write_group(file if name == "/" else file.create_group(name), group)
    write_bytes(path, content.getvalue())


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
    named = " ".join(name for name in coordinates if name in parts.types)
    available = {"oilfilm_format": FORMAT} | ({"coordinates": named} if named else {})
    sizes = {d: n for v in variables.values() for d, n in zip(v[0], np.shape(v[1]), strict=True)}
    scales = {name: variable for name, variable in variables.items() if name in sizes}
    plain = Group(variables=scales, attributes=attributes | available)
    with atomic_path(path) as temporary:
        # HDF5 may end the program on a full disk
        require_room(path.parent, VALUE_BYTES * parts.size * len(parts.types) + _bytes(variables))
        with h5netcdf.File(temporary, "w") as file:
            file.dimensions.update(sizes | {parts.dimension: parts.size})
            _write_group(file, plain)
            if parts.dimension in parts.types:
                file.create_variable(
                    parts.dimension, (parts.dimension,), dtype=parts.types[parts.dimension]
                )
        with h5py.File(temporary, "r+") as file:
            _add_variables(file, {n: v for n, v in variables.items() if n not in scales}, parts)
            start = 0
            for part in parts.values:
                stop = start + len(next(iter(part.values())))
                for name, array in part.items():
                    file[name][start:stop] = array
                start = stop


def _add_variables(file: h5py.File, variables: Variables, parts: DatasetParts) -> None:
    """Add variables to a file whose dimensions stand, and those of `parts` without values, in the
    form of netCDF-4: h5netcdf takes four times as long for each.
    """
    for name, (dimensions, values, attributes) in variables.items():
        array = np.asarray(values)
        kind = h5py.string_dtype() if array.dtype.kind in "UO" else array.dtype
        dataset = file.create_dataset(name, dtype=kind, data=array, track_order=True)
        _in_netcdf(file, dataset, dimensions, attributes)
    for name, own in parts.types.items():
        form: Any = h5py.string_dtype() if own is object else np.dtype(own)
        attributes = parts.attributes.get(name, {})
        if name == parts.dimension:
            file[name].attrs.update(attributes)
            continue
        dataset = file.create_dataset(name, (parts.size,), dtype=form, track_order=True)
        _in_netcdf(file, dataset, (parts.dimension,), attributes)


def _in_netcdf(
    file: h5py.File, dataset: h5py.Dataset, dimensions: tuple[str, ...], attributes: dict[str, Any]
) -> None:
    """Give a dataset its dimensions as netCDF-4 does, by scales and their numbers."""
    numbers = [file[name].attrs["_Netcdf4Dimid"] for name in dimensions]
    for axis, name in enumerate(dimensions):
        dataset.dims[axis].attach_scale(file[name])
    dataset.attrs["_Netcdf4Coordinates"] = np.array(numbers, dtype="int32")
    dataset.attrs["_Netcdf4Dimid"] = numbers[0]
    dataset.attrs.update(attributes)


def _bytes(variables: Variables) -> int:
    """Room that variables take in a file, text included [bytes]."""
    sizes = [np.asarray(values) for _, values, _ in variables.values()]
    texts = (sum(map(len, array.flat)) for array in sizes if array.dtype == object)
    return MARGIN + sum(array.nbytes for array in sizes) + sum(texts)


def _write_group(target: Any, group: Group) -> None:
    target.attrs.update(group.attributes)
    for name, (dimensions, values, attributes) in group.variables.items():
        array = np.asarray(values)
        if array.dtype.kind in "UO":
            array = array.astype(object)
        for dimension, size in zip(dimensions, array.shape, strict=True):
            if dimension not in target.dimensions:
                target.dimensions[dimension] = size
        _write_variable(target, name, dimensions, array, attributes)


def _write_variable(
    target: Any, name: str, dimensions: tuple[str, ...], array: Any, attributes: dict[str, Any]
) -> None:
    """Fields are compressed, text has any length, truth values are bytes marked as such."""
    kind: Any = h5py.string_dtype() if array.dtype == object else array.dtype
    if array.dtype.kind == "b":
        array = array.astype("i1")
        kind = array.dtype
        attributes = attributes | {"dtype": "bool"}
    form = COMPRESSION if name in FIELDS else {}
    variable = target.create_variable(name, dimensions, dtype=kind, data=array, **form)
    variable.attrs.update(attributes)


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
