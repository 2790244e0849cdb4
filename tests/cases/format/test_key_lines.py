"""Lines of keys: what `tomllib` reads, and where the scanner says it stands."""

from __future__ import annotations

import tomllib

import pytest

from oilfilm.cases.format.rules import find_line, key_lines
from oilfilm.cases.format.shipped import shipped_cases

TEXT = '''# comment = 1 [not.a.table]
title = "a [bracket] = # no comment"  # comment

[one]
a = 1
long = """
[no.table]
b = 2
"""
list = [
  1,  # one
  2,
]
after = 'x = "y'
[one."two three".four] # header
b.c = { d = 1, e = [2] }
"k\\u0041y" = 3
[[rows]]
z = 1
[[rows]]
z = 2
'''


@pytest.mark.parametrize(
    ("path", "line"),
    [
        (("title",), 2),
        (("one",), 4),
        (("one", "a"), 5),
        (("one", "long"), 6),
        (("one", "list"), 10),
        (("one", "after"), 14),
        (("one", "two three", "four"), 15),
        (("one", "two three", "four", "b", "c"), 16),
        (("one", "two three", "four", "kAy"), 17),
        (("rows", 0, "z"), 19),
        (("rows", 1, "z"), 21),
    ],
)
def test_line(path, line):
    assert key_lines(TEXT)[path] == line


def test_nothing_but_keys_is_found():
    assert tomllib.loads(TEXT)
    assert {path[0] for path in key_lines(TEXT)} == {"title", "one", "rows"}


def test_a_missing_key_has_the_line_of_its_table():
    assert find_line(key_lines(TEXT), ("one", "missing", "deeper")) == 4
    assert find_line(key_lines(TEXT), ("nowhere",)) == 1


def paths(node, path=()):
    for key, value in node.items():
        yield (*path, key)
        if isinstance(value, dict):
            yield from paths(value, (*path, key))


@pytest.mark.parametrize("stem", shipped_cases())
def test_every_key_of_a_shipped_case_is_found(stem):
    text = shipped_cases()[stem].read_text(encoding="utf-8")
    lines = key_lines(text)
    for path in paths(tomllib.loads(text)):
        assert path[-1] in text.splitlines()[lines[path] - 1]
