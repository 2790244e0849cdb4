"""Points as documents of cases: what a point sets takes the place of what the case says of the
same in other keys.
"""

from collections.abc import Iterator, Sequence
from typing import Any

from ...format.bearing import CLEARANCE
from ...format.lubricant import VISCOSITIES
from ..keys import case_path
from .blocks import Variation

# keys of a table that say the same quantity
ROWS = {
    "bearing": ((*CLEARANCE, "clearance_class"),),
    "fit": (
        ("inner_ring_interference_um", "shaft_tolerance"),
        ("outer_ring_interference_um", "housing_tolerance"),
    ),
    "lubricant": (VISCOSITIES,),
}
SENSITIVITY = "sensitivity"  # block whose points stay near the case as it is


class PointDocuments:
    """The case's document with the values of variations, without their alternatives."""

    def __init__(self, base: dict[str, Any]) -> None:
        self.base = base
        self._gone: dict[tuple[str, ...], tuple[tuple[str, str, str], ...]] = {}

    def document(self, variation: Variation) -> dict[str, Any]:
        """The document of one variation; tables that it leaves unchanged are those of the case.

        Parameters
        ----------
        variation : Variation
            Values by key.

        Returns
        -------
        dict[str, Any]
            Document of the point.
        """
        document = dict(self.base)
        for setting in variation.settings:
            node = document
            *tables, key = case_path(setting.key)
            for table in tables:
                inner = node.get(table)
                node[table] = dict(inner) if isinstance(inner, dict) else {}
                node = node[table]
            node[key] = setting.value
        for table, key, _ in self._alternatives(variation):
            value = document[table].pop(key)
            if key == CLEARANCE[1]:
                # of the rating life
                document[table].setdefault("nominal_contact_angle_deg", value)
        return document

    def _alternatives(self, variation: Variation) -> tuple[tuple[str, str, str], ...]:
        """Keys that give way, which depend on the keys of the variation alone."""
        keys = (variation.block, *(setting.key for setting in variation.settings))
        if keys not in self._gone:
            self._gone[keys] = tuple(_alternatives(self.base, variation))
        return self._gone[keys]


def with_values(base: dict[str, Any], variation: Variation) -> dict[str, Any]:
    """The document of a case with the values of a variation, without their alternatives.

    Parameters
    ----------
    base : dict[str, Any]
        Document of the case.
    variation : Variation
        Values by key.

    Returns
    -------
    dict[str, Any]
        The changed document.
    """
    return PointDocuments(base).document(variation)


def replaced_keys(base: dict[str, Any], variations: Sequence[Variation]) -> tuple[str, ...]:
    """Keys of the case that points leave out, in words, each once.

    Parameters
    ----------
    base : dict[str, Any]
        Document of the case.
    variations : Sequence[Variation]
        Variations of the points.

    Returns
    -------
    tuple[str, ...]
        A sentence for each key.
    """
    return tuple(
        dict.fromkeys(
            f"{table}.{key} of the case is left out, the points give {own}"
            for variation in variations
            for table, key, own in _alternatives(base, variation)
        )
    )


def _alternatives(base: dict[str, Any], variation: Variation) -> Iterator[tuple[str, str, str]]:
    """Table and key that give way, and the key that they give way to."""
    paths = [case_path(setting.key) for setting in variation.settings]
    for table, rows in ROWS.items():
        given = base.get(table)
        given = given if isinstance(given, dict) else {}
        own = [path[1] for path in paths if path[0] == table]
        for row in rows:
            first = next((key for key in own if key in row), None)
            if first is not None:
                others = (key for key in row if key in given and key not in own)
                yield from ((table, key, first) for key in others)
    operation = base.get("operation")
    if variation.block != SENSITIVITY and isinstance(operation, dict):
        own = [path[1] for path in paths if path[0] == "operation"]
        # self-heating finds the temperature itself
        if "temperature_C" in own and "temperature" in operation and "temperature" not in own:
            yield "operation", "temperature", "temperature_C"
