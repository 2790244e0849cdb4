"""Lubricated contacts: Hertz, Reynolds, elastic deflection; no bearings here.

arrays         - the type of the arrays of numbers, interpolation weights, equal rows
atlas          - films of flooded contacts from a table of solved ones
closed_form    - closed-form references: Hertz contact and stress, film formulas
compiled       - how kernels are compiled, and when they count as out of date
conditions     - operating conditions of one lubricated contact
data_files     - arrays and objects in files: npz without pickle, and JSON
finite_element - independent finite-element solution of the lubricated contact
foreign_files  - files of others: how they are opened, and what they may be
generalized    - generalized Reynolds equation of Yang and Wen (1990), with heat
grid           - rectangular grids of the contact solver and their hierarchy
kernel_sources - files that make up the compiled kernels of this program, and their contents as one
                 number
messages       - the kind of messages that change a decision
multigrid      - multigrid solution of the Reynolds and film equations
oil            - the oil: density, viscosity, rheology and their numbers for compiled kernels
options        - options of the contact solver
scaling        - the one bridge between SI and the solver's dimensionless form
solid          - the bodies: elastic deflection, coatings, heat conduction
solution       - result of one contact solve
solver         - one lubricated contact solved: box, fields, film values
table_files    - tables of numbers in files of others: text with units, JSON, npy
traction       - traction of a lubricated contact
traction_table - traction tables
transient      - one lubricated contact over time: load, speed, features of the surfaces
units          - units of named numbers: the last words of a key say its unit
version        - version of the program, written down in pyproject.toml only
"""

import lazy_loader

if __name__ != "oilfilm.ehl":
    raise ImportError("import oilfilm.ehl")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
