"""Stiffness and damping of a single contact in its summary and in the terminal."""

from collections.abc import Iterator
from typing import Any

from ehl.traction import NormalResponse
from ehl.units import from_si, value_with_error

from ..quantities import quantities, values_of
from .results import ContactResults

NO_RESPONSE = "it is that of a flooded, isothermal contact with lengths, solved and resolved"
RESPONSE_QUANTITIES = quantities(
    "",
    NO_RESPONSE,
    ("stiffness_N_um", "stiffness along the normal", "stiffness.value"),
    ("stiffness_uncertainty_N_um", "stiffness uncertainty", "stiffness.uncertainty"),
    ("damping_N_s_m", "squeeze damping", "damping.value"),
    ("damping_uncertainty_N_s_m", "squeeze damping uncertainty", "damping.uncertainty"),
)


def response_values(response: NormalResponse | None) -> dict[str, Any]:
    """Values by key in the units of the keys; over frequency in `response`, None where no
    frequency was asked for.

    Parameters
    ----------
    response : NormalResponse | None
        Stiffness and damping along the normal, or None.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    available = (
        response if response is not None and response.converged and response.resolved else None
    )
    over: dict[str, Any] | None = None
    if available is not None and available.frequencies:
        curves = (
            ("stiffness", "N_um", available.stiffnesses),
            ("damping", "N_s_m", available.dampings),
        )
        over = {"frequency_Hz": list(available.frequencies)}
        for name, unit, samples in curves:
            key = f"{name}_{unit}"
            bar = f"{name}_uncertainty_{unit}"
            over[key] = [from_si(key, sample.value) for sample in samples]
            over[bar] = [from_si(bar, sample.uncertainty) for sample in samples]
    return {**values_of(available, RESPONSE_QUANTITIES), "response": over}


def response_messages(results: ContactResults) -> Iterator[str]:
    """Give the reason why stiffness and damping are null, or remarks on them.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Yields
    ------
    Iterator[str]
        A message.
    """
    response = results.response
    keys = "stiffness_N_um, damping_N_s_m, response"
    if response is None:
        yield f"{keys}: null, {results.no_response}"
    elif not response.converged:
        yield f"{keys}: null, {response.message}"
    elif not response.resolved:
        yield f"{keys}: null, the mesh does not resolve the film; try more points"
    else:
        if response.message != "converged":
            yield f"stiffness_N_um, damping_N_s_m: {response.message}"
        if response.damping.value < 0.0:
            yield (
                "damping_N_s_m: negative, as in slow movement the oil that fills the inlet of "
                "closing bodies is missing from the film; ehl.response_frequencies_Hz gives the "
                "damping over frequency"
            )
        if not response.frequencies:
            yield "response: null, no ehl.response_frequencies_Hz"


def response_row(response: NormalResponse | None) -> str:
    """Stiffness and damping with their error bars; empty where there are none.

    Parameters
    ----------
    response : NormalResponse | None
        Stiffness and damping along the normal, or None.

    Returns
    -------
    str
        The words.
    """
    values = response_values(response)
    stiffness, bar, damping, other = (values[quantity.key] for quantity in RESPONSE_QUANTITIES)
    if stiffness is None:
        return ""
    return f"{value_with_error(stiffness, bar)} N/µm, {value_with_error(damping, other)} N s/m"
