"""The fields of contacts, read back from a result folder by their names."""

from difflib import get_close_matches
from pathlib import Path

import xarray

from ..netcdf.reader import open_results
from .view import half_extents, shown_part

KINDS = ("bearing", "contact")  # of results that have contacts


def require_contacts(directory: str | Path, tree: xarray.DataTree, lack: str) -> None:
    """Refuse results of a kind without contacts.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    tree : xarray.DataTree
        Opened results.
    lack : str
        What such results lack, for the message.

    Raises
    ------
    ValueError
        If results of this kind have no contacts.
    """
    kind = tree.attrs["kind"]
    if kind not in KINDS:
        allowed = ", ".join(KINDS)
        raise ValueError(
            f"{directory} holds results of kind {kind}, which have no {lack}; allowed: {allowed}"
        )


def film_maps(tree: xarray.DataTree) -> dict[str, xarray.DataTree]:
    """Contacts with a film by their names, such as `ball01/inner`.

    Parameters
    ----------
    tree : xarray.DataTree
        Opened results.

    Returns
    -------
    dict[str, xarray.DataTree]
        Groups by the name of the contact.
    """
    leaves = tree["contacts"].leaves if "contacts" in tree.children else ()
    names = {leaf.path.removeprefix("/contacts/"): leaf for leaf in leaves}
    return {name: leaf for name, leaf in names.items() if "h" in leaf.data_vars}


def open_contact(directory: str | Path, contact: str | None = None) -> tuple[str, xarray.Dataset]:
    """Name and fields of one contact.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    contact : str | None, optional
        `ball01/inner` or `contact`; the first with a film if None.

    Returns
    -------
    value
        Name of the contact.
    value
        Its fields, in memory.

    Raises
    ------
    ValueError
        If there are no fields, or none of this name.
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


def shown_nodes(data: xarray.Dataset) -> tuple[slice, slice]:
    """Index ranges of the nodes shown of a contact's data set.

    Parameters
    ----------
    data : xarray.Dataset
        Fields of a contact.

    Returns
    -------
    value
        Range along the entrainment.
    value
        Range across it.
    """
    a = float(data.attrs["semi_axis_x"])
    kappa = float(data.attrs["semi_axis_y"]) / a
    half_x, half_y = half_extents(float(data.attrs["frame_angle"]), kappa)
    return shown_part(data["x"].values, data["y"].values, data["P"].values, a * half_x, a * half_y)
