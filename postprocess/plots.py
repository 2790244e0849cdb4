"""PNG plots of a run: one figure per distinct contact, film and pressure per azimuth, load zone."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING

from .plot_style import RC, contact_view, save
from .plots_contact import contact_figure, film_text
from .results import BearingResults, ContactResults, DistinctContact, distinct_contacts

if TYPE_CHECKING:
    from ehl import ContactSolution

PLOT_FOLDER = "plots"


def write_plots(results: BearingResults | ContactResults, directory: Path) -> tuple[Path, ...]:
    """Draw every plot of a run into its folder `plots`; equal contacts are drawn once and named together.

    Parameters
    ----------
    results : BearingResults or ContactResults
    directory : Path
        Result directory.

    Returns
    -------
    tuple of Path
        The PNG files.
    """
    folder = directory / PLOT_FOLDER
    with _style():
        if isinstance(results, ContactResults):
            return _single_contact(results, folder)
        from .plots_bearing import azimuth_figure, load_zone_figure

        written = [folder / "load_zone.png"]
        save(load_zone_figure(results), written[0])
        groups = distinct_contacts(results)
        for quantity in ("film", "pressure") if groups else ():
            written.append(folder / f"{quantity}_per_azimuth.png")
            save(azimuth_figure(results, quantity), written[-1])
        for group in groups:
            first = group.contacts[0]
            written.append(folder / f"{first.race.value}_ball{first.ball:02d}.png")
            save(contact_figure(contact_view(group.solution), _title(results, group)), written[-1])
        return tuple(written)


@contextmanager
def _style() -> Iterator[None]:
    import matplotlib

    with matplotlib.rc_context(RC):
        yield


def _single_contact(results: ContactResults, folder: Path) -> tuple[Path, ...]:
    path, solution = folder / "contact.png", results.solution
    view = contact_view(solution)
    facts = f"$M$ = {solution.moes_load:.4g}, $L$ = {solution.moes_lubricant:.4g}, {film_text(view)}"
    save(contact_figure(view, f"{results.case.get('title', '')}\n{facts}{_doubts(solution)}"), path)
    return (path,)


def _title(results: BearingResults, group: DistinctContact) -> str:
    first, view = group.contacts[0], contact_view(group.solution)
    facts = [f"$Q$ = {first.load:.4g} N", f"contact angle {degrees(first.contact_angle):.1f}°", film_text(view)]
    return f"{results.case.get('title', '')}\n{group.label}\n{', '.join(facts)}{_doubts(group.solution)}"


def _doubts(solution: ContactSolution) -> str:
    words = [
        w for w, bad in (("not converged", not solution.converged), ("not resolved", not solution.resolved)) if bad
    ]
    return f" ({', '.join(words)})" if words else ""
