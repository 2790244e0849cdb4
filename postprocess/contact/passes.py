"""A track pass after pass: summary, message and netCDF group."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..netcdf.groups import Group, Variables
from ..quantities import quantities, values_of
from .results import ContactResults

NOT_CONVERGED = "the film of this pass did not converge"
PASS_QUANTITIES = quantities(
    "",
    NOT_CONVERGED,
    ("inlet_ratio", "layer over the oil of the flooded film", "ratio"),
    ("film_share", "central film over the flooded one", "share"),
    ("film_central_um", "central film", "solution.film_central"),
    ("film_minimum_um", "minimum film", "solution.film_minimum"),
    ("oil_kept", "oil that leaves over oil that enters", "kept"),
    ("ridge_ratio", "thickest part of the layer that leaves over its middle", "ridge_ratio"),
)


def pass_values(results: ContactResults) -> list[dict[str, Any]] | None:
    """The passes one after the other; None where the contact stands alone.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    list[dict[str, Any]] | None
        Values by key, a dictionary for each pass.
    """
    if not results.passes:
        return None
    rows = []
    for number, one in enumerate(results.passes, 1):
        available = one if one.solution.converged else None
        head = {"pass": number, "converged": one.solution.converged}
        rows.append(head | values_of(available, PASS_QUANTITIES))
    return rows


def pass_messages(results: ContactResults) -> Iterator[str]:
    """Give the reason for missing passes, or explain those there are.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Yields
    ------
    Iterator[str]
        A message.
    """
    asked = results.case.get("ehl", {}).get("track_passes")
    if asked is None:
        yield "passes: null, no ehl.track_passes"
    elif not results.passes:
        yield "passes: null, the first film did not converge"
    elif not results.passes[-1].solution.converged:
        last = results.passes[-1].solution.message
        yield f"passes: ended after {len(results.passes)} of {asked}, not converged: {last}"
    else:
        yield (
            "passes: each contact stands behind the profile that the last one left; what a mesh "
            "does not see is the side flow inside the contact, where little oil is left"
        )


def pass_group(results: ContactResults) -> Group | None:
    """Layers over y and film ratios of all passes, SI; in Moes' groups in a and a^2/Rx.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    Group | None
        The group; None without passes.
    """
    if not results.passes:
        return None
    first = results.solution
    length, scale = first.semi_axis_x, first.film_scale
    unit, layer_unit = ("m", "m") if length and scale else ("a", "a^2/Rx")

    def over(name: str) -> Any:
        rows = [np.interp(first.Y, p.solution.Y, getattr(p, name)) for p in results.passes]
        return np.array(rows) * (scale or 1.0)

    plane = ("pass", "y")
    shares = np.array([p.share if p.solution.converged else np.nan for p in results.passes])
    variables: Variables = {
        "y": (("y",), first.Y * (length or 1.0), {"units": unit}),
        "inlet_layer": (plane, over("inlet"), {"units": layer_unit}),
        "outlet_layer": (plane, over("outlet"), {"units": layer_unit}),
        "film_share": (("pass",), shares, {"units": "1"}),
    }
    return Group(variables=variables, attributes={})
