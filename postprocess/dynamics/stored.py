"""The history of a time simulation, read from its file."""

from pathlib import Path

import xarray as xr

from .history import FORMAT, HISTORY_FILE


def open_history(path: str | Path) -> xr.Dataset:
    """Open the history of a time simulation; quantities are read from disk when first used.

    Parameters
    ----------
    path : str | Path
        File or its folder.

    Returns
    -------
    xr.Dataset
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
    data = xr.open_dataset(path, engine="h5netcdf")
    if data.attrs.get("oilfilm_history") != FORMAT:
        data.close()
        raise ValueError(f"{path} is no history of a simulation that this version reads")
    return data
