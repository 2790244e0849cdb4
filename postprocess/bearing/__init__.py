"""Results of a bearing run.

A new output quantity is a row in `quantities`, one of the contacts in `contacts`; a block that
needs more than rows, and its messages, stand in `summary`.

atlas              - films of the film atlas of all contacts, as summary and in the terminal
bearing_quantities - quantities of a bearing beside those of its contacts (`contacts`), each
                     declared once
contact_quantities - contacts of a bearing
dry                - results of a bearing that runs dry
measured           - measured numbers beside computed ones
plots              - figures: films or pressures of every ball, torque by all models, strength,
                     decay
results            - results of a bearing run, and its distinct contacts
summary            - the summary, block by block: life, clearance, rings, duty cycle, heat
torque             - the blocks of friction torque by every model, of oil supply and of decay
write              - contacts as CSV, fields as netCDF, the table in the terminal
"""
