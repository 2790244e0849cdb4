"""Films of a traction table on disk while it grows, so that an interrupted one goes on."""

import pickle
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ehl.traction.table.film import FilmSample, film_sample
from ehl.traction.table.table import TableContact, TableRange

from ..keys import content_key
from ..store import write_file

Place = tuple[float, float]
# what arrays are put together from, beside the classes of `ehl`
OF_ARRAYS = frozenset(("_reconstruct", "_frombuffer", "scalar", "ndarray", "dtype"))


class _Reader(pickle.Unpickler):
    """Reads arrays and the classes of `ehl`, nothing else: a file may come from anywhere."""

    def find_class(self, module: str, name: str) -> Any:
        found = super().find_class(module, name)
        package = module.partition(".")[0]
        own = package == "ehl" and isinstance(found, type)
        if own or (package == "numpy" and name in OF_ARRAYS):
            return found
        raise pickle.UnpicklingError(f"{module}.{name}")


def kept_films(folder: Path) -> Callable[[TableContact, TableRange, Place, int], FilmSample]:
    """`film_sample` that looks into `folder` first and leaves there what it solves [N], [m/s].

    A damaged file is solved anew; OSError where the disk takes no more, and hence no table either.
    """

    def sample(contact: TableContact, limits: TableRange, place: Place, points: int) -> FilmSample:
        path = folder / f"{content_key(contact, limits, place, points)}.film"
        found = _read(path)
        if found is None:
            found = film_sample(contact, limits, place, points)
            folder.mkdir(parents=True, exist_ok=True)
            write_file(path, pickle.dumps(found))
        return found

    return sample


def _read(path: Path) -> FilmSample | None:
    """The film of a file; None where there is none or it is damaged."""
    try:
        with path.open("rb") as stream:
            found = _Reader(stream).load()
    except FileNotFoundError:
        return None
    except Exception:  # of whatever a damaged file makes a reader stumble over
        return None
    return found if isinstance(found, FilmSample) else None


def forget_films(folder: Path) -> None:
    """Remove the films of a table that is complete."""
    shutil.rmtree(folder, ignore_errors=True)
