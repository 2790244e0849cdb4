"""PNG plots of a run: distinct contacts, film and pressure per azimuth, load zone, torque."""

from collections.abc import Callable, Iterator
from functools import partial
from math import degrees
from pathlib import Path

from matplotlib.figure import Figure

from .bearing.plots import draw_load_zone, draw_per_azimuth
from .bearing.plots_torque import draw_torque
from .contact.plots import draw_contact, film_text
from .contact.view import ContactView, contact_view
from .plot_style import write_figures
from .results import BearingResults, ContactResults, DistinctContact, distinct_contacts

NamedFigure = tuple[str, Callable[[Figure], None]]

PLOT_FOLDER = "plots"


def write_plots(results: BearingResults | ContactResults, directory: Path) -> tuple[str, ...]:
    """Draw every plot of a run into its folder `plots`; equal contacts are drawn once.

    Returns
    -------
    tuple of str
        Which figures could not be drawn and why; the others are there.
    """
    folder = directory / PLOT_FOLDER
    figures = (
        _contact_figures(results)
        if isinstance(results, ContactResults)
        else _bearing_figures(results)
    )
    return write_figures(folder, figures, f"{PLOT_FOLDER}/")


def _contact_figures(results: ContactResults) -> Iterator[NamedFigure]:
    solution = results.solution
    view = contact_view(results.solution)
    facts = (
        f"$M$ = {solution.moes_load:.4g}, $L$ = {solution.moes_lubricant:.4g}, {film_text(view)}"
    )
    title = f"{results.case.get('title', '')}\n{facts}{_doubts(view)}"
    yield "contact", partial(draw_contact, view=view, title=title)


def _bearing_figures(results: BearingResults) -> Iterator[NamedFigure]:
    yield "load_zone", partial(draw_load_zone, results=results)
    if results.torque is not None and results.torque.total is not None:
        yield "torque", partial(draw_torque, results=results)
    groups = distinct_contacts(results)
    for quantity in ("film", "pressure") if groups else ():
        yield (
            f"{quantity}_per_azimuth",
            partial(draw_per_azimuth, results=results, quantity=quantity),
        )
    for group in groups:
        first = group.contacts[0]
        view = contact_view(group.solution)
        name = f"{first.race.value}_ball{first.ball:02d}"
        yield name, partial(draw_contact, view=view, title=_title(results, group))


def _title(results: BearingResults, group: DistinctContact) -> str:
    first = group.contacts[0]
    view = contact_view(group.solution)
    facts = [
        f"$Q$ = {first.load:.4g} N",
        f"contact angle {degrees(first.contact_angle):.1f}°",
        film_text(view),
    ]
    return f"{results.case.get('title', '')}\n{group.label}\n{', '.join(facts)}{_doubts(view)}"


def _doubts(view: ContactView) -> str:
    return f" ({view.doubt})" if view.doubt else ""
