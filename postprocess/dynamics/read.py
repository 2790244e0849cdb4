"""The history of a time simulation read from disk, and the speeds in it; xarray loads slowly."""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray

from oilfilm.bearing.dynamics.statistics import AVERAGED_SHARE, angle_by_load, spin_speeds
from oilfilm.bearing.quasistatic.solution import ball_spin_without_slip, cage_speed_without_slip
from oilfilm.ehl.units import to_si

from ..netcdf_write import open_netcdf
from .history import FORMAT, HISTORY_FILE

RUNNING = 0.02  # of the largest speed, below which a slip in percent says nothing [-]


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


class Motion(NamedTuple):
    """A speed over time [rad/s], shape (m,), of balls (m, Z), and the same without sliding."""

    speed: Any
    without_slip: Any  # (m,)

    @property
    def slip(self) -> Any:
        """Deficit over the speed without sliding [-]; NaN where hardly anything turns."""
        size = np.abs(self.without_slip)
        rolling = np.where(size > RUNNING * size.max(), self.without_slip, np.nan)
        return 1.0 - self.speed / (rolling if np.ndim(self.speed) == 1 else rolling[:, None])


class Speeds(NamedTuple):
    """Motions of a simulation over its samples."""

    cage: Motion
    orbit: Motion  # of the balls about the axis
    spin: Motion  # of the balls about their own axes, in the frame that goes round with them


def simulated_speeds(data: xarray.Dataset, document: dict[str, Any]) -> Speeds:
    """Speeds of cage and balls, and those without sliding at the mean contact angle of each
    sample.

    Parameters
    ----------
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Speeds
        Speeds over the samples.
    """
    cage = data["cage_velocity"].sel(cage_coordinate="rotation").to_numpy()
    orbit = orbit_speed(data)
    spin = spin_speeds(data["ball_angular_velocity"].to_numpy(), orbit)
    inner, outer = ring_speeds(data, document)
    ratio = float(data.attrs["ball_diameter"]) / float(data.attrs["pitch_diameter"])
    gamma = ratio * np.cos(contact_angle(data))
    rolling = cage_speed_without_slip(gamma, inner, outer)
    turning = ball_spin_without_slip(ratio, gamma, inner, outer)
    return Speeds(Motion(cage, rolling), Motion(orbit, rolling), Motion(spin, turning))


def orbit_speed(data: xarray.Dataset) -> Any:
    """Angular speed of each ball's centre about the axis.

    Parameters
    ----------
    data : xarray.Dataset
        History of a simulation, SI.

    Returns
    -------
    Any
        Speed, shape (m, Z) [rad/s].
    """
    place = data["ball_position"].to_numpy()
    speed = data["ball_velocity"].to_numpy()
    turn = place[..., 1] * speed[..., 2] - place[..., 2] * speed[..., 1]
    return turn / (place[..., 1] ** 2 + place[..., 2] ** 2)


def contact_angle(data: xarray.Dataset) -> Any:
    """Mean contact angle of each sample, weighed by the loads.

    Parameters
    ----------
    data : xarray.Dataset
        History of a simulation, SI.

    Returns
    -------
    Any
        Angle, shape (m,) [rad]; that of the last loaded sample where no ball is loaded.
    """
    loads = data["contact_load"].to_numpy().astype(np.float64)
    angles = angle_by_load(loads, data["contact_contact_angle"].to_numpy())
    loaded = np.flatnonzero(loads.sum(axis=(1, 2)) > 0.0)
    if not loaded.size:
        return angles
    place = np.searchsorted(loaded, np.arange(angles.size), side="right") - 1
    return angles[loaded[np.maximum(place, 0)]]


def ring_speeds(data: xarray.Dataset, document: dict[str, Any]) -> tuple[Any, Any]:
    """Speeds of both rings over the samples.

    Parameters
    ----------
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    value
        Speed of the inner ring by the angle that it turned, shape (m,) [rad/s].
    value
        Speed of the outer ring by the case, shape (m,) [rad/s].
    """
    time = data["time"].to_numpy()
    case = document["case"]
    table = (case.get("dynamics") or {}).get("outer_speed_table_rpm")
    outer = case["operation"].get("outer_speed_rpm") or 0.0
    outer = np.interp(time, *np.transpose(table)) if table else np.full(time.shape, outer)
    turned = data["ring_rotation"].to_numpy()
    inner = np.gradient(turned, time) if time.size > 1 else turned / time
    return inner, to_si("speed_rpm", outer)


def averaged(data: xarray.Dataset) -> Any:
    """Samples over which the means of the summary are taken.

    Parameters
    ----------
    data : xarray.Dataset
        History of a simulation, SI.

    Returns
    -------
    Any
        True at these samples, shape (m,).
    """
    time = data["time"].to_numpy()
    return time >= (1.0 - AVERAGED_SHARE) * time[-1]
