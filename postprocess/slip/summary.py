"""Summary of slip maps."""

from typing import Any

from bearing.studies.slip import HIRANO_CAVEAT

from ..files import plain
from ..quantities import rows_of, values_of
from .quantities import BALLS, CURVE, MINIMUM_LOADS, OPERATION, SPEEDS, SURFACE
from .results import SlipResults


def slip_summary(results: SlipResults) -> dict[str, Any]:
    """Summary as plain JSON types, units in the keys, null where a value does not exist.

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    curves = [
        values_of(curve, CURVE)
        | {
            "axial_loads_N": [
                {"ball": ball, "values": row} for ball, row in enumerate(curve.axial_loads.T, 1)
            ]
        }
        for curve in results.curves
    ]
    minimum_preload = values_of(results.minimum, (SPEEDS, *MINIMUM_LOADS))
    document = {
        "limit": results.limit,
        "operation": _operation(results),
        "surface": values_of(results.surface, SURFACE),
        "critical_curves": curves,
        "minimum_preload": minimum_preload,
    }
    absent = [
        f"{load.key} is null: {load.null}"
        for load in MINIMUM_LOADS
        if minimum_preload[load.key] is None
    ]
    messages = (*results.problems, *absent, f"minimum preload: {HIRANO_CAVEAT}")
    head = results.head(not results.problems, messages)
    return head | dict(plain(document)) | {"timing_s": results.timing}


def _operation(results: SlipResults) -> dict[str, Any]:
    minimum = results.minimum
    own = {"minimum_preload_N": minimum.hirano, "minimum_preload_as_printed_N": minimum.as_printed}
    return {
        **values_of(results.state, OPERATION),
        **{
            key: loads[-1] if minimum.own and loads is not None else None
            for key, loads in own.items()
        },
        "balls": ball_values(results),
    }


def ball_values(results: SlipResults) -> list[dict[str, Any]]:
    """The balls at the operation of the case: loads [N], angles [deg], slip factors [-].

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.

    Returns
    -------
    list[dict[str, Any]]
        Values by key, a dictionary for each ball.
    """
    factors = results.factors
    share = results.printed_force
    columns = values_of(results.state, BALLS) | {
        "slip_factor": factors,
        "slip_factor_as_printed": [None] * len(factors) if share is None else factors / share,
        "slips": factors < results.limit,
    }
    return rows_of({"ball": range(1, len(factors) + 1)} | columns)
