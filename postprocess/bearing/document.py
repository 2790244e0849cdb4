"""The summary of results: the rim where the named units appear."""

from math import isfinite
from typing import Any

from ..contact.summary import contact_summary
from ..results import BearingResults, ContactResults
from .summary import bearing_summary


def summary(results: BearingResults | ContactResults) -> dict[str, Any]:
    """Results as one JSON document in named units, the keys as published.

    Parameters
    ----------
    results : BearingResults or ContactResults

    Returns
    -------
    dict
        Plain JSON types; lengths [um] or [mm], pressures [GPa], angles [deg] as the keys say. What
        does not apply is None with the reason under "messages"; no value is NaN or infinite.
    """
    document = (
        contact_summary(results)
        if isinstance(results, ContactResults)
        else bearing_summary(results)
    )
    messages = document["messages"]  # _plain adds to them
    return {
        key: messages if key == "messages" else _plain(value, key, messages)
        for key, value in document.items()
    }


def _plain(value: Any, path: str, messages: list[str]) -> Any:
    """Plain JSON types; a number that is not finite becomes None and is reported."""
    if isinstance(value, dict):
        return {key: _plain(item, f"{path}.{key}", messages) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{path}[{i}]", messages) for i, item in enumerate(value)]
    if hasattr(value, "tolist"):  # arrays and scalars of NumPy
        return _plain(value.tolist(), path, messages)
    if isinstance(value, float) and not isfinite(value):
        messages.append(f"{path}: null, the computed value is not finite")
        return None
    return value
