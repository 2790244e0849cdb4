"""Results of a time simulation.

history - the history of a time simulation on disk
plots   - pictures of a time simulation, from its history and summary
results - a time simulation of one case
write   - files of a time simulation
"""
