"""Results of a batch.

columns     - numbers of the points as columns, some thousand points at a time
indices     - which key matters: Sobol indices, Morris' elementary effects
keys        - the keys that a batch varies, as its figures tell them apart
main_results - what is looked at first in a summary of any kind, by keys with their units
numbers     - every single number of a summary by its name
parquet     - the table of a batch as a Parquet file
plots       - figures of a batch: film, torque, life over one to three of the varied keys
plots_front - front of two goals of an optimisation, or one goal over its designs
read        - a finished batch, read back from its folder
records     - a finished point as it is stored
results     - results of a batch, point by point
sensitivity - effect of uncertain input: finite differences of [sensitivity] points
store       - finished points on disk, one SQLite file for each writer
summary     - summary of a batch
table       - a batch as a table for a terminal of 80 columns
write       - files of a batch: every number of every point, as one table and one data set
"""
