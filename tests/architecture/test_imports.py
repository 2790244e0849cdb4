"""Circles of imports are found."""

from __future__ import annotations

from .import_graph import arrows_in, circles, package_circles


def test_a_circle_is_found():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set()}
    assert circles(graph) == [["b", "c"]]
    inside = {"p": {"p.one"}, "p.one": {"p.q.x"}, "p.q": set(), "p.q.x": set(), "p.q.y": {"p.one"}}
    assert circles(inside) == []
    assert package_circles(inside) == {"p": [["one", "q"]]}
    assert arrows_in(["one", "q"], "p", inside) == ["p.one -> p.q.x", "p.q.y -> p.one"]
