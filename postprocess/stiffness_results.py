"""Stiffness over speed: summary, table, files for scripts and for the rotor code ROSS."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from bearing.stiffness import StiffnessOverSpeed, ross_table

from .results_io import FIELDS_FILE, SUMMARY_FILE, atomic_path, write_json
from .study_io import write_stiffness_netcdf
from .units import MICROMETRE, MILLIRADIAN, RPM

ORDER = ("x", "y", "z", "ty", "tz")
UNITS = ("N/m", "N/rad", "N m/rad")
STIFFNESS_FILE, ROSS_FILE = "stiffness.csv", "ross_bearing.csv"


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
        "ross": {name: _plain(values) for name, values in ross_table(study, results.damping).items()},
        "timing_s": results.timing,
    }


DAMPING = "ross: damping {:g} N s/m as given, the equilibrium has none"


def _plain(values: Any) -> Any:
    if isinstance(values, np.ndarray):
        return [_plain(value) for value in values]
    return float(values) if isfinite(values) else None


def write_stiffness(results: StiffnessResults, directory: Path) -> tuple[str, ...]:
    """Write the matrices, the table for ROSS, the picture and the summary.

    Parameters
    ----------
    results : StiffnessResults
    directory : Path

    Returns
    -------
    tuple of str
        What could not be drawn.
    """
    from .plots_stiffness import write_stiffness_plot

    directory.mkdir(parents=True, exist_ok=True)
    study = results.study
    names = [f"k {a} {b} [{entry_unit(i, j)}]" for i, a in enumerate(ORDER) for j, b in enumerate(ORDER)]
    rows = np.column_stack([study.speeds / RPM, study.matrices.reshape(len(study.speeds), 25)])
    _write_csv(directory / STIFFNESS_FILE, ["speed [r/min]", *names], rows)
    ross = ross_table(study, results.damping)
    _write_csv(directory / ROSS_FILE, list(ross), np.column_stack(list(ross.values())))
    write_stiffness_plot(results, directory)
    document = stiffness_summary(results)
    write_stiffness_netcdf(results, directory / FIELDS_FILE, document)
    write_json(document, directory / SUMMARY_FILE)
    return ()


def _write_csv(path: Path, header: list[str], rows: Any) -> None:
    with atomic_path(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        for row in rows:
            writer.writerow([repr(float(value)) if isfinite(value) else "" for value in row])
