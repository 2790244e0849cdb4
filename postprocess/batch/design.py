"""Blocks of points that belong together, as those of Saltelli and Morris."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """A block of points that belong together: its keys, and the samples or trajectories of it.

    `start`: place of its first point among all, counted from 0.
    """

    block: str
    keys: tuple[str, ...]
    samples: int
    start: int = 0
    ranges: tuple[tuple[float, float], ...] = ()  # of the keys, in their units
