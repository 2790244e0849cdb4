"""Films of flooded contacts from a table of solved ones.

_lookup_kernels - compiled: films of many contacts on a lattice
_table_kernels  - compiled: sums of the table's radial functions
arrays          - films of many contacts at once
check           - a solved film beside that of the atlas
fields          - pressure and film over the ellipse, for traction
film_shapes     - pressure and film of many contacts at few places, for friction without a solve
films           - central and minimum film, approach, stiffness, rolling moment of a contact
nearest         - the contact nearest to one that is not covered
oils            - the oil that stands for one of another law, and what another density adds
skewed          - entrainment at an angle: the straight contact, and what mixed curvature adds
table           - the table: functions of (ln A, sqrt L, ln D), and what another oil changes
turning         - what a rotation of the entrainment does to films
"""
