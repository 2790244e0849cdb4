"""Steps in time: Dormand and Prince's method in compiled code, and SciPy's LSODA where that would
crawl.

_clock_kernels - the slower clock of friction and pocket films, compiled
_jacobian_kernels - slopes of the rates that LSODA asks for, ball by ball
_kernels - Dormand and Prince's method of order 5(4) around the equations of motion
methods  - the two methods: compiled explicit steps, and SciPy's LSODA with the Jacobian
"""
