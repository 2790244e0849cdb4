"""Results of one lubricated contact.

atlas             - films of the film atlas, as summary and in the terminal
plots             - figure of one contact: film map, pressure map, and both along the two centre
                    lines
summary           - summary of a single contact
transient_plots   - picture of a contact over time
transient_summary - its summary, and its table for a terminal
view              - the part of a contact that pictures show
write             - fields of contacts as netCDF groups, and the file of a single contact
"""
