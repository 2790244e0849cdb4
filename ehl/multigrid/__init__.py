"""Multigrid solution of the Reynolds and film equations.

acceleration        - nonlinear Krylov acceleration of the multigrid cycle
bordered            - linear systems bordered by the load: GMRES, factors of the near field
cycle               - full approximation scheme of the contact: relaxation, cycles
extrapolation       - grid-converged films with error bars from the levels of a contact
far_field           - pressure of a flooded contact far from its centre
flow_model          - factors between the oil's flow and that of a Newtonian oil
full_multigrid      - full multigrid of one contact, Venner and Lubrecht (2000)
history             - films, residual and load after each cycle on a level
jacobian            - derivative of the discrete equations of a level
kernels             - compiled: operator, line relaxation, flow behind a layer of oil
levels              - levels of one contact: their grids, fields and workspace
newton              - Newton's method on the finest level: certificate and last resort
open_box            - open box of a contact from its film by formula
settling            - cycles on one level until its film is at rest
starved             - conservation of mass where the oil does not fill the gap
starved_jacobian    - derivative of its flux
supply              - what a layer of oil at the inlet leaves of a flooded contact
threads             - threads that share the lines of a grid, or solve several films
transfer            - transfers between a grid and the one with doubled mesh size
verdict             - values of a solve with their bars; converged, resolved, and why not
"""
