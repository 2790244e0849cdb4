"""Friction: what belongs together."""

from __future__ import annotations

from collections.abc import Iterator

from ..problems import MISSING, Problem
from .lubricant import oil_table
from .values import Values

LAND = ("land_diameter_mm", "land_width_mm", "land_clearance_um")


def friction(values: Values) -> Iterator[Problem]:
    """A guided cage has a land; Carreau's law has its constants."""
    guided = values.get("cage", "guided_by")
    if guided is not None and guided != "balls" and values.given("cage", "pocket_friction"):
        for key in LAND:
            if not values.given("cage", key):
                yield Problem(path=("cage", key), found=MISSING, allowed="needed where a ring guides the cage")
    if values.get("lubricant") is None:
        return
    oil, _ = oil_table(values.document)
    if oil.get("rheology") == "carreau-yasuda":
        for key in ("carreau_modulus_MPa", "carreau_exponent"):
            if key not in oil:
                yield Problem(path=("lubricant", key), found=MISSING, allowed='needed with rheology = "carreau-yasuda"')
