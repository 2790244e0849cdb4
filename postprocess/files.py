"""Results on disk: summary.json, contacts.csv and one netCDF file; each appears under its name
only when complete.
"""

import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import xarray
import xarray as xr

# dimensions, values, attributes by name
Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]]
# of the netCDF file; raised when an older reader would misread it. 1: x always along the
# entrainment
FORMAT = 2
SUMMARY_FILE = "summary.json"
CONTACTS_FILE = "contacts.csv"
FIELDS_FILE = "results.nc"


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """Give a temporary name beside `path`; on success it becomes `path`, on failure nothing is
    left.

    Parameters
    ----------
    path : Path
        Final name; missing folders are made.

    Yields
    ------
    Path
        Name to write to, same folder and suffix.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        os.chmod(temporary, 0o666 & ~_umask())  # mkstemp gives 0600
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_json(document: dict[str, Any], path: Path) -> None:
    """Write a JSON document atomically; NaN and infinity are refused with ValueError."""
    text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
    with atomic_path(path) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")


def write_dataset(
    variables: Variables, coordinates: set[str], attributes: dict[str, Any], path: Path
) -> None:
    """Write one netCDF-4 data set.

    Parameters
    ----------
    variables : dict
        Dimensions, values and attributes (units!) by name.
    coordinates : set of str
        Names of those that are coordinates.
    attributes : dict
        Of the whole.
    path : Path
    """
    data = {name: value for name, value in variables.items() if name not in coordinates}
    coords = {name: value for name, value in variables.items() if name in coordinates}
    dataset = xr.Dataset(data, coords, attributes | {"oilfilm_format": FORMAT})
    with atomic_path(path) as temporary:
        dataset.to_netcdf(temporary, engine="h5netcdf")
        dataset.close()


def root_attributes(document: dict[str, Any], kind: str) -> dict[str, Any]:
    """What every file says of itself, from a summary: version, format, kind, input and messages as
    JSON.
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


def contact_name(ball: int, race: str) -> str:
    """Name of a contact in files: `ball01/inner`."""
    return f"ball{ball:02d}/{race}"


def open_tree(path: Path) -> xarray.DataTree:
    """The groups of a netCDF-4 file, read from disk when they are used; ValueError if it is
    damaged or none.
    """
    try:
        return xr.open_datatree(path, engine="h5netcdf")
    except (OSError, KeyError, ValueError, TypeError, RuntimeError) as error:
        raise ValueError(f"{path} is damaged or not a netCDF-4 file: {error}") from error
