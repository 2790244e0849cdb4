from .engine import Batch, Choice, run_batch
from .points import Point, Sweep
from .pools import LocalPool
from .sweep import read_sweep

__all__ = ["Batch", "Choice", "LocalPool", "Point", "Sweep", "read_sweep", "run_batch"]
