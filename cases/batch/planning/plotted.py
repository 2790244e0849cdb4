"""The numbers that a sweep file wants to be drawn."""

from collections.abc import Iterator

from ehl.units import unit_of
from postprocess.batch.results import result_names

from ...format.problems import CaseProblem, nearest_name, shown

MOST_PANELS = 3  # of a figure


def plot_problems(names: tuple[str, ...], kind: str) -> Iterator[CaseProblem]:
    """Problems of the names of numbers to draw.

    Parameters
    ----------
    names : tuple[str, ...]
        Names of columns of batch.csv.
    kind : str
        Quantity that is computed; "contact" for a single contact.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    known = result_names(kind)
    for k, name in enumerate(names):
        if name not in known:
            allowed = "allowed: main results, torque_N_mm, supply and self_heating of batch.csv"
            longer = (whole for whole in known if whole.endswith(f".{name}"))
            nearest = next(longer, nearest_name(name, known))
            yield CaseProblem(("plot", k), f"found {shown(name)}", allowed, nearest=nearest)
        elif name in names[:k]:
            yield CaseProblem(("plot", k), f"found {shown(name)} twice", "allowed: once")
    units = [unit_of(name) for name in names]
    if 1 < len(set(units)) and (len(set(units)) < len(units) or len(units) > MOST_PANELS):
        names_of_units = ", ".join(unit or "no unit" for unit in dict.fromkeys(units))
        finding = f"found {len(units)} numbers in {names_of_units}"
        allowed = f"allowed: all in one unit, or up to {MOST_PANELS} in one unit each"
        yield CaseProblem(("plot",), finding, allowed)
