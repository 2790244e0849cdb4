"""Results of a bearing run.

atlas         - films of the film atlas of all contacts, as summary and in the terminal
contacts      - contacts of a bearing: their quantities, and why some are null
duty_cycle    - a duty cycle: blocks of the summary, lines of the terminal
film_heat     - films with the heat of their inlets, the isothermal ones beside
finite_bodies - the block `finite_bodies`: changes beside half-spaces; ellipses that shoulders cut
heating       - the block `self_heating` of the summary
plots         - figures of the whole bearing: film or pressure of every ball over the azimuth
plots_torque  - figures of the friction torque by all models, of the film after the supply stops
plots_strength - figure of the strength of the inner ring over temperature and speed
quantities    - quantities of ring, balls, frequencies, life, clearance, torque
ratings       - rating life and clearance in the summary and in the terminal's table
results       - results of a bearing run, and its distinct contacts
rings         - elastic rings: seat, compliance, what they yield
rows          - rows of balls and frequencies in the summary and in the terminal's table
strength      - the block `strength` of the summary: hoop tension, tension in the contacts
summary       - the summary of results: quantities in named units
supply        - the blocks `supply` and `decay` of the summary: films that are starved
table         - results as tables for a terminal of 80 columns
torque        - the block `torque_N_mm` of the summary: friction torque by every model
write         - files of a bearing run: contacts as CSV, fields as netCDF
"""
