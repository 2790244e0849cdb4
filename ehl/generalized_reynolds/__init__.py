"""Generalized Reynolds equation of Yang and Wen (1990): flow factors from integrals across the film."""

from __future__ import annotations

from .columns import ColumnFlow, FilmColumns, flow_integrals, mid_stress
from .section import Section, film_section

__all__ = ["ColumnFlow", "FilmColumns", "Section", "film_section", "flow_integrals", "mid_stress"]
