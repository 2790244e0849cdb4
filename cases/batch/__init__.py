"""Many points of one case: sweep files, their plan, execution, and the folder that holds what is finished."""

from __future__ import annotations

from .engine import Batch, run_batch
from .sweep import Point, Sweep, read_sweep

__all__ = ["Batch", "Point", "Sweep", "read_sweep", "run_batch"]
