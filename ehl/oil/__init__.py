"""The oil: density, viscosity, rheology and their numbers for compiled kernels.

_elementary_kernels - exponential and logarithm of whole lines of nodes
_kernels            - viscosity and density for compiled kernels
_rheology_kernels   - shear laws for compiled kernels
film_state          - temperature and fluidity of a film that was solved with shear or heat
free_volume         - oils by their volume: Tait's equation of state, Doolittle's free volume
heat_properties     - conductivity and heat capacity under pressure and temperature
inlet_layer         - layer of oil that both surfaces carry into a contact
lubricant           - density and viscosity as functions of pressure and temperature
numbers             - a lubricant as the array of numbers that the kernels take
pressure_laws       - viscosity by a modulus of the pressure, and by a scaled volume
rheology            - generalised Newtonian laws: Ree-Eyring, Carreau-Yasuda, limiting stress
"""
