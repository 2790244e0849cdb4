"""The block `strength` of the summary: hoop tension of the rings, tension in the contacts."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from bearing.fits.ring_strength import LARGE_SHARE, RingStrength, StrengthMap
from bearing.geometry import Race
from ehl.units import from_si

from ..quantities import values_of
from ..text import NOTHING
from .quantities import RING_STRENGTH
from .results import BearingResults

PROBABILITY = "failure_probability"
NEXT_TO_NONE = 1e-9  # of a probability of failure, in the terminal [-]
NO_STANDARD = (
    "strength: no standard rates ceramic rings; hoop tension by Lame's cylinders, probability of "
    "failure by Weibull for flaws in the volume, its range that of the material's data "
    "(docs/theory/ceramic_strength.md)"
)
NOT_BRITTLE = (
    "strength: failure probabilities null, the rings have no bending_strength_MPa and "
    "weibull_modulus, or no width_mm"
)
LOOSE = (
    "strength: the case gives no [fit], rings of ceramic are taken as loose on shaft and in "
    "housing; the interference of a seat, as of a warm steel shaft, is left out of their tension"
)


def strength_block(results: BearingResults) -> dict[str, Any]:
    """Tension, strength and failure probability of both rings, and the map of the inner ring.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        The block.
    """
    strength = results.strength
    rings = {} if strength is None else {ring.race: ring for ring in strength.rings}
    blocks: dict[str, Any] = {
        f"{race.value}_ring": _ring(results, race, rings.get(race)) for race in Race
    }
    inner_map = None if strength is None else strength.inner_map
    return blocks | {"inner_ring_map": None if inner_map is None else _map(inner_map)}


def _ring(results: BearingResults, race: Race, ring: RingStrength | None) -> dict[str, Any]:
    """One ring; the largest tension of its contacts, where films were solved."""
    pairs = zip(results.contacts, results.tensions, strict=False)
    solved = [t.ring for contact, t in pairs if t is not None and contact.race is race]
    tension = from_si("tension_GPa", max(solved, default=None))
    material = None if ring is None else ring.material.name
    return {
        "material": material,
        **values_of(ring, RING_STRENGTH),
        "surface_tension_maximum_GPa": tension,
    }


def _map(result: StrengthMap) -> dict[str, Any]:
    """Rows over the temperature, columns over the speed."""
    names = {"": "probability", "_low": "low", "_high": "high"}
    failures = {end: getattr(result, f"failure_{name}") for end, name in names.items()}
    return {
        "temperature_C": [
            round(from_si("temperature_C", float(t)), 9) for t in result.temperature
        ],
        "inner_speed_rpm": [round(from_si("speed_rpm", float(n)), 9) for n in result.speed],
        "hoop_tension_MPa": from_si("tension_MPa", result.hoop_tension).tolist(),
        **{
            f"{PROBABILITY}{end}": None if values is None else np.asarray(values).tolist()
            for end, values in failures.items()
        },
    }


def strength_messages(results: BearingResults) -> Iterator[str]:
    """Explain the numbers, name rings at risk, and give reasons for null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    strength = results.strength
    if strength is None:
        return
    brittle = [ring for ring in strength.rings if ring.failure_probability is not None]
    yield NO_STANDARD if brittle else NOT_BRITTLE
    if brittle and not results.case.get("fit"):
        yield LOOSE
    for ring in strength.rings:
        name = f"{ring.race.value} ring"
        share = ring.strength_share
        tension = from_si("tension_MPa", ring.hoop_tension)
        if share is not None and share > LARGE_SHARE:
            yield (
                f"strength: the {name} has a hoop tension of {tension:.4g} MPa, {share:.0%} of "
                f"the bending strength of {ring.material.name}, beyond {LARGE_SHARE:.0%}"
            )
    for name in dict.fromkeys(ring.material.name for ring in brittle if _assumed(ring)):
        yield f"strength: the Weibull modulus of {name} is assumed, its range read in sources"
    if not any(tension is not None for tension in results.tensions):
        yield (
            "contacts: surface_tension_ring_GPa and what belongs to it null, they need a film and "
            "a ring or ball of known bending strength; edge_tension_GPa is without friction"
        )


def _assumed(ring: RingStrength) -> bool:
    """True if no source was read for the modulus of a ring's material."""
    return "weibull_modulus" in ring.material.unverified


def strength_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table, one for each brittle ring.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    rows = {}
    for ring in () if results.strength is None else results.strength.rings:
        if ring.failure_probability is None:
            continue
        parts = [ring.hoop_tension, ring.fit_tension, ring.rotation_tension]
        tension, fit, rotation = (from_si("tension_MPa", part) for part in parts)
        odds = (ring.failure_probability, ring.failure_low, ring.failure_high)
        value, low, high = map(probability_text, odds)
        rows[f"{ring.race.value} ring"] = (
            f"hoop {tension:.3g} MPa (fit {fit:.3g}, rotation {rotation:.3g}), probability of "
            f"failure {value} ({low} to {high})"
        )
    return rows


def probability_text(value: float | None) -> str:
    """A probability of failure in words of the table.

    Parameters
    ----------
    value : float | None
        Probability of failure [-], or None.

    Returns
    -------
    str
        The words.
    """
    if value is None:
        return NOTHING
    return (
        "0" if value == 0.0 else f"< {NEXT_TO_NONE:g}" if value < NEXT_TO_NONE else f"{value:.1g}"
    )
