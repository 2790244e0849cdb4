"""Results of the vibration of a bearing.

results - a run, its measured motion, levels and spectra
summary - summary of a vibration
write   - files, pictures and table of a vibration
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
