"""All output of a run into one directory.

extras  - pictures and files for ParaView, in parts that several processes can make
numbers - netCDF, CSV, and last the summary
run     - all of them, by one process
summaries - the summary of a run, of a bearing or of a single contact
"""
