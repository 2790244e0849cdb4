from .bearing.results import BearingResults
from .contact.results import ContactResults
from .netcdf.reader import open_results
from .writer.extras import write_extras
from .writer.numbers import write_numbers
from .writer.run import write_results
from .writer.summaries import summary

__all__ = [
    "BearingResults",
    "ContactResults",
    "open_results",
    "summary",
    "write_extras",
    "write_numbers",
    "write_results",
]
