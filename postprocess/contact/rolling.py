"""Rolling moments of the films in a summary, and how far the solver's boxes decide them."""

from collections.abc import Iterator

from bearing.torque.rolling_extent import RollingExtent, rolling_extent, rolling_moments
from ehl import ContactSolution
from ehl.traction.rolling_moment import RollingMoment, rolling_moment
from ehl.units import MILLIMETRE, NEWTON_MILLIMETRE

from ..results import BearingResults

CONTACT_KEYS = (
    "rolling_moment_N_mm",
    "rolling_moment_beyond_box_N_mm",
    "rolling_moment_within_extent_N_mm",
    "rolling_extent_mm",
)
TORQUE_KEYS = ("box", "beyond_box", "beyond_extent", "within_extent", "doubling")
TOLD = 0.05  # of the torque: from there on it is said that the boxes decide


def moment_values(moment: RollingMoment | None) -> dict[str, float | None]:
    """Hydrodynamic rolling moment of one contact [N mm], in its box, beyond it and within the
    extent [mm].
    """
    if moment is None:
        return dict.fromkeys(CONTACT_KEYS)
    return {
        "rolling_moment_N_mm": moment.box / NEWTON_MILLIMETRE,
        "rolling_moment_beyond_box_N_mm": _shown(moment.beyond_box),
        "rolling_moment_within_extent_N_mm": _shown(moment.within_extent),
        "rolling_extent_mm": moment.extent / MILLIMETRE,
    }


def contact_rolling_values(solution: ContactSolution) -> dict[str, float | None]:
    """As `moment_values` for a single contact; null where it has no lengths or did not converge."""
    return moment_values(_moment(solution))


def contact_rolling_messages(solution: ContactSolution) -> Iterator[str]:
    """Why a single contact has no rolling moment, or none beyond its box."""
    moment = _moment(solution)
    if moment is None:
        yield "rolling_moment_N_mm and rolling_extent_mm: null, they need lengths, and a film that converged"
    elif moment.note:
        yield f"rolling_moment_beyond_box_N_mm, rolling_moment_within_extent_N_mm: null, {moment.note}"


def rolling_values(results: BearingResults) -> list[dict[str, float | None]]:
    """As `moment_values` for every contact of a bearing; null where there is no converged film."""
    films = [film if film is not None and film.converged else None for film in results.solutions]
    return [moment_values(moment) for moment in rolling_moments(films)]


def rolling_block(results: BearingResults) -> dict[str, float | None]:
    """Rolling torque of the films by where their oil is [N mm]; null where the integrated torque
    is not of films.
    """
    found = _extent(results)
    if found is None:
        return dict.fromkeys(TORQUE_KEYS)
    return {name: _shown(getattr(found, name)) for name in TORQUE_KEYS}


def rolling_messages(results: BearingResults) -> Iterator[str]:
    """Why there is nothing beyond a box, and whether the boxes decide much of the torque."""
    if any(film is None or not film.converged for film in results.solutions):
        yield "contacts.rolling_moment_N_mm: null where there is no film that converged"
    found = _extent(results)
    if found is None:
        yield "torque_N_mm.rolling_extent: null, the integrated torque is not there or not that of solved films"
        return
    if found.within_extent is None:
        yield f"torque_N_mm.rolling_extent: null beyond the boxes, {found.note}"
        return
    assert found.beyond_box is not None and found.beyond_extent is not None
    torque = (
        found.box
        if results.torque is None or results.torque.total is None
        else results.torque.total
    )
    if max(abs(found.beyond_box), abs(found.beyond_extent)) > TOLD * torque:
        box, beyond, counted, within, doubling = (
            f"{getattr(found, name) / NEWTON_MILLIMETRE:.4g}" for name in TORQUE_KEYS
        )
        yield (
            f"torque_N_mm: the rolling part depends on the films' boxes: of its {box} N mm, {counted} lie farther than "
            f"half the smaller reduced radius from the contacts, and {beyond} up to there lie beyond the boxes; oil up "
            f"to that distance gives {within} N mm, up to twice of it {doubling} more"
        )


def _moment(solution: ContactSolution) -> RollingMoment | None:
    return (
        rolling_moment(solution)
        if solution.converged and solution.semi_axis_x is not None
        else None
    )


def _extent(results: BearingResults) -> RollingExtent | None:
    if (
        results.torque is None
        or results.torque.shear is None
        or not results.torque.shear.tractions
    ):
        return None
    return rolling_extent(results.quasistatic, results.tractions, results.solutions)


def _shown(value: float | None) -> float | None:
    return None if value is None else value / NEWTON_MILLIMETRE
