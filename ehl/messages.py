"""Kinds of messages."""

OUTSIDE_TABLE = "traction table: outside its range"  # begins a message on contacts


class Caution(str):
    """A message that changes a decision: terminal and report show it with the numbers, other
    messages are notes.

    Examples
    --------
    >>> from oilfilm.ehl.messages import Caution
    >>> message = Caution("the oil does not flow")
    >>> message, isinstance(message, str)
    ('the oil does not flow', True)
    """

    __slots__ = ()
