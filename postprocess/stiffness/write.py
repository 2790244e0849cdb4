"""Files of the stiffness over speed, for scripts and for the rotor code ROSS."""

from pathlib import Path

import numpy as np

from ..files import Table
from ..netcdf.groups import Variables
from ..netcdf.study import SPEED_COLUMN, StudyFiles, write_study
from ..results import STIFFNESS_ORDER, STIFFNESS_UNITS
from .plots import write_stiffness_plot
from .results import StiffnessResults
from .ross import ross_table
from .summary import SPEED, stiffness_summary

MIXED = {"units": "SI: N, m, rad, N m"}


def write_stiffness(results: StiffnessResults, directory: Path) -> tuple[str, ...]:
    """Write matrices, table for ROSS, data set, summary; pictures that failed are messages.

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.
    directory : Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    files = StudyFiles(
        kind="stiffness",
        document=stiffness_summary(results),
        tables=_tables(results),
        variables=_variables(results),
    )
    return write_study(files, directory, lambda: write_stiffness_plot(results, directory))


def _tables(results: StiffnessResults) -> dict[str, Table]:
    study = results.study
    names = [
        f"k {a} {b} [{unit}]"
        for a, units in zip(STIFFNESS_ORDER, STIFFNESS_UNITS, strict=True)
        for b, unit in zip(STIFFNESS_ORDER, units, strict=True)
    ]
    matrices = study.matrices.reshape(len(study.speeds), len(names))
    ross = ross_table(study, results.damping)
    return {
        "stiffness": ([SPEED_COLUMN, *names], np.column_stack([SPEED.value(study), matrices])),
        "ross_bearing": (ross, np.column_stack(list(ross.values()))),
    }


def _variables(results: StiffnessResults) -> Variables:
    """Stiffness and place of the ring over `speed` [rad/s]."""
    study = results.study
    freedoms = np.array(STIFFNESS_ORDER, dtype=object)
    return {
        "speed": (("speed",), np.asarray(study.speeds), {"units": "rad/s"}),
        "freedom": (("freedom",), freedoms, {}),
        "freedom_2": (("freedom_2",), freedoms, {}),
        "stiffness": (("speed", "freedom", "freedom_2"), study.matrices, MIXED),
        "displacement": (("speed", "freedom"), study.displacements, MIXED),
        "converged": (("speed",), study.converged.astype(np.int8), {}),
    }
