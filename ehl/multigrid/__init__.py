"""Multigrid solution of the Reynolds and film equations.

_reynolds_kernels - compiled Reynolds equation and its line relaxation
_starved_kernels  - compiled flow of a contact whose inlets carry a layer of oil
cycle             - full approximation scheme of the contact: relaxation, cycles
far_field         - pressure of a flooded contact far from its centre
film_values       - film values of a solve with their error bars, and its status
full_multigrid    - open box, levels and attempts of one contact, Venner and Lubrecht (2000)
history           - films, residual and load after each cycle on a level
jacobian          - derivative of the discrete equations of a level
levels            - levels of one contact: their grids, fields and workspace
newton            - Newton's method on the finest level: certificate and last resort
starved           - conservation of mass where the oil does not fill the gap
supply            - what a layer of oil at the inlet leaves of a flooded contact
threads           - threads that share the lines of a grid, and threads that solve several films at
                    a time
"""
