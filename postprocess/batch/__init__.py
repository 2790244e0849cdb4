"""Results of a batch.

columns - numbers of the points as columns, some thousand points at a time
indices - which key matters: Sobol indices, Morris' elementary effects
plots   - figures of a batch: film, torque, life over one to three of the varied keys
results - results of a batch, point by point
store   - finished points on disk, one SQLite file for each writer
summary - summary of a batch
write   - files of a batch: every number of every point, as one table and one data set
"""
