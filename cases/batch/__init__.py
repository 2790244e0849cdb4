"""Many points of one case.

| module | responsibility |
|---|---|
| program | the code that computes, as one word |
| keys | names of points, tables and contacts: hashes of all they depend on |
| points | a sweep, its points, tasks and receipts: plain data |
| planning | points of a sweep file |
| shared | contacts and traction tables that points share |
| sweep_file | the tables of a sweep file |
| sweep | a sweep file read, expanded and checked |
| shards | shares of a batch that are computed apart |
| compute | results of one point |
| limits | time and memory of one point |
| store | the folder of a batch |
| worker | points computed in a worker |
| quick_json | summaries of points as JSON and back |
| pools | processes of this machine, a Dask cluster, an executor of the user's |
| engine | execution: hand out, keep, resume |
| results | finished points gathered and written |
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
