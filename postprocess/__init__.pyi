from .bearing.results import BearingResults
from .contact.summary import ContactResults
from .open_results import open_results
from .scene.scene import view
from .writer import summary, write_extras, write_numbers, write_results

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
