"""Results of one lubricated contact.

atlas         - films of the film atlas, as summary and in the terminal
fields        - units in which fields of contacts are shown
frame         - the frame of a contact: principal directions, parts of its grid, other nodes
interferogram - a film map as an optical interferometer would see it, beside pictures
line_cut      - film and pressure along a line through a contact, as a table
passes        - a track pass after pass: summary, message, netCDF group and figure
plots         - figure of one contact: film map, pressure map, and both along the two centre lines
quantities    - quantities of the film of one contact, single or in a bearing
response      - stiffness and damping of a single contact, in its summary and in the terminal
results       - results of one single contact
stored        - the fields of contacts, read back from a result folder by their names
summary       - summary of a single contact
supply        - oil supply of a single contact: its film where the inlet layer starves it
table         - a single contact in the terminal
transient_plots   - picture of a contact over time
transient_results - results of a contact over time
transient_summary - its summary, and its table for a terminal
transient_write   - its files: summary, series, fields
view          - the part of a contact that pictures show
write         - fields of contacts as netCDF groups, and the file of a single contact
"""
