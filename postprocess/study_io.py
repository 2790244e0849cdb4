"""Slip maps and stiffness over speed as netCDF files, SI, for `open_results`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bearing.slip import slip_factors

from .results_io import Variables, root_attributes, write_dataset
from .summary_bearing import STIFFNESS_ORDER

if TYPE_CHECKING:
    from .slip_results import SlipResults
    from .stiffness_results import StiffnessResults

MIXED = "SI: N, m, rad, N m"


def write_slip_netcdf(results: SlipResults, path: Path, document: dict[str, Any]) -> None:
    """Write slip factors [-] over `speed` [rad/s], `axial_load` [N] and ball, critical and minimum loads [N].

    Parameters
    ----------
    results : SlipResults
    path : Path
    document : dict
        Its summary.
    """
    surface, state = results.surface, results.state
    speed, load, number = {"units": "rad/s"}, {"units": "N"}, {"units": "1"}
    found: Variables = {
        "speed": (("speed",), surface.speeds, speed),
        "axial_load": (("axial_load",), surface.axial_loads, load),
        "ball": (("ball",), np.arange(1, state.bearing.balls + 1), {}),
        "slip_factor": (("speed", "axial_load", "ball"), surface.factors, number),
        "operation_slip_factor": (("ball",), slip_factors(state), number),
        "operation_inner_load": (("ball",), np.asarray(state.inner_load, dtype=float), load),
        "operation_centrifugal_force": (("ball",), np.asarray(state.centrifugal_force, dtype=float), load),
        "minimum_speed": (("minimum_speed",), results.minimum.speeds, speed),
    }
    for name, values in results.minimum.columns().items():
        if values is not None:
            found[f"minimum_load_{name.removesuffix('_N')}"] = (("minimum_speed",), values, load)
    if results.curves:
        found["critical_speed"] = (("critical_speed",), np.array([c.speed for c in results.curves]), speed)
        found["critical_radial_load"] = (("critical_radial_load",), np.asarray(results.curves[0].radial_loads), load)
        axial = np.stack([curve.axial_loads for curve in results.curves])
        found["critical_axial_load"] = (("critical_speed", "critical_radial_load", "ball"), axial, load)
    coordinates = {"speed", "axial_load", "ball", "minimum_speed", "critical_speed", "critical_radial_load"}
    attributes = root_attributes(document, "slip") | {"limit": results.limit}
    write_dataset(found, coordinates & set(found), attributes, path)


def write_stiffness_netcdf(results: StiffnessResults, path: Path, document: dict[str, Any]) -> None:
    """Write stiffness and place of the ring over `speed` [rad/s]; arguments as `write_slip_netcdf`."""
    study, freedoms = results.study, np.array(STIFFNESS_ORDER, dtype=object)
    found: Variables = {
        "speed": (("speed",), np.asarray(study.speeds), {"units": "rad/s"}),
        "freedom": (("freedom",), freedoms, {}),
        "freedom_2": (("freedom_2",), freedoms, {}),
        "stiffness": (("speed", "freedom", "freedom_2"), study.matrices, {"units": MIXED}),
        "displacement": (("speed", "freedom"), study.displacements, {"units": MIXED}),
        "converged": (("speed",), study.converged.astype(np.int8), {}),
    }
    write_dataset(found, {"speed", "freedom", "freedom_2"}, root_attributes(document, "stiffness"), path)
