"""What several keys of a case file must satisfy together.

A check looks only at values that are valid by themselves, so that every error of a file is found
at once.
"""

from .bearing import GEOMETRY
from .files import bearing_problems, contact_problems
from .lubricant import oil_table
from .operation import ball_at, ball_azimuths
from .values import Names, Values

__all__ = [
    "GEOMETRY",
    "Names",
    "Values",
    "ball_at",
    "ball_azimuths",
    "bearing_problems",
    "contact_problems",
    "oil_table",
]
