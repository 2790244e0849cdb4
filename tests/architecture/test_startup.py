"""What a start imports. Time is not asserted, it depends on the machine: `benchmarks/startup.py` measures it."""

from __future__ import annotations

import subprocess
import sys

HEAVY = {
    "numpy", "scipy", "numba", "xarray", "h5netcdf", "h5py", "matplotlib", "pyvista", "vtk", "vtkmodules",
    "skfem", "pyamg", "meshio", "rich", "pydantic", "distributed",
}  # fmt: skip


def imported(code):
    """Heavy libraries that are loaded after a piece of Python."""
    code += f"\nimport sys\nprint('loaded', *({HEAVY!r} & sys.modules.keys()))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(run.stdout.splitlines()[-1].split()[1:])


def test_help_imports_nothing_heavy():
    code = """
import sys
from oilfilm.cases.cli.start import main
sys.argv = ["oilfilm", "--help"]
try:
    main()
except SystemExit as stop:
    assert stop.code == 0
"""
    assert imported(code) == set()


def test_the_contact_solver_is_loaded_when_it_is_used():
    assert imported("from oilfilm import ehl") <= {"numpy"}
    assert {"scipy", "numba"} <= imported("from oilfilm import ehl; ehl.solve_contact")


def test_bearings_are_loaded_without_scipy():
    assert imported("from oilfilm import bearing") <= {"numpy"}


def test_the_front_door_is_empty_until_it_is_used():
    assert imported("import oilfilm") == set()
    assert {"scipy", "numba"} <= imported("import oilfilm; oilfilm.solve_contact")


def test_results_and_cases_are_loaded_when_they_are_used():
    assert imported("from oilfilm import cases, postprocess") <= {"numpy"}
