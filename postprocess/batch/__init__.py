"""Results of a batch.

plots       - figures of a batch: film, pressure and torque over one or two of the varied keys
results     - results of a batch, point by point
sensitivity - effect of uncertain input: finite differences of [sensitivity] points
summary     - summary of a batch, and every number of its points as columns
table       - a batch as a table for a terminal of 80 columns
write       - files of a batch: every number of every point, as one table and one data set
"""
