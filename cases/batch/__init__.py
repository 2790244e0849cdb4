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

compute    - results of a point
engine     - execution of a sweep
keys       - names of points, tables and contacts on disk
limits     - limits of time and memory of one point, kept by its worker
planning   - points of a sweep file
points     - A sweep, its points, and what a worker is sent and sends back
pools      - executors that compute the points
program    - the program that computes, as one word
quick_json - summaries of points as JSON and back, by the compiled reader and writer of pydantic
results    - the finished points of a batch, gathered, and the files made of them
shards     - shares of a batch that are computed apart, by programs that know nothing of each other
shared     - contacts and traction tables that points share
store      - the folder of a batch
sweep      - A sweep file
sweep_file - A sweep file
worker     - points of a batch, computed in a worker
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
