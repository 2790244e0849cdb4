"""Results of a slip study.

results - slip maps of a case
write   - files of slip maps
"""
