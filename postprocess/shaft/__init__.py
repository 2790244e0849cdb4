"""Results of a shaft on bearings.

results - summary, tables, data set
ross    - lines for the rotor code ROSS
write   - files, pictures and table
"""
