"""The oil: density, viscosity, rheology and their numbers for compiled kernels.

_kernels     - viscosity and density for compiled kernels
_laws        - the laws of density, viscosity and heat of an oil, each an equation that stands once
assumed_heat - heat properties of an oil that leaves some out
free_volume  - oils by their volume: Tait's equation of state, Doolittle's free volume
lubricant    - density and viscosity as functions of pressure and temperature
rheology     - generalised Newtonian laws: Ree-Eyring, Carreau-Yasuda, limiting stress
shear_stress - shear stress of an oil in NumPy, by the kernels of its laws
"""
