"""Results of a shaft on bearings.

results - summary, tables, data set
write   - files, pictures and table
"""
