"""Faults of points as faults of the sweep file: at the key that a point varies or fixes."""

from collections.abc import Iterable, Iterator
from typing import Any

from ...format.problems import CaseProblem, Path, shown
from ..keys import case_path
from .blocks import Variation

HIDING = {
    "bearing": (
        "ball_diameter_mm",
        "pitch_diameter_mm",
        "balls",
        "inner_groove_radius_mm",
        "outer_groove_radius_mm",
    ),
    "lubricant": ("viscosity_mPa_s", "kinematic_viscosity_mm2_s", "pressure_viscosity_1_GPa"),
}


def overridden_names(base: dict[str, Any], variations: list[Variation]) -> Iterator[CaseProblem]:
    """Problems of a bearing or an oil varied by name whose values the case itself overrides.

    Parameters
    ----------
    base : dict[str, Any]
        Document of the case.
    variations : list[Variation]
        Variations of the sweep.

    Yields
    ------
    Iterator[CaseProblem]
        A problem for each such key.
    """
    for variation in variations[:1] + variations[-1:]:
        for setting in variation.settings:
            table, *_, key = case_path(setting.key)
            own = base.get(table)
            if key != "name" or not isinstance(own, dict):
                continue
            given = [name for name in HIDING.get(table, ()) if name in own]
            if given:
                finding = f"the case itself gives {given[0]}, which overrides the library's"
                allowed = f"allowed with a case that names a {table} only"
                yield CaseProblem(setting.where, finding, allowed)


def located_faults(
    problems: Iterable[CaseProblem], variation: Variation, fixed: Variation, number: int
) -> Iterator[CaseProblem]:
    """Problems of a point at the key of the sweep file that it varies or fixes.

    Parameters
    ----------
    problems : Iterable[CaseProblem]
        Problems of the case of the point.
    variation : Variation
        Values of the point.
    fixed : Variation
        Values of all points.
    number : int
        Number of the point, from 1 [-].

    Yields
    ------
    Iterator[CaseProblem]
        The same problems with paths of the sweep file.
    """
    settings = (*variation.settings, *fixed.settings)
    for problem in problems:
        setting = next((s for s in settings if _meets(case_path(s.key), problem.path)), None)
        place = f"{'.'.join(map(str, problem.path))}: " if problem.path else ""
        if setting is None:
            values = ", ".join(f"{s.key} = {shown(s.value)}" for s in variation.settings)
            where: Path = ("case",)
            place = f"point {number} ({values}): {place}"
        else:
            where = setting.where
            place = "" if tuple(problem.path) == case_path(setting.key) else place
        yield CaseProblem(where, f"{place}{problem.finding}", problem.allowed, problem.nearest)


def _meets(path: Path, problem: Path) -> bool:
    """Tell whether a problem's path is that of a key, lies below it, or is a table around it."""
    shorter = min(len(path), len(problem))
    return shorter > 0 and path[:shorter] == tuple(problem[:shorter])
