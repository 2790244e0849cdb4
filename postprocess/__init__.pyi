from .bearing.results import BearingResults
from .contact.summary import ContactResults
from .open_results import open_results
from .run_numbers import summary, write_numbers
from .scene.scene import view
from .writer import write_extras, write_results

__all__ = [
    "BearingResults",
    "ContactResults",
    "open_results",
    "summary",
    "view",
    "write_extras",
    "write_numbers",
    "write_results",
]
