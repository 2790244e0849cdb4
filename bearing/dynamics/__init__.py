"""Time simulation of a ball bearing: rings, balls and cage under contact, friction, drag and
impact.

_cage_kernels        - balls in pockets and the cage on its guiding lands, compiled
_implicit_kernels    - friction that a step cannot resolve, made implicit in the motion of each
                       ball
_integration_kernels - dormand and Prince's method of order 5(4) around the equations of motion,
                       compiled as a whole
_motion_kernels      - the equations of motion of ring, cage and balls as one compiled function
                       without allocation
_race_kernels        - balls on races, compiled
_state_kernels       - places in the state vector, and vectors of three components
arrays               - numbers and arrays that the compiled equations of motion share
assembly             - from bearing, operation and model to the arrays of the compiled equations
bodies               - masses and inertias of ring and cage, and the equations their loads need
friction             - friction of balls on races for the compiled equations of motion
initial              - the state from which a simulation starts: the quasi-static equilibrium
inputs               - what a time simulation is given: cage, laws, loads over time, options
integrators          - the two methods
model                - inputs of a simulation from loads, drags, materials and oils of a machine
record               - what the integrators work on: state, step control, samples
reduction            - what symmetry leaves to be solved, and how the rest follows
simulation           - the time simulation, sample by sample
statistics           - statistics of a simulation: energies, speeds, states of contacts
"""
