"""Solved contacts on disk, named after all they depend on: equal ones are solved once."""

from collections.abc import Callable
from pathlib import Path

from ehl import ContactConditions, ContactSolution, SolverOptions

from ...format.film_model import FilmPhysics
from ...runs.interrupt import print_message
from ..keys import content_key
from .kept import load_object, store_object

SUFFIX = ".contact"
MOST_BYTES = 4_000_000_000  # the contacts of a batch grow no further
# written by this process between two looks at how large all of them are: the looks of a batch take
# a time that grows with its contacts, not with their square [bytes]
BETWEEN = MOST_BYTES // 40

Solver = Callable[[ContactConditions, SolverOptions, FilmPhysics], ContactSolution]


class ContactCache:
    """The contacts of a folder: looked up there first, and left there when they are solved."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._free = 0  # bytes that may be written before the next look

    def solve(
        self, conditions: ContactConditions, options: SolverOptions, films: FilmPhysics
    ) -> ContactSolution:
        """The film of a contact by a film model, from disk where it was solved before.

        Parameters
        ----------
        conditions : ContactConditions
            The contact.
        options : SolverOptions
            Grid of the solver.
        films : FilmPhysics
            Film model.

        Returns
        -------
        ContactSolution
            The film [m] and the pressure [Pa].
        """
        try:
            path = self.folder / f"{content_key(conditions, options, films)}{SUFFIX}"
        except TypeError:
            return films.solve(conditions, options)
        known = load_object(path)
        if isinstance(known, ContactSolution):
            return known
        if path.exists():
            print_message(f"oilfilm: {path}: damaged; the contact is solved anew")
        solution = films.solve(conditions, options)
        if self._free > 0 or self._look():
            self._free -= store_object(path, solution)
        return solution

    def _look(self) -> bool:
        """Tell whether the cache may grow further."""
        used = sum(file.stat().st_size for file in self.folder.glob(f"*{SUFFIX}"))
        self._free = BETWEEN if used < MOST_BYTES else 0
        return self._free > 0
