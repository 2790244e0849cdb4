"""Results of a time simulation.

history - the history of a time simulation on disk
plots   - pictures of a time simulation, from its history and summary
results - results, quantities and summary; the history read back
write   - files of a time simulation, its table
"""
