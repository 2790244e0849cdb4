"""Many points of one case.

| module | responsibility |
|---|---|
| keys | names of points, tables and contacts: hashes of all they depend on |
| points | a sweep, its points, made when they are asked for, tasks and results: plain data |
| sweep_file | the tables of a sweep file |
| samples | points drawn at random |
| plan | variations of a sweep file, documents and names of their points |
| expansion | a sweep file with its case, expanded into blocks |
| finished | a batch of which nothing is left to compute |
| sweep | a sweep file checked, ready to run; shards |
| shared_tables | contacts and traction tables that points share |
| store | the folder of a batch |
| compute | results of one point, computed in a worker within its limits |
| pools | processes of this machine, a Dask cluster, an executor of the user's |
| engine | execution: submit, store, resume |
| results | finished points gathered and written |

compute       - points of a batch, computed in a worker
engine        - execution of a sweep
expansion     - A sweep file expanded
finished      - A batch of which nothing is left to compute
keys          - names on disk
plan          - the variations of a sweep, documents and names of their points
points        - A sweep, its points, and what a worker is sent and sends back
pools         - executors that compute the points
results       - the finished points of a batch, gathered, and the files made of them
samples       - points drawn at random
shared_tables - results that points of a batch share
store         - the folder of a batch
sweep         - A sweep file
sweep_file    - A sweep file
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
