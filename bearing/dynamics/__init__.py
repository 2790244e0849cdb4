"""Time simulation of a ball bearing: rings, balls and cage under contact, friction, drag and
impact.

_kernels       - the equations of motion of ring, cage and balls, compiled
_state_kernels - places in the state vector, and vectors of three components
arrays         - numbers and arrays that the compiled equations of motion share
assembly       - from bearing, operation and model to the arrays of the compiled equations
bodies         - masses and inertias of ring and cage, and the equations their loads need
choices        - choices of a time simulation in the words of case files
contact        - forces between two bodies of a bearing: normal laws, friction, lubricated lands
friction       - friction of balls on races for the compiled equations of motion
initial        - the state from which a simulation starts: the quasi-static equilibrium
inputs         - what a time simulation is given: cage, laws, loads over time, options
integration    - steps in time: Dormand and Prince's method, LSODA where it turns stiff
laws           - normal contact, drag and other numbers of the model in closed form
layout         - the state vector: positions, velocities, angle of the inner ring
model          - inputs of a simulation from loads, drags, materials and oils of a machine
record         - what the integrators work on: state, step control, samples
reduction      - what symmetry leaves to be solved, and how the rest follows
restart        - a simulation on disk, to go on from where it stood
simulation     - the time simulation, sample by sample
starts         - several starts of one simulation: whether it ends in one state or in several
statistics     - statistics of a simulation: energies, speeds, states of contacts
"""
