"""Results of one lubricated contact.

A new output quantity is a row in `summary`.

atlas             - films of the film atlas, as summary and in the terminal
plots             - figures: maps and centre lines, interferogram, a line cut
shown_part        - the part of a contact that pictures show, in its frame and in the units of its
                    fields
summary           - results, quantities and summary of a single contact; fields read back
transient_plots   - files and picture of a contact over time
transient_summary - its results, its summary, and its table for a terminal
write             - fields of contacts as netCDF groups, the file of a single contact, its table
"""
