"""Films of flooded contacts from a table of solved ones.

_kernels     - compiled films of many contacts from the atlas on a lattice; see `arrays` for what
               it holds
arrays       - films of many contacts at once
fields       - pressure and film over the ellipse, for traction
field_maps   - pressure and gap of contacts on a grid, for pictures and files
film_formula - film formula of fifty coefficients, fitted to the film atlas by
               `tools/atlas/formula.py`
films        - central and minimum film, approach, stiffness, rolling moment of a contact
oils         - the oil that stands for one of another law, and what another density adds
table        - the table: functions of (ln A, sqrt L, ln D), and what another oil changes
"""
