"""Stiffness over speed: summary, table, files for scripts and for the rotor code ROSS."""

from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from bearing.studies.stiffness import StiffnessOverSpeed
from ehl.units import MICROMETRE, MILLIRADIAN, RPM

from ..bearing.summary import STIFFNESS_ORDER
from ..files import Variables, root_attributes, write_dataset
from .ross import ross_table

ORDER = ("x", "y", "z", "ty", "tz")
UNITS = ("N/m", "N/rad", "N m/rad")
STIFFNESS_FILE = "stiffness.csv"
ROSS_FILE = "ross_bearing.csv"


@dataclass(frozen=True, slots=True, kw_only=True)
class StiffnessResults:
    """Stiffness of one case over speed.

    Attributes
    ----------
    version : str
    case : dict
        The case document as run.
    study : StiffnessOverSpeed
    damping : float
        Handed through to the rotor code [N s/m].
    messages : tuple of str
    timing : dict of float
        [s].
    """

    version: str
    case: dict[str, Any]
    study: StiffnessOverSpeed
    damping: float
    messages: tuple[str, ...]
    timing: dict[str, float]

    @property
    def converged(self) -> bool:
        """Whether there is an equilibrium at every speed."""
        return bool(self.study.converged.all())


def entry_unit(i: int, j: int) -> str:
    """Unit of an entry of the matrix: translations 0 to 2, tilts 3 and 4."""
    return UNITS[(i > 2) + (j > 2)] if (i > 2) == (j > 2) or j > 2 else "N m/m"


def stiffness_summary(results: StiffnessResults) -> dict[str, Any]:
    """The study as plain JSON in named units: speeds [r/min], matrices [N/m], [N/rad], [N m/rad]."""
    study = results.study
    points = [
        {
            "speed_rpm": float(speed / RPM),
            "converged": bool(converged),
            "stiffness": _plain(matrix),
            "displacement_um": _plain(place[:3] / MICROMETRE),
            "tilt_mrad": _plain(place[3:] / MILLIRADIAN),
        }
        for speed, converged, matrix, place in zip(
            study.speeds, study.converged, study.matrices, study.displacements, strict=True
        )
    ]
    lost = [f"not converged at {message}; its values are null" for message in study.messages]
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": results.converged,
        "messages": [*results.messages, *lost, DAMPING.format(results.damping)],
        "order": list(ORDER),
        "units": [[entry_unit(i, j) for j in range(5)] for i in range(5)],
        "points": points,
        "ross": {
            name: _plain(values) for name, values in ross_table(study, results.damping).items()
        },
        "timing_s": results.timing,
    }


DAMPING = "ross: damping {:g} N s/m as given, the equilibrium has none"


def _plain(values: Any) -> Any:
    if isinstance(values, np.ndarray):
        return [_plain(value) for value in values]
    return float(values) if isfinite(values) else None


MIXED = "SI: N, m, rad, N m"


def write_stiffness_netcdf(
    results: StiffnessResults, path: Path, document: dict[str, Any]
) -> None:
    """Write stiffness and place of the ring over `speed` [rad/s]; arguments as
    `write_slip_netcdf`.
    """
    study = results.study
    freedoms = np.array(STIFFNESS_ORDER, dtype=object)
    found: Variables = {
        "speed": (("speed",), np.asarray(study.speeds), {"units": "rad/s"}),
        "freedom": (("freedom",), freedoms, {}),
        "freedom_2": (("freedom_2",), freedoms, {}),
        "stiffness": (("speed", "freedom", "freedom_2"), study.matrices, {"units": MIXED}),
        "displacement": (("speed", "freedom"), study.displacements, {"units": MIXED}),
        "converged": (("speed",), study.converged.astype(np.int8), {}),
    }
    write_dataset(
        found, {"speed", "freedom", "freedom_2"}, root_attributes(document, "stiffness"), path
    )
