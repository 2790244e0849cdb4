"""Case files, the runs they describe, and the command `oilfilm`."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
