"""No circles among modules, and none among the members of a package."""

from __future__ import annotations

from .import_graph import arrows_in, circles, import_graph, package_circles
from .sources import nothing

LAYERS_WITHOUT_CIRCLES = ("ehl", "bearing", "postprocess")


def finished(circle):
    """Whether a circle lies in a layer that has to be free of them."""
    return circle[0].startswith(LAYERS_WITHOUT_CIRCLES)


def test_a_circle_is_found():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set()}
    assert circles(graph) == [["b", "c"]]
    inside = {"p": {"p.one"}, "p.one": {"p.q.x"}, "p.q": set(), "p.q.x": set(), "p.q.y": {"p.one"}}
    assert circles(inside) == []
    assert package_circles(inside) == {"p": [["one", "q"]]}
    assert arrows_in(["one", "q"], "p", inside) == ["p.one -> p.q.x", "p.q.y -> p.one"]


def test_no_circles_of_modules():
    assert nothing([circle for circle in circles(import_graph()) if finished(circle)])


def test_no_circles_of_packages():
    """With each subpackage one node, at every level: no arrow runs up."""
    graph = import_graph()
    offenders = [
        (package, circle, arrows_in(circle, package, graph))
        for package, several in package_circles(graph).items()
        for circle in several
        if not package or finished([package])
    ]
    assert nothing(offenders)
