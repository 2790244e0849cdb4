"""One lubricated contact over time: load, speed, features of the surfaces, bodies of a mass.

content - content of oil of a contact over time
inputs  - what changes over time, and the options of a run
record  - what a run leaves: values at every step, fields at some
run     - a run: start, steps, records, state to go on from
step    - one step in time of the multigrid
waves   - amplitude of a wave in the film, and what the film leaves of a waviness
"""
