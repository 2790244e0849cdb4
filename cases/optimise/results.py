"""Results of an optimisation: summary, table of the designs, picture of the front."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from oilfilm.ehl.version import version
from oilfilm.postprocess.batch.plots import Designs, write_front
from oilfilm.postprocess.files import write_csv, write_json

from ..runs.output_directory import write_digests
from .search import confirmation_messages, improvement
from .study import Design, OptimisationResult

SUMMARY = "summary.json"
TABLE = "designs.csv"
PICTURE = "plots/front.png"


def optimisation_summary(found: OptimisationResult) -> dict[str, Any]:
    """The document of an optimisation; converged if a design meets the constraints.

    Parameters
    ----------
    found : OptimisationResult
        Result of the optimisation.

    Returns
    -------
    dict[str, Any]
        The summary.
    """
    study = found.study
    return {
        "oilfilm": version(),
        "kind": "optimisation",
        "title": study.title,
        "case": study.case,
        "study": study.text,
        "converged": bool(found.front),
        "messages": list(_messages(found)),
        "keys": list(study.keys),
        "goals": [
            {"name": name, "wanted": "small" if sign > 0 else "large"}
            for name, sign in study.goals
        ],
        "best": found.front[0] if found.front else None,
        "front": list(found.front),
        "designs": [asdict(design) for design in found.designs],
        "proof": [{"name": name} | asdict(design) for name, design in found.confirmed],
        "coarse_proof": [{"name": name} | asdict(design) for name, design in found.coarse],
        "improvement": improvement(found),
    }


def _messages(found: OptimisationResult) -> list[str]:
    study = found.study
    messages = []
    if not found.front:
        messages.append("not converged: no design meets the constraints; widen ranges or limits")
    messages += confirmation_messages(found)
    if len(study.deviations) > 1:
        points = len(study.deviations)
        messages.append(
            f"goals and constraints: quantile {study.quantile:g} of {points} points each"
        )
    return messages


def write_optimisation(found: OptimisationResult, directory: Path) -> dict[str, Any]:
    """Write table, picture and, last, the summary.

    Parameters
    ----------
    found : OptimisationResult
        Result of the optimisation.
    directory : Path
        Folder of the results.

    Returns
    -------
    dict[str, Any]
        The summary.
    """
    study = found.study
    names = [name for name in _names(found.designs) if name not in study.keys]
    header = ["design", *study.keys, *names, "feasible", "front"]
    rows = [
        [
            design.number,
            *(design.values[key] for key in study.keys),
            *(design.numbers[name] for name in names),
            design.feasible,
            design.number in found.front,
        ]
        for design in found.designs
    ]
    write_csv(directory / TABLE, header, rows)
    write_front(_drawn(found), directory / PICTURE)
    document = optimisation_summary(found)
    write_json(document, directory / SUMMARY)
    write_digests(directory, (TABLE, PICTURE, SUMMARY))
    return document


def _names(designs: Sequence[Design]) -> list[str]:
    return list(designs[0].numbers) if designs else []


def _drawn(found: OptimisationResult) -> Designs:
    study = found.study
    goals = study.goals[:2]
    missing = float("nan")
    values = [[d.numbers[n] for n, _ in goals] for d in found.designs]
    return Designs(
        title=study.title,
        names=[name for name, _ in goals],
        signs=[sign for _, sign in goals],
        goals=np.array([[missing if v is None else v for v in row] for row in values]),
        errors=np.array([[d.errors.get(n, 0.0) for n, _ in goals] for d in found.designs]),
        feasible=[design.feasible for design in found.designs],
        front=[design.number in found.front for design in found.designs],
        case=None if study.position_of_case() is None else 0,
    )
