"""Optimisation of a case by its keys, with error bars of films as noise.

| module | responsibility |
|---|---|
| study | an optimisation file read: keys, goals, constraints, scatter |
| surrogate | Gaussian process of one number over the keys |
| ask | which designs are computed next |
| designs | designs and their numbers, from the points of the batch |
| proof | the case and the best designs with solved films: what is gained |
| results | summary, table and picture of an optimisation |
| search | designs computed by the batch until there are enough |

results - results of an optimisation
search  - designs computed by the batch until there are enough, the best ones proved by full solves
study   - an optimisation file read
"""
