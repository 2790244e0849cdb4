"""Time simulation of a ball bearing: rings, balls and cage under contact, friction, drag and
impact.

_cage_kernels        - balls in pockets and the cage on its guiding lands, compiled
_implicit_kernels    - friction that a step cannot resolve, implicit in the motion of a ball
_integration_kernels - Dormand and Prince's method of order 5(4), compiled
_motion_kernels      - equations of motion of ring, cage and balls, compiled
_race_kernels        - balls on races, compiled
_sdirk_kernels       - implicit steps with blocks a ball, compiled
_state_kernels       - places in the state vector, vectors, loads of bodies, compiled
arrays               - arrays of the compiled equations of motion, names of their columns
assembly             - from bearing, operation and model to the arrays of the compiled equations
bodies               - masses and inertias of ring and cage, and the equations their loads need
choices              - choices of a simulation
friction             - friction of balls on races for the compiled equations of motion
initial              - the state from which a simulation starts: the quasi-static equilibrium
inputs               - inputs of a time simulation: cage, laws, loads over time, options
model                - inputs of a simulation from loads, drags, materials and oils of a machine
record               - state, step control and samples of the integrators
reduction            - the part of the state that symmetry leaves to be solved
simulation           - the time simulation by Dormand and Prince's method, LSODA where that is
                       stiff; restart file
support              - supports of the rings: seat, masses that move with them, sensor
statistics           - statistics of a simulation, and of several starts of one
"""
