"""A change of a function in the product that is imported already, so that a fork need not import it again."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import CodeType, FunctionType, ModuleType
from typing import Any

from .lines import import_name
from .mutations import Mutant

PRODUCT = "oilfilm"


def exchanged(mutant: Mutant, text: str) -> list[tuple[FunctionType, CodeType]]:
    """Functions and the code that a mutant gives them; none where it changes something else of its module."""
    module = sys.modules.get(import_name(mutant.file))
    if module is None or module.__file__ is None:
        return []
    old, new = (compile(one, module.__file__, "exec") for one in (text, mutant.applied(text)))
    before, after = [*_codes(old)], [*_codes(new)]
    if _own(old) != _own(new) or [one.co_qualname for one in before] != [one.co_qualname for one in after]:
        return []
    pairs = {_place(one): other for one, other in zip(before, after, strict=True) if _differs(one, other)}
    functions = ((function, pairs.get(_place(function.__code__))) for function in _functions(module))
    return [(function, code) for function, code in functions if code is not None]


def forget_product() -> None:
    """Have a fork import the product again."""
    for name in [name for name in sys.modules if name == PRODUCT or name.startswith(f"{PRODUCT}.")]:
        del sys.modules[name]


def _place(code: CodeType) -> tuple[str, int]:
    return code.co_qualname, code.co_firstlineno


def _codes(code: CodeType) -> Iterator[CodeType]:
    """Codes inside of a code, at all depths."""
    for part in code.co_consts:
        if isinstance(part, CodeType):
            yield part
            yield from _codes(part)


def _own(code: CodeType) -> tuple[Any, ...]:
    """Instructions and constants of a code without those of the codes inside."""
    constants = [repr(one) for one in code.co_consts if not isinstance(one, CodeType)]
    return code.co_code, constants, code.co_names, code.co_varnames, code.co_freevars


def _differs(one: CodeType, other: CodeType) -> bool:
    """Whether two codes, or those inside of them, are different."""
    if _own(one) != _own(other):
        return True
    return any(_own(a) != _own(b) for a, b in zip(_codes(one), _codes(other), strict=True))


def _functions(module: ModuleType) -> list[FunctionType]:
    """Functions of a module, with methods, properties and what decorators wrap."""
    found: dict[int, FunctionType] = {}
    left: list[Any] = [*vars(module).values()]
    seen: set[int] = set()
    while left:
        thing = left.pop()
        if id(thing) in seen:
            continue
        seen.add(id(thing))
        if isinstance(thing, FunctionType) and thing.__code__.co_filename == module.__file__:
            found[id(thing)] = thing
        if isinstance(thing, type) and thing.__module__ == module.__name__:
            left += vars(thing).values()
        inner = (getattr(thing, name, None) for name in ("__wrapped__", "__func__", "fget", "func"))
        left += [one for one in inner if isinstance(one, FunctionType)]
    return [*found.values()]
