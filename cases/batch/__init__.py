"""Many points of one case.

| module | responsibility |
|---|---|
| points | a sweep, its points, tasks and receipts: plain data |
| blocks | points described by the blocks of a sweep file |
| alternatives | points as documents: keys of the case that give way to a point's |
| faults | faults of points placed in the sweep file |
| plotted | numbers that a sweep file asks to be drawn |
| sweep | a sweep file read, expanded and checked |
| keys | names of points, tables and contacts: hashes of all they depend on |
| contact_cache | solved contacts shared by points |
| tables | traction tables shared by points |
| table_films | films of a table that is not complete yet |
| compute | results of one point |
| store | the folder of a batch |
| worker | one point computed in a worker |
| pools | processes of this machine, or a Dask cluster |
| engine | execution: hand out, keep, resume |
| results | finished points gathered and written |
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
