"""The architecture as a test: layers, homes of heavy libraries, sizes."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LAYERS = ("ehl", "bearing", "postprocess", "cases")
MODULES = [path for layer in LAYERS for path in sorted((ROOT / layer).rglob("*.py"))]
HOMES = {
    "numba": ("_kernels.py", "ehl/compiled.py"),
    "skfem": ("ehl/reynolds_fem.py", "ehl/layered_fem.py", "ehl/subsurface.py"),
    "pyamg": ("ehl/linear_solvers.py",),
    "vtk": ("postprocess/vtk.py",),
    "vtkmodules": ("postprocess/vtk.py",),
    "meshio": ("postprocess/vtk.py",),
    "pyvista": ("postprocess/scene*.py", "postprocess/vtk.py", "postprocess/animation.py"),
    "matplotlib": ("postprocess/plot*.py", "postprocess/scene.py"),
    "xarray": ("postprocess/results_io.py", "postprocess/history_io.py"),
    "h5netcdf": ("postprocess/results_io.py", "postprocess/history_io.py"),
    "h5py": ("postprocess/history_io.py",),
    "typer": ("cases/commands/*.py", "cases/terminal.py"),
    "pydantic": ("cases/schema/*.py", "cases/case.py", "cases/problems.py", "cases/batch/sweep.py"),
    "pydantic_core": ("cases/schema/*.py",),
    "rich": ("cases/commands/*.py", "cases/terminal.py", "postprocess/*table.py", "postprocess/slip_results.py"),
    "PIL": ("postprocess/scene_motion.py", "postprocess/animation.py"),
    "trame_pyvista": ("postprocess/scene.py",),
    "distributed": ("cases/batch/pools.py",),
}
FUNCTION_LINES, MODULE_LINES, ARGUMENTS = 40, 400, 7


def name_of(path):
    return path.relative_to(ROOT).as_posix()


def is_type_checking(node):
    return isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"


def imports(tree, *, typing_only=True):
    """Top names of the absolute imports of a module; without those for type checkers if not `typing_only`."""
    skipped = set()
    if not typing_only:
        skipped = {id(child) for node in ast.walk(tree) if is_type_checking(node) for child in ast.walk(node)}
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield node.module.split(".")[0]


@pytest.fixture(params=MODULES, ids=name_of)
def module(request):
    return request.param, ast.parse(request.param.read_text(encoding="utf-8"))


def test_layers(module):
    """ehl <- bearing <- postprocess <- cases: a layer imports only those before it."""
    path, tree = module
    own = path.relative_to(ROOT).parts[0]
    later = LAYERS[LAYERS.index(own) + 1 :]
    assert not set(imports(tree)) & set(later)


def test_a_layer_speaks_to_itself_in_relative_imports(module):
    path, tree = module
    assert path.relative_to(ROOT).parts[0] not in set(imports(tree))


def test_homes_of_heavy_libraries(module):
    path, tree = module
    for library in set(imports(tree, typing_only=False)) & HOMES.keys():
        homes = HOMES[library]
        assert any(path.match(home) for home in homes), f"{library} belongs in {homes}"


def test_only_known_libraries(module):
    _, tree = module
    known = {"numpy", "scipy", *LAYERS, *HOMES, *sys.stdlib_module_names}
    assert set(imports(tree)) <= known


def docstring_lines(function):
    first = function.body[0]
    is_text = (
        isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str)
    )
    return first.end_lineno - first.lineno + 1 if is_text else 0


def test_sizes(module):
    """Small pieces: a module of 400 lines, a function body of 40 lines, 7 arguments (kernels may take more)."""
    path, tree = module
    assert len(path.read_text(encoding="utf-8").splitlines()) <= MODULE_LINES
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            body = node.end_lineno - node.body[0].lineno + 1 - docstring_lines(node)
            assert body <= FUNCTION_LINES, f"{node.name} has {body} lines"
            arguments = len(node.args.posonlyargs) + len(node.args.args) + len(node.args.kwonlyargs)
            if path.name != "_kernels.py" and node.name not in COMMANDS:
                assert arguments <= ARGUMENTS, f"{node.name} takes {arguments} arguments"


COMMANDS = ("run", "contact", "batch", "table")  # of the command line: an argument each option


def test_no_print_below_the_command(module):
    path, tree = module
    if path.parent.name != "cases":
        calls = {
            node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        }
        assert "print" not in calls
