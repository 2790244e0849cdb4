"""What is sent to a worker, and what comes back."""

from dataclasses import dataclass, field
from typing import Any

from ..version import version


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """What a worker is asked; `folder` is None where it cannot reach the folder of the batch."""

    key: str
    document: dict[str, Any]
    compute: str
    fields: bool
    share: bool  # whether contacts may be equal in several points
    folder: str | None
    tables: str | None = None  # file of traction tables on the machine of the batch
    table_points: int = 257
    program: str = field(default_factory=version)


@dataclass(frozen=True, slots=True, kw_only=True)
class Receipt:
    """What a worker answers: how the point ended, its wall time [s], and its files where it did
    not write them.
    """

    key: str
    status: str
    message: str = ""
    wall: float = 0.0
    files: dict[str, bytes] = field(default_factory=dict)
