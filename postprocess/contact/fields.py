"""The fields of one contact, read back from a result folder by its name."""

from difflib import get_close_matches
from pathlib import Path

import xarray

from ..reader import open_results


def open_contact(directory: str | Path, contact: str | None = None) -> tuple[str, xarray.Dataset]:
    """Name and fields of one contact.

    Parameters
    ----------
    directory : str or Path
        Result folder, or its netCDF file.
    contact : str, optional
        `ball01/inner`, `contact`; the first one with a film if left out.

    Raises
    ------
    ValueError
        If there are no fields, or none of this name; the message names the nearest.
    """
    with open_results(directory) as tree:
        group = tree.children.get("contacts")
        leaves = (
            {}
            if group is None
            else {leaf.path.removeprefix("/contacts/"): leaf for leaf in group.leaves}
        )
        films = {name: leaf for name, leaf in leaves.items() if "h" in leaf.data_vars}
        if not films:
            raise ValueError(f"{directory} holds no film maps")
        name = next(iter(films)) if contact is None else contact
        if name not in films:
            near = get_close_matches(name, films, n=1, cutoff=0.3)
            hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(films)}"
            raise ValueError(f"{directory} has no film map of {name!r}; {hint}")
        return name, films[name].to_dataset(inherit=False).load()
