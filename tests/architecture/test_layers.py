"""The architecture as tests: layers and homes of heavy libraries. Each lists all offenders."""

from __future__ import annotations

import ast
import sys

import pytest

from .sources import FILES, LAYERS, at, layer, nodes, nothing, tree

HOMES = {
    "numba": ("*_kernels.py", "ehl/compiled.py"),
    "lazy_loader": ("__init__.py",),
    "threadpoolctl": ("bearing/dynamics/simulation.py", "bearing/shaft/vibration.py"),
    "skfem": ("ehl/finite_element/*.py", "ehl/solid/*.py", "ehl/solid/bodies/*.py"),
    "CoolProp": ("bearing/library/media.py",),
    "pyamg": ("ehl/solid/bodies/elasticity.py",),
    "vtk": ("postprocess/scene/*.py",),
    "vtkmodules": ("postprocess/scene/*.py",),
    "meshio": ("postprocess/scene/*.py",),
    "pyvista": ("postprocess/scene/*.py",),
    "pandas": ("postprocess/run_result.py",),
    "matplotlib": ("postprocess/plot*.py", "postprocess/*/*.py"),
    "xarray": ("postprocess/open_results.py", "postprocess/*/*.py"),
    "h5netcdf": ("postprocess/netcdf_write.py", "postprocess/*/history.py"),
    "h5py": ("postprocess/netcdf_write.py", "postprocess/*/history.py"),
    "typer": ("cases/cli/*.py",),
    "pydantic": ("cases/format/*.py", "cases/batch/*.py", "cases/optimise/*.py"),
    "pydantic_core": ("cases/format/*.py", "cases/batch/compute.py"),
    "rich": ("cases/cli/*.py", "postprocess/quantities.py", "postprocess/compare.py", "postprocess/*/*.py"),
    "PIL": ("postprocess/scene/*.py",),
    "trame_pyvista": ("postprocess/scene/*.py",),
    "trame_client": ("cases/app/server.py",),
    "trame_server": ("cases/app/server.py",),
    "trame_vtk": ("cases/app/server.py",),
    "aiohttp": ("cases/app/server.py",),
    "xlsxwriter": ("postprocess/report/*.py",),
    "jinja2": ("postprocess/report/*.py", "postprocess/scene/*.py"),
    "markupsafe": ("postprocess/*/*.py",),
    "pyarrow": ("postprocess/batch/write.py", "cases/cli/batch.py"),
    "distributed": ("cases/batch/pools.py",),
    "sklearn": ("cases/optimise/search.py", "cases/cli/optimise.py"),
}
PRINTS = ("cases/cli/", "cases/runs/interrupt.py")


def is_type_checking(node):
    return isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"


def top_names(node):
    """Libraries and layers that an absolute import names."""
    if isinstance(node, ast.Import):
        dotted = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
        whole = node.module == "oilfilm"
        dotted = [f"oilfilm.{alias.name}" for alias in node.names] if whole else [node.module]
    else:
        return set()
    parts = [name.split(".") for name in dotted]
    return {part[1] if part[0] == "oilfilm" and part[1:2] and part[1] in LAYERS else part[0] for part in parts}


@pytest.mark.parametrize(
    ("code", "names"),
    [
        ("import numpy as np", {"numpy"}),
        ("from oilfilm.ehl.solver import solve_contact", {"ehl"}),
        ("from oilfilm import bearing, ehl", {"bearing", "ehl"}),
        ("from oilfilm import solve_contact", {"oilfilm"}),
        ("from .oil import lubricant", set()),
    ],
)
def test_which_layers_an_import_names(code, names):
    assert top_names(ast.parse(code).body[0]) == names


def imports(name, *, typing_only=True):
    """Libraries and layers that a module imports; without those for type checkers if not `typing_only`."""
    skipped = set()
    if not typing_only:
        blocks = [node for node in ast.walk(tree(name)) if is_type_checking(node)]
        skipped = {id(child) for node in blocks for child in ast.walk(node)}
    found = set()
    for node in ast.walk(tree(name)):
        if id(node) in skipped:
            continue
        found |= top_names(node)
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
