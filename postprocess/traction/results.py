"""Traction tables of a case."""

from dataclasses import dataclass

from bearing.friction.tables import Tables, TemperatureTables

from ..results import Results


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionResults(Results):
    """Tables of both races and the case they belong to."""

    tables: Tables
    over_temperature: TemperatureTables | None = None
