"""Results of a slip study.

results - slip maps of a case: results, quantities, summary
write   - files, pictures and table of slip maps
"""
