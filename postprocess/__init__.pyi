from .bearing.results import BearingResults
from .contact.results import ContactResults
from .netcdf.reader import open_results
from .summaries import summary
from .writer import write_results

__all__ = ["BearingResults", "ContactResults", "open_results", "summary", "write_results"]
