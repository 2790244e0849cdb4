"""Films of a traction table on disk while it grows, so that an interrupted one goes on."""

import shutil
from collections.abc import Callable
from pathlib import Path

from ehl.traction_table.film import FilmSample, film_sample
from ehl.traction_table.table import TableContact, TableRange

from ..keys import content_key
from .kept import load_object, store_object

Place = tuple[float, float]


def stored_film_sampler(
    folder: Path,
) -> Callable[[TableContact, TableRange, Place, int, bool], FilmSample]:
    """A film sampler that reads solved films from a folder and stores new ones there.

    A damaged file is solved anew; OSError where the disk is full, and hence no table either.

    Parameters
    ----------
    folder : Path
        Folder of the films.

    Returns
    -------
    Callable[[TableContact, TableRange, Place, int, bool], FilmSample]
        Function with the parameters of `film_sample`.
    """

    def sample(
        contact: TableContact, limits: TableRange, place: Place, points: int, response: bool = True
    ) -> FilmSample:
        path = folder / f"{content_key(contact, limits, place, points, response)}.film"
        found = load_object(path)
        if not isinstance(found, FilmSample):
            found = film_sample(contact, limits, place, points, response)
            folder.mkdir(parents=True, exist_ok=True)
            store_object(path, found)
        return found

    return sample


def remove_films(folder: Path) -> None:
    """Remove the films of a table that is complete.

    Parameters
    ----------
    folder : Path
        Folder of the films.
    """
    shutil.rmtree(folder, ignore_errors=True)
