"""All output of a run into one directory.

run - all of them, by one process
"""
