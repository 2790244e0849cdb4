"""Output of a bearing that runs dry."""

from collections.abc import Iterator
from typing import Any

from oilfilm.bearing.rating.dry_surface import Range
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import from_si, unit_symbol

from ..quantities import values_of
from .bearing_quantities import DRY_RUNNING
from .results import BearingResults

UNKNOWN = (
    "dry_running: unknown and left out: seizure, debris, oxidation, moisture or vacuum where the "
    "source has another, friction and heat of the cage, "
    "hysteresis of rolling; wear spreads over decades: measure it"
)


def dry_block(results: BearingResults) -> dict[str, Any] | None:
    """Friction, heat, wear and supply of a bearing that runs dry; None of a lubricated one.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any] | None
        Values by key.
    """
    if results.dry is None:
        return None
    return {"surface": results.dry.surface.name} | values_of(results.dry, DRY_RUNNING)


def dry_messages(results: BearingResults) -> Iterator[str]:
    """Name the surface, what is known of it, and what is not.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    if results.dry is None:
        return
    surface = results.dry.surface
    yield "contacts: films, lambda_ratio and what follows from them null, the bearing runs dry"
    if surface.unverified:
        yield Caution(f"dry_running: data of {surface.name!r} are unverified: {surface.source}")
    else:
        yield f"dry_running: {surface.name!r}: {surface.source}"
    temperature = results.quasistatic.operation.temperature
    if temperature > surface.highest:
        celsius, end = (from_si("temperature_C", t) for t in (temperature, surface.highest))
        yield Caution(
            f"dry_running: {celsius:.0f} C is beyond the {end:.0f} C that the data of "
            f"{surface.name!r} reach"
        )
    yield UNKNOWN
    if results.dry.film_life is not None:
        yield (
            "dry_running.film_supply_h: an estimate: what doubles the play of the pockets, over "
            "the wear of the tracks"
        )


def dry_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    dry = results.dry
    if dry is None:
        return {}
    heat = [_text("power_W", dry.power)]
    heat += [] if dry.bulk is None else [f"{_text('rise_K', dry.bulk)} of the bearing"]
    heat += [f"flash {_text('rise_K', dry.flash)}"]
    worn = f"{_text('wear_mm3_h', dry.wear)}; inner track {_text('wear_um_h', dry.inner_depth)}"
    rows = {
        "dry running": f"{dry.surface.name}, friction {_text('', dry.friction)}",
        "dry heat": ", ".join(heat),
        "dry wear": worn,
    }
    if dry.film_life is not None:
        rows["film of cage"] = f"fed for {_text('time_h', dry.film_life)}, an estimate"
    return rows


def _text(key: str, of: Range) -> str:
    """Value with its range and unit."""
    value, low, high = (f"{from_si(key, end) if key else end:.3g}" for end in of)
    return f"{value} ({low} to {high}) {unit_symbol(key) if key else ''}".strip()
