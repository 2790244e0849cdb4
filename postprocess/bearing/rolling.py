"""Rolling torque of the films in the summary, and how far the solver's boxes decide it."""

from collections.abc import Iterator

from bearing.torque.rolling_extent import RollingExtent, rolling_extent
from ehl.units import from_si

from ..quantities import values_of
from ..results import BearingResults

PARTS = ("box", "beyond_box", "beyond_extent", "within_extent", "doubling")
LARGE_SHARE = 0.05  # of the torque: from there on it is reported that the boxes decide


def rolling_block(results: BearingResults) -> dict[str, float | None]:
    """Rolling torque of the films by where their oil is [N mm].

    Null where the integrated torque is not that of films.
    """
    values = values_of(_extent(results), {f"{name}_N_mm": name for name in PARTS})
    return {key.removesuffix("_N_mm"): value for key, value in values.items()}


def rolling_messages(results: BearingResults) -> Iterator[str]:
    """Why there is nothing beyond a box, and whether the boxes decide much of the torque."""
    if any(film is None or not film.converged for film in results.solutions):
        yield "contacts.rolling_moment_N_mm: null where there is no film that converged"
    extent = _extent(results)
    if extent is None:
        yield (
            "torque_N_mm.rolling_extent: null, the integrated torque is not there or not that of "
            "solved films"
        )
        return
    if extent.within_extent is None:
        yield f"torque_N_mm.rolling_extent: null beyond the boxes, {extent.note}"
        return
    assert extent.beyond_box is not None and extent.beyond_extent is not None
    total = None if results.torque is None else results.torque.total
    torque = extent.box if total is None else total
    if max(abs(extent.beyond_box), abs(extent.beyond_extent)) > LARGE_SHARE * torque:
        box, beyond, counted, within, doubling = (
            f"{from_si('torque_N_mm', getattr(extent, name)):.4g}" for name in PARTS
        )
        yield (
            "torque_N_mm: the rolling part depends on the films' boxes: of its "
            f"{box} N mm, {counted} lie farther than half the smaller reduced radius from the "
            f"contacts, and {beyond} up to there lie beyond the boxes; oil up to that distance "
            f"gives {within} N mm, up to twice of it {doubling} more"
        )


def _extent(results: BearingResults) -> RollingExtent | None:
    torque = results.torque
    if torque is None or torque.shear is None or not torque.shear.tractions:
        return None
    return rolling_extent(results.quasistatic, results.tractions, results.solutions)
