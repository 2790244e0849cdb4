"""The history of a time simulation read from disk, with xarray, which takes long to load."""

from pathlib import Path

import xarray

from ..netcdf_write import open_netcdf
from .history import FORMAT, HISTORY_FILE


def open_history(path: str | Path) -> xarray.Dataset:
    """Open the history of a time simulation; quantities are read from disk when first used.

    Parameters
    ----------
    path : str | Path
        File or its folder.

    Returns
    -------
    xarray.Dataset
        History, SI.

    Raises
    ------
    ValueError
        If there is no history, or one that this version does not read.
    """
    path = Path(path)
    path = path / HISTORY_FILE if path.is_dir() else path
    if not path.is_file():
        raise ValueError(f"{path.parent} holds no history of a simulation: {path.name} is missing")
    data = open_netcdf(path, xarray.open_dataset)
    if data.attrs.get("oilfilm_history") != FORMAT:
        data.close()
        raise ValueError(f"{path} is no history of a simulation that this version reads")
    return data
