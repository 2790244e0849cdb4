"""Slip maps and stiffness over speed as netCDF files, SI, for `open_results`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    pass
