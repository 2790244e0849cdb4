"""Optimisation of a case by its keys, with error bars of films as noise.

| module | responsibility |
|---|---|
| study | an optimisation file read; designs and their numbers from the points of the batch |
| search | designs computed by the batch until there are enough, confirmed by full solves |
| results | summary, table and picture of an optimisation |

results - results of an optimisation
search  - designs computed by the batch until there are enough, the best ones confirmed by full
          solves
study   - an optimisation
"""
