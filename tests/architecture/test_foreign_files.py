"""Who may read what others have written: each way to read a file has one home, and pickles stay within a program."""

from __future__ import annotations

import ast

import pytest

from .sources import FILES, at, nodes, nothing, tree

OWN_PROCESSES = ("cases/runs/drawing.py", "cases/batch/results.py")  # files that they make themselves
READERS = {
    "ehl/foreign_files.py": {"zipfile", "lzma", "zlib"},
    "ehl/traction_table/compression.py": {"lzma"},  # packs; `unpacked` is its way back
    "cases/app/design.py": {"zlib"},  # of the address of a page, up to a length
    "postprocess/batch/store.py": {"sqlite3", "zlib"},
    "postprocess/netcdf_write.py": {"h5py", "h5netcdf"},
    "postprocess/dynamics/history.py": {"h5py", "h5netcdf"},
}
PICKLES = {"pickle", "cPickle", "_pickle", "dill", "cloudpickle", "joblib", "shelve", "marshal", "dbm"}
FORMATS = {"zipfile", "tarfile", "lzma", "zlib", "bz2", "gzip", "sqlite3", "h5py", "h5netcdf", "netCDF4"}
JSON = (
    "ehl/foreign_files.py",
    "ehl/data_files.py",  # within what `foreign_files` has read, whose faults it reports
    "ehl/traction_table/storage.py",
    "bearing/friction/tables.py",
    "bearing/dynamics/simulation.py",
    "postprocess/scene/render_process.py",  # words of the parent process
)
STARTERS = (
    "cases/runs/kernel_cache.py",
    "cases/runs/processes.py",
    "postprocess/scene/render_process.py",
    "postprocess/fmu/export.py",  # a compiler of C, in a folder of its own
)
RUN = {"eval", "exec", "compile", "__import__"}


def imported(name):
    """Modules that a file imports, by their first name."""
    for node in ast.walk(tree(name)):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield (node.module or "").partition(".")[0]


def test_pickles_stay_between_own_processes():
    assert nothing([name for name in FILES if set(imported(name)) & PICKLES and name not in OWN_PROCESSES])


def test_each_format_has_one_reader():
    wrong = {name: set(imported(name)) & FORMATS - READERS.get(name, set()) for name in FILES}
    assert nothing({name: found for name, found in wrong.items() if found})


@pytest.mark.parametrize("module", ["numpy", "np"])
def test_no_array_is_read_by_numpy_itself(module):
    """`read_arrays` does, without pickle; `loadtxt` reads lines of text."""
    wrong = [
        at(name, node)
        for name, node in nodes(ast.Attribute)
        if isinstance(node.value, ast.Name)
        and node.value.id == module
        and node.attr in ("load", "fromfile", "memmap", "genfromtxt", "savez_compressed", "save")
    ]
    assert nothing(wrong)


def called(module, function):
    """Places where a function of a module is called."""
    for name, node in nodes(ast.Call):
        of = node.func
        if isinstance(of, ast.Attribute) and of.attr == function and ast.unparse(of.value) == module:
            yield name, at(name, node)


def test_json_of_files_goes_through_one_function():
    assert nothing([place for name, place in called("json", "loads") if name not in JSON])
    assert not list(called("json", "load"))


def test_no_text_is_run():
    wrong = [
        at(name, node) for name, node in nodes(ast.Call) if isinstance(node.func, ast.Name) and node.func.id in RUN
    ]
    assert nothing(wrong)


def test_results_are_opened_by_one_function():
    """xarray opens what `open_netcdf` has looked through."""
    names = ("open_dataset", "open_datatree", "open_mfdataset", "load_dataset")
    wrong = [place for name in names for _, place in called("xarray", name)]
    wrong += [place for name in names for _, place in called("xr", name)]
    assert nothing(wrong)


def test_processes_do_not_look_for_modules_where_they_are_started():
    """`python -P`: the folder of the user is no place of libraries; `start_fork_server` says it in the environment."""
    wrong = [
        at(name, node)
        for name, node in nodes(ast.List)
        if node.elts and ast.unparse(node.elts[0]) == "sys.executable" and ast.unparse(node.elts[1]) != "'-P'"
    ]
    wrong += [place for name, place in called("subprocess", "run") if name not in STARTERS]
    wrong += [place for name, place in called("subprocess", "Popen") if name not in STARTERS]
    wrong += [at(name, node) for name, node in nodes(ast.Constant) if node.value == "spawn" and name not in STARTERS]
    assert nothing(wrong)
