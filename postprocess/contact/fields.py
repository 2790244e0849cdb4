"""The fields of contacts, read back from a result folder by their names."""

from difflib import get_close_matches
from pathlib import Path
from typing import Any

import xarray

from ehl import ContactSolution
from ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, from_si, unit_of

from ..reader import open_results

KINDS = ("bearing", "contact")  # of results that have contacts
# suffix of the unit in which a variable is shown, by its name and its unit in the file
SHOWN_UNITS = {("x", "m"): "mm", ("h", "m"): "um", ("P", "Pa"): "GPa", ("T", "K"): "C"}


def shown(name: str, unit: str, values: Any) -> tuple[Any, str]:
    """Values of a variable in the unit in which it is shown, and that unit; y is named as x."""
    suffix = SHOWN_UNITS.get((name, unit))
    key = f"{name}_{suffix}"
    return (values, unit) if suffix is None else (from_si(key, values), unit_of(key))


def shown_scales(solution: ContactSolution) -> tuple[float, float, float]:
    """Scales of lengths [mm], films [um] and pressures [GPa]; 1 where the solution has none."""
    a = solution.semi_axis_x
    h = solution.film_scale
    length = 1.0 if a is None else a / MILLIMETRE
    film = 1.0 if h is None else h / MICROMETRE
    pressure = solution.hertz_pressure / GIGAPASCAL if solution.hertz_pressure > 0.0 else 1.0
    return length, film, pressure


def require_contacts(directory: str | Path, tree: xarray.DataTree, lack: str) -> None:
    """ValueError for results of a kind without contacts, which says what they lack."""
    kind = tree.attrs["kind"]
    if kind not in KINDS:
        allowed = ", ".join(KINDS)
        raise ValueError(
            f"{directory} holds results of kind {kind}, which have no {lack}; allowed: {allowed}"
        )


def film_maps(tree: xarray.DataTree) -> dict[str, xarray.DataTree]:
    """Contacts with a film by their names, such as `ball01/inner`."""
    leaves = tree["contacts"].leaves if "contacts" in tree.children else ()
    names = {leaf.path.removeprefix("/contacts/"): leaf for leaf in leaves}
    return {name: leaf for name, leaf in names.items() if "h" in leaf.data_vars}


def open_contact(directory: str | Path, contact: str | None = None) -> tuple[str, xarray.Dataset]:
    """Name and fields of one contact, `ball01/inner` or `contact`; the first with a film if None.

    ValueError if there are no fields, or none of this name; the message names the nearest.
    """
    with open_results(directory) as tree:
        films = film_maps(tree)
        if not films:
            raise ValueError(f"{directory} holds no film maps")
        name = next(iter(films)) if contact is None else contact
        if name not in films:
            matches = get_close_matches(name, films, n=1, cutoff=0.3)
            hint = f"did you mean {matches[0]!r}?" if matches else f"there are {', '.join(films)}"
            raise ValueError(f"{directory} has no film map of {name!r}; {hint}")
        return name, films[name].to_dataset(inherit=False).load()
