from .engine import Batch, PointSelection, run_batch
from .points import Point, Sweep
from .pools import LocalPool
from .sweep import read_sweep

__all__ = ["Batch", "LocalPool", "Point", "PointSelection", "Sweep", "read_sweep", "run_batch"]
