"""The architecture as tests: layers and homes of heavy libraries. Each lists all offenders."""

from __future__ import annotations

import ast
import sys

from .sources import FILES, LAYERS, at, layer, nodes, nothing, tree

HOMES = {
    "numba": ("*_kernels.py", "ehl/compiled.py"),
    "lazy_loader": ("__init__.py",),
    "threadpoolctl": ("bearing/dynamics/integrators.py",),
    "skfem": ("ehl/finite_element/*.py", "ehl/solid/*.py", "ehl/solid/bodies/*.py"),
    "pyamg": ("ehl/solid/bodies/elasticity.py",),
    "vtk": ("postprocess/scene/*.py",),
    "vtkmodules": ("postprocess/scene/*.py",),
    "meshio": ("postprocess/scene/*.py",),
    "pyvista": ("postprocess/scene/*.py",),
    "matplotlib": (
        "postprocess/plot*.py",
        "postprocess/*/plot*.py",
        "postprocess/contact/*.py",
        "postprocess/scene/*.py",
    ),
    "xarray": ("postprocess/*/*.py",),
    "h5netcdf": ("postprocess/netcdf_write.py", "postprocess/*/history.py"),
    "h5py": ("postprocess/netcdf_write.py", "postprocess/*/history.py"),
    "typer": ("cases/cli/*.py", "cases/cli/over_time/*.py"),
    "pydantic": ("cases/format/*.py", "cases/batch/*.py", "cases/batch/planning/*.py", "cases/optimise/*.py"),
    "pydantic_core": ("cases/format/*.py", "cases/batch/compute.py"),
    "rich": ("cases/cli/*.py", "postprocess/*table.py", "postprocess/*/*.py"),
    "PIL": ("postprocess/scene/*.py",),
    "trame_pyvista": ("postprocess/scene/*.py",),
    "xlsxwriter": ("postprocess/report/*.py",),
    "jinja2": ("postprocess/report/*.py", "postprocess/scene/*.py"),
    "markupsafe": ("postprocess/*/*.py",),
    "pyarrow": ("postprocess/batch/write.py", "cases/cli/batch.py"),
    "distributed": ("cases/batch/pools.py",),
}
PRINTS = ("cases/cli/", "cases/runs/interrupt.py")


def is_type_checking(node):
    return isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"


def imports(name, *, typing_only=True):
    """Top names of the absolute imports of a module; without those for type checkers if not `typing_only`."""
    skipped = set()
    if not typing_only:
        blocks = [node for node in ast.walk(tree(name)) if is_type_checking(node)]
        skipped = {id(child) for node in blocks for child in ast.walk(node)}
    found = set()
    for node in ast.walk(tree(name)):
        if id(node) in skipped:
            continue
        if isinstance(node, ast.Import):
            found |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            found.add(node.module.split(".")[0])
    return found


def test_layers():
    """ehl <- bearing <- postprocess <- cases: a layer imports only those before it."""
    later = {own: set(LAYERS[LAYERS.index(own) + 1 :]) for own in LAYERS}
    offenders = {name: found for name in FILES if (found := imports(name) & later[layer(name)])}
    assert nothing(offenders)


def test_a_layer_speaks_to_itself_in_relative_imports():
    assert nothing([name for name in FILES if layer(name) in imports(name)])


def test_homes_of_heavy_libraries():
    offenders = [
        f"{name} imports {library}, which belongs in {HOMES[library]}"
        for name, path in FILES.items()
        for library in sorted(imports(name, typing_only=False) & HOMES.keys())
        if not any(path.match(home) for home in HOMES[library])
    ]
    assert nothing(offenders)


def test_only_known_libraries():
    known = {"numpy", "scipy", *LAYERS, *HOMES, *sys.stdlib_module_names}
    assert nothing({name: found for name in FILES if (found := imports(name) - known)})


def test_no_print_below_the_command():
    offenders = [
        at(name, node)
        for name, node in nodes(ast.Call)
        if isinstance(node.func, ast.Name) and node.func.id == "print" and not name.startswith(PRINTS)
    ]
    assert nothing(offenders)
