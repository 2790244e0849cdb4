"""Many points of one case: sweep files, their plan, execution, and the folder that holds what is
finished.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
