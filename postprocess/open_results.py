"""One loader for the folders of all commands."""

import json
from difflib import get_close_matches
from pathlib import Path

import numpy as np
import xarray

from oilfilm.ehl.foreign_files import read_json

from .dynamics.history import FORMAT as HISTORY_FORMAT
from .dynamics.history import HISTORY_FILE
from .files import SUMMARY_FILE
from .netcdf_write import FIELDS_FILE, FORMAT, open_netcdf

# kinds of results, as a file names them
KINDS = tuple(
    "bearing contact batch shaft slip stiffness temperatures transient vibration".split()
)
WITH_CONTACTS = ("bearing", "contact")
FOREIGN = "is a netCDF file, but not one of oilfilm's results"


def open_results(directory: str | Path) -> xarray.DataTree:
    """Open the results of a command, by its folder or netCDF file.

    SI, but for batches, whose variables name their units; fields are read from disk when they are
    first used. `tree.attrs` has the `kind`, the program's version (`oilfilm`) and the input as
    JSON (`case`); groups of a bearing as in `write_bearing_netcdf`. Close it when done.

    Parameters
    ----------
    directory : str | Path
        Folder of the results or their netCDF file.

    Returns
    -------
    xarray.DataTree
        Groups of the file; to be closed.

    Raises
    ------
    ValueError
        Without results, or if the file is damaged, not of oilfilm, or of a newer program.

    Examples
    --------
    >>> import oilfilm
    >>> with oilfilm.open_results("6208_full_ceramic_results") as tree:  # doctest: +SKIP
    ...     print(tree.attrs["kind"], list(tree.children))
    """
    path = _data_file(Path(directory))
    tree = open_netcdf(path, xarray.open_datatree)
    problem = _foreign(tree)
    if problem:
        tree.close()
        raise ValueError(f"{path} {problem}")
    if "oilfilm_history" in tree.attrs:
        return _with_summary(tree, path)
    return _upgraded(tree)


def _data_file(path: Path) -> Path:
    """The netCDF file of a folder of results."""
    if path.is_dir():
        if (path / HISTORY_FILE).is_file() and not (path / FIELDS_FILE).exists():
            return path / HISTORY_FILE
        if (path / SUMMARY_FILE).is_file() and not (path / FIELDS_FILE).exists():
            lack = f"holds {SUMMARY_FILE}, but no {FIELDS_FILE}"
            raise ValueError(f"{path} {lack}: compute it again with this version")
        path = path / FIELDS_FILE
    if not path.is_file():
        raise ValueError(f"{path.parent} holds no results: {path.name} is missing")
    return path


def _with_summary(tree: xarray.DataTree, path: Path) -> xarray.DataTree:
    """A history with what its summary says; without one the simulation was not finished."""
    tree.attrs["kind"] = "dynamics"
    try:
        document = read_json(path.with_name(SUMMARY_FILE))
        converged = int(document["converged"])
        messages = list(document["messages"])
    except (OSError, ValueError, KeyError, TypeError):
        converged = 0
        messages = [f"not converged: no readable {SUMMARY_FILE} beside {path.name}"]
    tree.attrs["converged"] = converged
    tree.attrs["messages"] = json.dumps(messages, ensure_ascii=False)
    return tree


def _upgraded(tree: xarray.DataTree) -> xarray.DataTree:
    """Add what an older format left out: in format 1 the grid's x lies along the entrainment."""
    for node in tree.subtree if tree.attrs["oilfilm_format"] < FORMAT else ():
        if "entrainment_angle" in node.attrs:
            node.attrs.setdefault("frame_angle", node.attrs["entrainment_angle"])
    return tree


def _foreign(tree: xarray.DataTree) -> str:
    """Say why the file is not one that this version reads; empty if it is."""
    history = "oilfilm_history" in tree.attrs
    written = tree.attrs.get("oilfilm_history" if history else "oilfilm_format")
    available = HISTORY_FORMAT if history else FORMAT
    if not isinstance(written, (int, np.integer)):
        return FOREIGN
    if written > available:
        by = f"was written by oilfilm {tree.attrs.get('oilfilm', 'newer')} in format {written}"
        return f"{by}; this version reads formats up to {available}"
    return "" if history or tree.attrs.get("kind") in KINDS else FOREIGN


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
    if kind not in WITH_CONTACTS:
        allowed = ", ".join(WITH_CONTACTS)
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
