"""Files of the stiffness over speed, for scripts and for the rotor code ROSS."""

from pathlib import Path
from typing import Any

import numpy as np

from ehl.units import from_si

from ..files import (
    FIELDS_FILE,
    SUMMARY_FILE,
    Variables,
    attempt,
    root_attributes,
    write_csv,
    write_dataset,
    write_json,
)
from ..results import STIFFNESS_ORDER
from .plots import write_stiffness_plot
from .results import StiffnessResults
from .ross import ross_table
from .summary import entry_unit, stiffness_summary

STIFFNESS_FILE = "stiffness.csv"
ROSS_FILE = "ross_bearing.csv"
MIXED = "SI: N, m, rad, N m"


def write_stiffness(results: StiffnessResults, directory: Path) -> tuple[str, ...]:
    """Write matrices, table for ROSS, data set, summary; pictures that failed are messages."""
    directory.mkdir(parents=True, exist_ok=True)
    study = results.study
    names = [
        f"k {a} {b} [{entry_unit(i, j)}]"
        for i, a in enumerate(STIFFNESS_ORDER)
        for j, b in enumerate(STIFFNESS_ORDER)
    ]
    matrices = study.matrices.reshape(len(study.speeds), len(names))
    rows = np.column_stack([from_si("speeds_rpm", study.speeds), matrices])
    write_csv(directory / STIFFNESS_FILE, ["speed [r/min]", *names], rows)
    ross = ross_table(study, results.damping)
    write_csv(directory / ROSS_FILE, ross, np.column_stack(list(ross.values())))
    problems = attempt("plots", lambda: write_stiffness_plot(results, directory))
    document = stiffness_summary(results)
    document["messages"] += problems
    write_stiffness_netcdf(results, directory / FIELDS_FILE, document)
    write_json(document, directory / SUMMARY_FILE)
    return problems


def write_stiffness_netcdf(
    results: StiffnessResults, path: Path, document: dict[str, Any]
) -> None:
    """Write stiffness and place of the ring over `speed` [rad/s]; `document` is the summary."""
    study = results.study
    freedoms = np.array(STIFFNESS_ORDER, dtype=object)
    variables: Variables = {
        "speed": (("speed",), np.asarray(study.speeds), {"units": "rad/s"}),
        "freedom": (("freedom",), freedoms, {}),
        "freedom_2": (("freedom_2",), freedoms, {}),
        "stiffness": (("speed", "freedom", "freedom_2"), study.matrices, {"units": MIXED}),
        "displacement": (("speed", "freedom"), study.displacements, {"units": MIXED}),
        "converged": (("speed",), study.converged.astype(np.int8), {}),
    }
    attributes = root_attributes(document, "stiffness")
    write_dataset(variables, {"speed", "freedom", "freedom_2"}, attributes, path)
