from .coefficient_kernels import FourConstants, RampedCoulomb
from .law import TractionForces, TractionLaw
from .laws import ContactShape, EllipseLaw
from .response.normal import NormalResponse, ResponseValue, normal_response
from .shear import Cavitation, ShearFields, TractionResult, integrate_traction, shear_fields
from .table.build import TableOptions, build_table
from .table.storage import inputs_digest, load_table, save_table
from .table.table import TableContact, TableError, TableRange, TractionTable
from .table.temperature import TemperatureTable, build_temperature_table

__all__ = [
    "Cavitation",
    "ContactShape",
    "EllipseLaw",
    "FourConstants",
    "NormalResponse",
    "RampedCoulomb",
    "ResponseValue",
    "ShearFields",
    "TableContact",
    "TableError",
    "TableOptions",
    "TableRange",
    "TemperatureTable",
    "TractionForces",
    "TractionLaw",
    "TractionResult",
    "TractionTable",
    "build_table",
    "build_temperature_table",
    "inputs_digest",
    "integrate_traction",
    "load_table",
    "normal_response",
    "save_table",
    "shear_fields",
]
