"""Ball bearings: geometry, materials, quasi-static equilibrium, and the lubricated contacts it
yields.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
