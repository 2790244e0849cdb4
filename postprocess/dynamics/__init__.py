"""Results of a time simulation.

history - the history of a time simulation on disk
plots   - files of a time simulation, and its pictures from history and summary
read    - the history read from disk, and the speeds in it
results - results, quantities, summary and table
"""
