"""Results of a time simulation.

history - the history of a time simulation on disk
plots   - files of a time simulation, and its pictures from history and summary
results - results, quantities, summary and table; the history read back
"""
