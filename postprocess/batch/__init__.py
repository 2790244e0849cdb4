"""Results of a batch.

keys        - the keys that a batch varies, as its figures tell them apart
plots       - figures of a batch: film, torque, life over one to three of the varied keys
read        - a finished batch, read back from its folder
results     - results of a batch, point by point
sensitivity - effect of uncertain input: finite differences of [sensitivity] points
summary     - summary of a batch, and every number of its points as columns
table       - a batch as a table for a terminal of 80 columns
write       - files of a batch: every number of every point, as one table and one data set
"""
