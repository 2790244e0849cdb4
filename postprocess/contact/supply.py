"""Oil supply of a single contact: its film where the inlet layer starves it."""

from collections.abc import Iterator
from math import cos, hypot, sin

from bearing.supply.supply import compression, starvation_exponent, starved_share
from ehl import ContactConditions
from ehl.units import from_si, to_si

from .results import ContactResults

KEYS = ("starved_film_share", "starved_film_central_um", "starved_film_minimum_um")


def contact_starved_values(results: ContactResults) -> dict[str, float | None]:
    """Share of the flooded film [-] and the films left [um]; None without an inlet film."""
    solution = results.solution
    layer = results.case.get("lubricant", {}).get("inlet_film_um")
    central, minimum = solution.film_central, solution.film_minimum
    if layer is None or central is None or minimum is None or not solution.converged:
        return dict.fromkeys(KEYS)
    given = solution.conditions
    assert isinstance(given, ContactConditions)  # the film has a length
    along, across = cos(given.entrainment_angle), sin(given.entrainment_angle)
    ratio = hypot(across, solution.semi_axis_ratio * along) / hypot(
        along, solution.semi_axis_ratio * across
    )
    packed = compression(solution.hertz_pressure, given.lubricant) * central
    share = starved_share(to_si("inlet_film_um", layer) / packed, starvation_exponent(ratio))
    values = (share, share * central, share * minimum)
    return {key: from_si(key, value) for key, value in zip(KEYS, values, strict=True)}


def contact_supply_messages(results: ContactResults) -> Iterator[str]:
    """Which numbers are starved, or why none is."""
    if "inlet_film_um" not in results.case.get("lubricant", ()):
        yield "starved_film_...: null, the supply is flooded"
    elif results.solution.converged:
        keys = "starved are starved_film_... alone, all else is that of the flooded film"
        yield f"supply: inlet film; {keys}"
    else:
        yield "starved_film_...: null, the flooded film did not converge"
