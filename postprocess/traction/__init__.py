"""Results of traction tables.

plots   - traction curves over the slide-roll ratio, and maps of the traction over sliding
results - traction tables of a case
summary - summary of traction tables
table   - traction tables in the terminal
write   - files of traction tables
"""
