"""Oil properties for compiled kernels: a lubricant as an array of numbers."""

from __future__ import annotations

from .numbers import oil_numbers

__all__ = ["oil_numbers"]
