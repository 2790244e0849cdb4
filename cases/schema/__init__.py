"""The tables of a case file: keys, types, ranges and defaults.

Only pydantic is imported here, so that help and validation stay quick. Every key ends in its unit;
`cases/convert` turns the values into SI, once. What several keys must satisfy together stands in
`cases/checks`.
"""

from .bearing import BearingTable, FitTable, MaterialTable, SurfaceTable, TemperaturesTable
from .contact import ContactEhlTable, ContactTable, EhlTable
from .dynamics import DynamicsTable
from .fields import FREE, Table, is_number
from .files import BearingFile, CaseFile, ContactFile
from .friction import CageTable, FrictionTable
from .lubricant import LubricantTable, OilTable
from .operation import ModelTable, OperationTable, SlipTable
from .rows import RowTable
from .sweep import HypercubeOptions, SensitivityTable, SweepFile

__all__ = [
    "FREE",
    "BearingFile",
    "BearingTable",
    "CageTable",
    "CaseFile",
    "ContactEhlTable",
    "ContactFile",
    "ContactTable",
    "DynamicsTable",
    "EhlTable",
    "FitTable",
    "FrictionTable",
    "HypercubeOptions",
    "LubricantTable",
    "MaterialTable",
    "ModelTable",
    "OilTable",
    "OperationTable",
    "RowTable",
    "SensitivityTable",
    "SlipTable",
    "SurfaceTable",
    "SweepFile",
    "Table",
    "TemperaturesTable",
    "is_number",
]
