"""The case files that come with the program, and how a name finds its file."""

import tomllib
from pathlib import Path

from oilfilm.ehl.foreign_files import LARGEST_TEXT, read_file

from .rules import CaseError, nearest_name

LIBRARY = Path(__file__).parents[1] / "library"
SWEEPS = "sweeps"  # the folder whose files name a case and vary it
TABLES = "_table.zip"  # end of the names of traction tables that come with cases
OPTIMISATIONS = "optimisations"  # the folder of those that search


def shipped_cases() -> dict[str, Path]:
    """Stem to file of every shipped case, in alphabetical order."""
    others = (SWEEPS, OPTIMISATIONS)
    files = (path for path in LIBRARY.rglob("*.toml") if path.parent.name not in others)
    return {path.stem: path for path in sorted(files, key=lambda path: path.stem)}


def shipped_sweeps() -> dict[str, Path]:
    """Stem to file of every shipped sweep, in alphabetical order."""
    return {path.stem: path for path in sorted((LIBRARY / SWEEPS).glob("*.toml"))}


def table_path(name: str) -> Path:
    """A file of traction tables: from the working directory, or one that comes with the cases.

    Parameters
    ----------
    name : str
        Name of the file.

    Returns
    -------
    Path
        The path.
    """
    path = Path(name)
    if path.is_file() or path.name != name:
        return path
    return next(LIBRARY.rglob(name), path) if name.endswith(TABLES) else path


def find_case(name_or_path: str | Path, folder: Path | None = None) -> Path:
    """The file of a case: an existing file, with or without .toml, or the stem of a shipped case.

    Parameters
    ----------
    name_or_path : str or Path
        Path or name of the case.
    folder : Path, optional
        Folder in which a file of this name is looked for first.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    CaseError
        If there is none, or a name stands for two files that differ.
    """
    for name in () if folder is None else (f"{name_or_path}", f"{name_or_path}.toml"):
        if folder is not None and (folder / name).is_file():
            return folder / name
    return _find(name_or_path, shipped_cases(), "case")


def find_sweep(name_or_path: str | Path) -> Path:
    """The file of a sweep: an existing file, or the stem of a shipped one.

    Parameters
    ----------
    name_or_path : str | Path
        Path or name of the sweep.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    CaseError
        If there is none, or a name stands for two files that differ.
    """
    return _find(name_or_path, shipped_sweeps(), "sweep")


def find_optimisation(name_or_path: str | Path) -> Path:
    """The file of an optimisation: an existing file, or the stem of a shipped one.

    Parameters
    ----------
    name_or_path : str | Path
        Path or name of the optimisation.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    CaseError
        If there is none, or a name stands for two files that differ.
    """
    files = sorted((LIBRARY / OPTIMISATIONS).glob("*.toml"))
    return _find(name_or_path, {path.stem: path for path in files}, "optimisation")


def _find(name_or_path: str | Path, cases: dict[str, Path], kind: str) -> Path:
    text = str(name_or_path)
    path = Path(name_or_path)
    try:
        if path.is_file():
            return path
        own = path.with_name(f"{path.name}.toml") if path.name else path
        if own.is_file():
            return _one_of(text, own, cases.get(text), kind)
        if text in cases:
            return cases[text]
        if text.endswith(".toml") and "/" not in text and text[:-5] in cases:
            return cases[text[:-5]]
        unfit = "a directory" if path.is_dir() else "not a regular file" if path.exists() else ""
    except (OSError, ValueError) as error:  # a name too long, or with a null character
        raise CaseError(f"{text[:200]!r}: not a usable file name: {error}") from None
    if unfit:
        allowed = f"a {kind} file or the name of a shipped {kind}"
        raise CaseError(f"{text}: is {unfit}; allowed: {allowed}")
    nearest = nearest_name(path.stem, [*cases, *(local.stem for local in _local_cases(path))])
    hint = f"did you mean {nearest!r}?" if nearest else f"see 'oilfilm list {kind}s'"
    raise CaseError(f"{text}: no such file, and no shipped {kind} has this name; {hint}")


def _one_of(name: str, own: Path, shipped: Path | None, kind: str) -> Path:
    """The user's own file; `CaseError` if a shipped one of the same name says something else."""
    if shipped is not None and read_file(own, LARGEST_TEXT) != shipped.read_bytes():
        raise CaseError(
            f"{name}: {own} and the shipped {kind} {name} differ; write {own} for the file, or "
            "give it another name"
        )
    return own


def _local_cases(path: Path) -> list[Path]:
    try:
        return sorted(path.parent.glob("*.toml"))[:100]
    except OSError:
        return []


def title(path: Path) -> str:
    """Title of a case file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        The title; empty if it has none.
    """
    with path.open("rb") as file:
        return str(tomllib.load(file).get("title", ""))
