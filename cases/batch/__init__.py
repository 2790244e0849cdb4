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

compute       - results of a point
engine        - execution of a sweep
keys          - names of points, tables and contacts on disk
plan          - the points of a sweep, each made when it is asked for
points        - A sweep, its points, and what a worker is sent and sends back
pools         - executors that compute the points
results       - the finished points of a batch, gathered, and the files made of them
samples       - points drawn at random
shared_tables - traction tables that points of a batch share
store         - the folder of a batch
sweep         - A sweep file
sweep_file    - A sweep file
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
