"""A case file as a whole: which tables it has."""

from pydantic import Field

from .bearing import BearingTable, FitTable, MaterialTable, SurfaceTable, TemperaturesTable
from .contact import ContactEhlTable, ContactTable, EhlTable
from .dynamics import DynamicsTable
from .fields import Table
from .friction import CageTable, FrictionTable
from .lubricant import LubricantTable, OilTable
from .operation import ModelTable, OperationTable, SlipTable
from .rows import RowTable


class CaseFile(Table):
    """What every case file holds."""

    schema_version: int = Field(ge=1, le=1, description="version of this format")
    title: str = Field("", description="one line for tables and plots")
    source: str = Field("", description="paper, table or page the numbers come from")
    assumed: tuple[str, ...] = Field(
        (), strict=False, description="keys (table.key) whose values no source gives"
    )
    lubricant: LubricantTable
    materials: dict[str, MaterialTable] = Field({}, description="materials by name")


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
    rows: tuple[RowTable, ...] | None = Field(
        None,
        strict=False,
        min_length=1,
        max_length=8,
        description="rows of balls on the one inner ring",
    )
    lubricants: dict[str, OilTable] = Field({}, description="oils by name")


class ContactFile(CaseFile):
    """A single contact: `oilfilm contact`."""

    contact: ContactTable
    ehl: ContactEhlTable = ContactEhlTable()
    lubricants: dict[str, OilTable] = Field({}, description="oils by name")
