"""Oil supply of a single contact: its film where the inlet layer starves it."""

from collections.abc import Iterator
from typing import Any

from bearing.supply.supply import compression, starvation_law
from ehl import ContactConditions, ContactSolution
from ehl.units import from_si, to_si

from .results import ContactResults

KEYS = ("starved_film_share", "starved_film_central_um", "starved_film_minimum_um")
SOLVED = (
    "inlet_ratio",
    "meniscus_position",
    "rolling_moment_ratio",
    "damping_ratio",
    "outlet_layer",
)
NAMES = ("central", "minimum")
OUTLET_POINTS = 64  # of the layer left behind in the summary, at least
LAW_MESSAGE = (
    "supply: inlet film, by the law of starvation: film_... are the films that it leaves of "
    "flooded_film_..., their error bars hold its own; pressure and shear are those of the flooded "
    "pressure; meniscus_position, outlet_layer: null, the law knows none"
)
OUTSIDE_MESSAGE = (
    "the contact lies outside those that the law of starvation was solved for; it takes the "
    "nearest ones, with wider error bars"
)


def contact_starved_values(results: ContactResults) -> dict[str, Any]:
    """Starved films over the flooded ones [-] and in [um]; None without an inlet film.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    left = {"outlet_layer": _outlet_layer(results.solution)}
    return {**_films_left(results), **_flooded_films(results.solution), **left}


def _outlet_layer(solution: ContactSolution) -> dict[str, Any] | None:
    """Oil that leaves the box over the axis across, at ambient density; in Moes' groups over the
    semi-axis along x; None where no film was solved behind a layer.
    """
    supply = solution.supply if solution.converged else None
    if supply is None or supply.outlet_layer is None:
        return None
    step = max(solution.Y.size // OUTLET_POINTS, 1)
    y, layer = solution.Y[::step], supply.outlet_layer[::step]
    if solution.semi_axis_x is None or solution.film_scale is None:
        return {"y_dimensionless": y.tolist(), "layer_dimensionless": layer.tolist()}
    return {
        "y_mm": [from_si("y_mm", value) for value in y * solution.semi_axis_x],
        "layer_um": [from_si("film_um", value) for value in layer * solution.film_scale],
    }


def _films_left(results: ContactResults) -> dict[str, float | None]:
    solution = results.solution
    if solution.supply is not None and solution.converged:
        flooded = solution.supply.flooded_central.value
        share = solution.film_central_dimensionless.value / flooded
        values = (share, solution.film_central, solution.film_minimum)
        return {key: from_si(key, value) for key, value in zip(KEYS, values, strict=True)}
    layer = results.case.get("lubricant", {}).get("inlet_film_um")
    central, minimum = solution.film_central, solution.film_minimum
    if layer is None or central is None or minimum is None or solution.supply is not None:
        return dict.fromkeys(KEYS)
    given = solution.conditions
    assert isinstance(given, ContactConditions)  # the film has a length
    compressed = compression(solution.hertz_pressure, given.lubricant) * central
    shares = starvation_law(given, compressed)(to_si("inlet_film_um", layer) / compressed)
    share = shares.central.value
    values = (share, share * central, shares.minimum_film(central, minimum))
    return {key: from_si(key, value) for key, value in zip(KEYS, values, strict=True)}


def _flooded_films(solution: ContactSolution) -> dict[str, float | None]:
    """Flooded films and their uncertainties in the same box [a^2/Rx]."""
    supply = solution.supply if solution.converged else None
    values: dict[str, float | None] = {}
    for name in NAMES:
        film = None if supply is None else getattr(supply, f"flooded_{name}")
        for quantity, part in (("", "value"), ("_uncertainty", "uncertainty")):
            number = None if film is None else getattr(film, part)
            values[f"flooded_film_{name}{quantity}_dimensionless"] = number
    return values


def contact_supply_messages(results: ContactResults) -> Iterator[str]:
    """Name the starved numbers, or the reason why there are none.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Yields
    ------
    Iterator[str]
        A message.
    """
    solution = results.solution
    given = results.case.get("lubricant", ())
    solved = f"flooded_film_..., {', '.join(SOLVED)}"
    if solution.supply is not None and solution.supply.law is not None:
        yield LAW_MESSAGE
        if not solution.supply.law.inside:
            yield f"supply: {OUTSIDE_MESSAGE}"
    elif solution.supply is not None:
        if solution.supply.meniscus is None:
            yield "meniscus_position: null, the layer is thicker than the gap where the box begins"
        if solution.conditions.inlet_layer is not None and solution.film_scale is None:
            yield "starved_film_..._um: null, the case gives no lengths"
    elif solution.conditions.inlet_layer is not None:
        yield f"starved_film_..., {solved}: null, the flooded film did not converge"
    elif not {"inlet_film_um", "inlet_film_dimensionless"} & set(given):
        yield f"starved_film_..., {solved}: null, the supply is flooded"
    elif solution.converged:
        keys = (
            "starved are starved_film_... alone, by the law of starvation; all else is of the "
            "flooded film"
        )
        yield f"supply: inlet film; {keys}"
        yield f"{solved}: null, they need a film behind its layer (ehl.starvation)"
    else:
        yield f"starved_film_..., {solved}: null, the flooded film did not converge"
