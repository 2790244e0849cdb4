from .engine import Batch, run_batch
from .points import Point, Sweep
from .sweep import read_sweep

__all__ = ["Batch", "Point", "Sweep", "read_sweep", "run_batch"]
