"""Files of a stiffness study."""

import csv
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from ehl.units import RPM

from ..files import FIELDS_FILE, SUMMARY_FILE, atomic_path, write_json
from .plots import write_stiffness_plot
from .results import (
    ORDER,
    ROSS_FILE,
    STIFFNESS_FILE,
    StiffnessResults,
    entry_unit,
    stiffness_summary,
    write_stiffness_netcdf,
)
from .ross import ross_table


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
    directory.mkdir(parents=True, exist_ok=True)
    study = results.study
    names = [
        f"k {a} {b} [{entry_unit(i, j)}]" for i, a in enumerate(ORDER) for j, b in enumerate(ORDER)
    ]
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
