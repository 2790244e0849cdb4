"""What was made last of the contacts of a bearing, for those who ask for the same once more."""

from collections.abc import Callable, Sequence
from typing import Any, Generic, TypeVar

T = TypeVar("T")


class LastOf(Generic[T]):
    """The last value and the objects it was made of: the torque of one equilibrium asks for the
    same a dozen times.

    The objects are known by what they are, not by what they hold: they must never change. The
    first are the contacts, of which only a tuple cannot.
    """

    def __init__(self) -> None:
        self._known: tuple[Sequence[Any], T] | None = None

    def of(self, objects: Sequence[Any], make: Callable[[], T]) -> T:
        """The value of these objects, made if they are not those of the last one."""
        known = self._known
        if known is not None and all(a is b for a, b in zip(known[0], objects, strict=True)):
            return known[1]
        value = make()
        if isinstance(objects[0], tuple):
            self._known = (objects, value)
        return value
