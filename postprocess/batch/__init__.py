"""Results of a batch.

design         - blocks of points that belong together
packed_columns - numbers of the points of a batch as columns, some thousand points at a time
plots          - main results over one to three of the varied keys, the front of an optimisation
results        - points, varied keys, main results, every number of a summary
store          - finished points on disk, one SQLite file for each writer
summary        - summary of a batch, effect of the keys (Sobol, Morris, sensitivities, bands), its
                 table
write          - every number of every point, as table, data set and Parquet file
"""
