"""A case file as a whole: its tables, and all their rules."""

from collections.abc import Callable, Iterator
from itertools import chain
from typing import Any

from pydantic import PrivateAttr

from . import bearing, contact, dynamics, fits, friction, lubricant, operation, rows
from .bearing import BearingTable, SurfaceTable
from .contact import ContactEhlTable, ContactTable, EhlTable
from .dynamics import CageTable, DynamicsTable
from .fields import Table, between, described
from .fits import FitTable, TemperaturesTable
from .friction import FrictionTable
from .lubricant import LubricantTable, OilTable
from .materials import MaterialTable
from .operation import ModelTable, OperationTable, SlipTable
from .problems import CaseFault
from .rows import RowTable
from .rules import CaseValues, KnownNames, Relation, relation_faults


class CaseFile(Table):
    """What every case file holds."""

    schema_version: int = between(1, 1, "version of this format", ...)
    title: str = described("one line for tables and plots", "")
    source: str = described("paper, table or page the numbers come from", "")
    assumed: tuple[str, ...] = described("table.key whose value no source gives", (), strict=False)
    lubricant: LubricantTable
    materials: dict[str, MaterialTable] = described("materials by name", {})
    _notes: tuple[str, ...] = PrivateAttr(())  # on keys of an older version

    def model_post_init(self, context: Any) -> None:
        """Keep the notes that the file was read with."""
        self._notes = tuple(context or ())

    @property
    def notes(self) -> tuple[str, ...]:
        """What was read in another way than it is written."""
        return self._notes


class BearingFile(CaseFile):
    """A bearing case: `oilfilm run`."""

    bearing: BearingTable
    operation: OperationTable
    model: ModelTable = ModelTable()
    ehl: EhlTable = EhlTable()
    surface: SurfaceTable | None = None
    fit: FitTable | None = None
    temperatures: TemperaturesTable | None = None
    slip: SlipTable | None = None
    friction: FrictionTable = FrictionTable()
    cage: CageTable | None = None
    dynamics: DynamicsTable | None = None
    rows: tuple[RowTable, ...] | None = described(
        "rows of balls on the one inner ring", strict=False, min_length=1, max_length=8
    )
    lubricants: dict[str, OilTable] = described("oils by name", {})


class ContactFile(CaseFile):
    """A single contact: `oilfilm contact`."""

    contact: ContactTable
    ehl: ContactEhlTable = ContactEhlTable()
    lubricants: dict[str, OilTable] = described("oils by name", {})


OF_BOTH: tuple[Relation, ...] = lubricant.RELATIONS
OF_BEARINGS: tuple[Relation, ...] = (
    *bearing.RELATIONS,
    *fits.RELATIONS,
    *operation.RELATIONS,
    *friction.RELATIONS,
    *dynamics.RELATIONS,
)
BEARING_FAULTS: tuple[Callable[[CaseValues], Iterator[CaseFault]], ...] = (
    operation.operation_faults,
    rows.row_faults,
    dynamics.cage_faults,
    friction.friction_faults,
    dynamics.dynamics_faults,
)


def bearing_faults(values: CaseValues, names: KnownNames) -> Iterator[CaseFault]:
    """Every conflict within a bearing case."""
    yield from relation_faults((*OF_BOTH, *OF_BEARINGS), values)
    yield from bearing.bearing_faults(values, names)
    yield from fits.fit_faults(values, names)
    yield from lubricant.lubricant_faults(values, names)
    yield from chain.from_iterable(faults(values) for faults in BEARING_FAULTS)


def contact_faults(values: CaseValues, names: KnownNames) -> Iterator[CaseFault]:
    """Every conflict within a single-contact case."""
    yield from relation_faults((*OF_BOTH, *contact.RELATIONS), values)
    yield from contact.contact_faults(values, names)
    yield from lubricant.lubricant_faults(values, names)
    yield from contact.film_model_faults(values)
