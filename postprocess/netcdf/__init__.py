"""netCDF-4 files of results.

groups - groups of variables, written as `reader` reads them, without xarray
reader - one loader for the folders of all commands: run, contact, batch, slip, stiffness
study  - files of a study: pictures, tables, data set and summary
"""
