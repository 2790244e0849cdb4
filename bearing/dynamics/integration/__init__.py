"""Steps in time: Dormand and Prince's method in compiled code, and SciPy's LSODA where that would
crawl.
"""
