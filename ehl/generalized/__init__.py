"""Generalized Reynolds equation of Yang and Wen (1990), with heat.

_heat_kernels   - temperature of a column of film, compiled
_kernels        - columns of film, compiled: the integrals of their flow
_stress_kernels - stress in the middle of a column, compiled
_sweep_kernels  - temperature of a film, column after column along the flow, compiled
continuation    - from the Newtonian film of uniform temperature to the oil of the case
film_heat       - heat of a film and of the surfaces of its bodies
flow            - flow model of an oil that thins under shear: factors of its flow
section         - nodes across the film, their weights and cumulative integrals
solver          - contacts with an oil that thins under shear and heats up
"""
