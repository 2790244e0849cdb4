"""Ball bearings: geometry, materials, quasi-static equilibrium, and the lubricated contacts it
yields.

contacts    - the lubricated contacts that follow from an equilibrium: shape, motion, stress
dynamics    - time simulation of a ball bearing
files       - files that appear complete or not at all
films       - films of the contacts, from the computed film to the operating one
fits        - fits and clearances
friction    - friction of balls on races: laws, balance of the balls, traction equilibrium
geometry    - internal geometry of a ball bearing; bearings of the catalogue
heating     - temperature of a bearing from its friction
invariants  - laws that every result obeys, checked while it runs
library     - bearings, materials and lubricants by name, with sources
material    - solid bodies: moduli, densities, thermal properties, and the reduced modulus
operation   - speeds, loads and temperatures, and the assumptions of the model
quasistatic - quasi-static equilibrium of rings and balls
rating      - rating life, load ratings and defect frequencies
rings       - rings as elastic bodies on their seats
shaft       - a shaft on several bearings
studies     - studies over load and speed: slip, stiffness, preload
supply      - oil supply and starved films
torque      - friction torque of a ball bearing, by several models
vibration   - vibration by form of surfaces and passing balls, with films and supports
"""

import lazy_loader

if __name__ != "oilfilm.bearing":
    raise ImportError("import oilfilm.bearing")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
