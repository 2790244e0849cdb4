"""Results of traction tables.

results - traction tables of a case, and their summary
write   - files, pictures and table of traction tables
"""
