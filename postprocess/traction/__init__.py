"""Results of traction tables.

results - traction tables of a case
write   - files of traction tables
"""
