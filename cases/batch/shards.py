"""Shares of a batch that are computed apart, by programs that know nothing of each other."""

import re
from dataclasses import dataclass

from ..format.problems import CaseError

MOST = 100_000  # shards
DIGITS = 8  # of a point's name that tell its shard


@dataclass(frozen=True, slots=True)
class Shard:
    """The share `number` of `count` of the points, by their names; counted from 1."""

    number: int
    count: int

    @property
    def file(self) -> str:
        """File of its finished points."""
        return "points.sqlite" if self.count == 1 else f"points-{self}.sqlite"

    def has(self, key: str) -> bool:
        """Tell whether a point belongs to the shard.

        Parameters
        ----------
        key : str
            Name of the point.

        Returns
        -------
        bool
            True if it does.
        """
        return int(key[:DIGITS], 16) % self.count == self.number - 1

    def __str__(self) -> str:
        return f"{self.number}-of-{self.count}"


SINGLE_WRITER = Shard(1, 1)


def shard_of(text: str) -> Shard:
    """The shard that `I/N` names.

    Parameters
    ----------
    text : str
        The option as given.

    Returns
    -------
    Shard
        The shard.

    Raises
    ------
    CaseError
        If it names none.
    """
    match = re.fullmatch(r"(\d+)/(\d+)", text.strip())
    if match:
        number, count = map(int, match.groups())
        if 1 <= number <= count <= MOST:
            return Shard(number, count)
    allowed = "allowed: I/N with I from 1 to N, as 3/8"
    raise CaseError(f"--shard {text}: names no share of the points; {allowed}")
