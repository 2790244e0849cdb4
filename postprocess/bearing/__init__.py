"""Results of a bearing run.

atlas         - films of the film atlas of all contacts, as summary and in the terminal
contacts      - contacts of a bearing: their quantities, and why some are null
duty_cycle    - a duty cycle: blocks of the summary, lines of the terminal
film_heat     - films with the heat of their inlets, the isothermal ones beside
finite_bodies - the block `finite_bodies`: changes beside half-spaces; ellipses that shoulders cut
heating       - the block `self_heating` of the summary
plots         - figures of the whole bearing: film or pressure of every ball over the azimuth
plots_torque  - figures of the friction torque by all models, of the film after the supply stops
quantities    - quantities of ring, balls, frequencies, life, clearance, torque
results       - results of a bearing run, and its distinct contacts
summary       - the summary of results: quantities in named units
torque        - the block `torque_N_mm` of the summary: friction torque by every model
write         - files of a bearing run: contacts as CSV, fields as netCDF
"""
