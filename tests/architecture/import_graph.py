"""Who imports whom inside the product: circles, arrows that run up, sizes of packages.

`python tests/architecture/import_graph.py` prints them; `test_imports.py` demands that there are
no circles. Every import counts, wherever it stands: at the top of a module, inside a function, in a
block for type checkers, in the stub `__init__.pyi` of a package whose names are loaded lazily, and
`import_module` with a literal name. That a package's `__init__` runs before its modules does not.
"""

from __future__ import annotations

import ast
from collections import Counter, defaultdict
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
LAYERS = ("ehl", "bearing", "postprocess", "cases", "oilfilm")
NOT_COUNTED = ("__init__.py", "__init__.pyi", "py.typed", "__pycache__")


def module_files(root=ROOT):
    """Files of the product by module name; a package stands for its `__init__`."""
    files = {}
    for layer in LAYERS:
        for path in sorted((root / layer).rglob("*.py")):
            parts = path.relative_to(root).with_suffix("").parts
            parts = parts[:-1] if parts[-1] == "__init__" else parts
            files[".".join(parts if layer == "oilfilm" else ("oilfilm", *parts))] = path
    return files


def package_of(name, files):
    """Package from which relative imports of a module start."""
    return name if files[name].name == "__init__.py" else name.rpartition(".")[0]


def import_targets(node, package):
    """Dotted names that an import statement may bind, each with the names that are its parents."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        base = node.module or ""
        if node.level:
            parts = package.split(".")
            parts = parts[: len(parts) - node.level + 1]
            base = ".".join([*parts, base] if base else parts)
        return [f"{base}.{alias.name}" for alias in node.names]
    if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module") and node.args:
        name = node.args[0]
        if isinstance(name, ast.Constant) and isinstance(name.value, str):
            dots = len(name.value) - len(name.value.lstrip("."))
            parts = package.split(".")
            parts = parts[: len(parts) - dots + 1] if dots else []
            return [".".join([*parts, name.value[dots:]])]
    return []


def known_module(target, files):
    """The module that a dotted name is or lies in; None outside the product."""
    while target and target not in files:
        target = target.rpartition(".")[0]
    return target or None


def imported_modules(tree, name, files):
    """Modules of the product that a syntax tree imports, as (node, module)."""
    package = package_of(name, files)
    for node in ast.walk(tree):
        for target in import_targets(node, package):
            module = known_module(target, files)
            if module and module != name:
                yield node, module


@cache
def import_graph(root=ROOT):
    """{module: modules that it imports}."""
    files = module_files(root)
    graph = {name: set() for name in files}
    for name, path in files.items():
        for source in (path, path.with_suffix(".pyi")):
            if source.exists():
                tree = ast.parse(source.read_text(encoding="utf-8"))
                graph[name].update(module for _, module in imported_modules(tree, name, files))
    return graph


def circles(graph):
    """Strongly connected components of more than one node, by Tarjan's algorithm."""
    index, low, stack, components = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in sorted(graph[node]):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            cut = stack.index(node)
            components.append(sorted(stack[cut:]))
            del stack[cut:]

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return sorted(component for component in components if len(component) > 1)


def contracted(graph, package):
    """The graph of a package's members, each subpackage one node; the empty name means the layers.

    The package's own `__init__` is the member `__init__`.
    """

    def member(name):
        if name == package:
            return "__init__"
        inside = not package or name.startswith(package + ".")
        return name[len(package) + bool(package) :].split(".")[0] if inside else None

    members = defaultdict(set)
    for name, others in graph.items():
        own = member(name)
        if own is not None:
            theirs = {member(other) for other in others}
            members[own] |= theirs - {own, None}
    return members


def packages(graph):
    """Every package that has modules, outermost first; the empty name means the layers."""
    return sorted({"", *(name.rpartition(".")[0] for name in graph)})


def package_circles(graph):
    """{package: circles of its members}, where there are any."""
    found = {package: circles(contracted(graph, package)) for package in packages(graph)}
    return {package: circle for package, circle in found.items() if circle}


def arrows_in(circle, package, graph):
    """Imports that make a circle of members of a package, as 'module -> module'."""
    prefix = f"{package}." if package else ""

    def member(name):
        inside = name.startswith(prefix) and name != package
        return name[len(prefix) :].split(".")[0] if inside else "__init__"

    return sorted(
        f"{name} -> {other}"
        for name, others in graph.items()
        for other in others
        if (name + ".").startswith(prefix) and (other + ".").startswith(prefix)
        if member(name) != member(other) and {member(name), member(other)} <= set(circle)
    )


def names_in(folder):
    """What stands in a folder, without the files that every package has."""
    return sorted(path.name for path in folder.iterdir() if path.name not in NOT_COUNTED)


def main():
    """Print circles, arrows and sizes."""
    graph, files = import_graph(), module_files()
    print(f"{len(graph)} modules, {sum(map(len, graph.values()))} imports")
    found = circles(graph)
    print(f"\ncircles of modules: {len(found)}")
    for circle in found:
        print("  " + ", ".join(circle))
    found = package_circles(graph)
    print(f"\ncircles of members of a package: {sum(map(len, found.values()))}")
    for package, several in found.items():
        for circle in several:
            print(f"  {package or 'layers'}: {', '.join(circle)}")
            for arrow in arrows_in(circle, package, graph):
                print(f"      {arrow}")
    lines = Counter()
    modules = Counter()
    for path in files.values():
        for folder in path.relative_to(ROOT).parents:
            lines[folder.as_posix()] += len(path.read_text(encoding="utf-8").splitlines())
        modules[path.relative_to(ROOT).parent.as_posix()] += path.name != "__init__.py"
    print("\nfolder                            names modules  lines with subfolders")
    for folder in sorted({*modules, "."}):
        names = len(names_in(ROOT / folder)) if folder != "." else len(LAYERS)
        print(f"{folder:34}{names:5}{modules[folder]:8}{lines[folder]:7}")


if __name__ == "__main__":
    main()
