"""Response of a lubricated contact to small movements along its normal.

linear - derivative of the discrete equations at a solution: stiffness and damping of one mesh
normal - stiffness and damping of a contact over frequency, extrapolated, with error bars
"""
