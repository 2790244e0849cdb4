"""One lubricated contact over time: load, speed, features of the surfaces, bodies of a mass.

content   - oil that the nodes hold, carried with the entrainment from step to step
features  - waviness, dents, ridges and measured profiles of the surfaces
inputs    - what changes over time, and the options of a run
plan      - times of the steps
record    - what a run leaves: values at every step, fields at some
run       - a run: start, steps, records, state to go on from
start     - steady film that a run starts from
step      - one step in time of the multigrid
waves     - amplitude of a wave in the film, and what the film leaves of a waviness
"""
