"""Generalized Reynolds equation of Yang and Wen (1990), with heat.

_heat_kernels - temperature of a column of film, compiled
_kernels      - columns of film, compiled: their stress and the integrals of their flow
film_heat     - heat of a film and of the surfaces of its bodies
flow          - flow model of an oil that thins under shear: factors of its flow
heated_film   - film solved with heat, ready to shear: lines that sliding heats
solver        - contacts with an oil that thins under shear and heats up
"""
