"""A solved film beside that of the atlas: what one of them has wrong the other tells."""

from collections.abc import Iterator
from dataclasses import replace

from ...solution import ContactSolution, FilmValue
from .films import AtlasValue, NotInAtlasError, atlas_films

Pair = tuple[str, FilmValue, AtlasValue]


def atlas_disagreements(solution: ContactSolution) -> Iterator[Pair]:
    """List films of a contact that differ from those of the atlas by more than both error bars.

    None is listed where the film is not resolved, was solved with shear or heat or in a prescribed
    box, or the atlas does not cover the contact.

    Parameters
    ----------
    solution : ContactSolution
        solved contact; behind an inlet film its flooded solution counts

    Yields
    ------
    Iterator[Pair]
        name, solved value [a^2/Rx] and that of the atlas ([m], or [a^2/Rx] of Moes' groups)
    """
    film = solution if solution.supply is None else solution.supply.flooded
    trusted = film.converged and film.resolved
    if not trusted or film.state is not None or film.options.domain is not None:
        return
    try:
        films = atlas_films(replace(film.conditions, inlet_layer=None))
    except NotInAtlasError:
        return
    unit = film.film_scale or 1.0
    for name, solved, tabulated in (
        ("central", film.film_central_dimensionless, films.central),
        ("minimum", film.film_minimum_dimensionless, films.minimum),
    ):
        if (
            abs(unit * solved.value - tabulated.value)
            > unit * solved.uncertainty + tabulated.uncertainty
        ):
            yield name, solved, tabulated
