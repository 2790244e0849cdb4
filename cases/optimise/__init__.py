"""Optimisation of a case by its keys, with error bars of films as noise.

| module | responsibility |
|---|---|
| study | an optimisation file read: keys, goals, constraints, scatter |
| surrogate | Gaussian process of one number over the keys |
| ask | which designs are computed next |
| results | summary, table and picture of an optimisation |
| search | designs computed by the batch, best ones proved |
"""
