"""The oil: density, viscosity, rheology and their numbers for compiled kernels.

_kernels    - viscosity and density for compiled kernels
free_volume - oils by their volume: Tait's equation of state, Doolittle's free volume
lubricant   - density and viscosity as functions of pressure and temperature
rheology    - generalised Newtonian laws: Ree-Eyring, Carreau-Yasuda, limiting stress
"""
