"""Compiled kernels of the multigrid: arrays and scalars in, results in place.

_kernels            - Reynolds operator and flow coefficient
_line_kernels       - linear systems of eight lines at once
_relaxation_kernels - line relaxation
_starved_kernels    - flow behind a layer of oil, downstream from node to node
"""
