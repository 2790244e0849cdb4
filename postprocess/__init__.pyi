from .bearing.summary import summary
from .reader import open_results
from .results import BearingResults, ContactResults
from .writer import write_results

__all__ = ["BearingResults", "ContactResults", "open_results", "summary", "write_results"]
