"""The commands of `oilfilm`; importing this module registers them, in the order in which the help
lists them.
"""

from .app import app  # isort: skip
from . import compute  # isort: skip
from . import stiffness  # isort: skip
from . import table  # isort: skip
from . import dynamics  # isort: skip
from . import batch  # isort: skip
from . import view  # isort: skip
from . import documents  # isort: skip
from . import files  # isort: skip
from . import verify  # isort: skip

__all__ = [
    "app",
    "batch",
    "compute",
    "documents",
    "dynamics",
    "files",
    "stiffness",
    "table",
    "verify",
    "view",
]
