"""The summary of a run, of a bearing or of a single contact."""

from typing import Any

from ..bearing.results import BearingResults
from ..bearing.summary import bearing_summary
from ..contact.results import ContactResults
from ..contact.summary import contact_summary


def summary(results: BearingResults | ContactResults) -> dict[str, Any]:
    """Results as one JSON document in named units, the keys as published.

    Parameters
    ----------
    results : BearingResults | ContactResults
        Results of a bearing or of a single contact.

    Returns
    -------
    dict
        Plain JSON types; lengths [um] or [mm], pressures [GPa], angles [deg] as the keys say. What
        does not apply is None with the reason under "messages"; no value is NaN or infinite.
    """
    if isinstance(results, ContactResults):
        return contact_summary(results)
    return bearing_summary(results)
