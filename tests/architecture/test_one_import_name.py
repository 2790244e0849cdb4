"""One import name: everything of the product is `oilfilm.*`, once, from one place.

In a checkout the parts lie beside `oilfilm/`, and a bare `import bearing` would load a second copy, whose classes are
others: `bearing.Bearing is oilfilm.bearing.Bearing` was False.
"""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

import pytest

import oilfilm
from oilfilm import bearing, cases, ehl, postprocess

from .import_graph import LAYERS, ROOT, module_files
from .sources import nothing

PARTS = tuple(layer for layer in LAYERS if layer != "oilfilm")
HOME = Path(oilfilm.__file__).resolve().parent
FOLDERS = (*(ROOT / layer for layer in LAYERS), HOME)


def product_modules(modules):
    """{name: resolved file} of the loaded modules whose file is one of the product's."""
    files = {}
    for name, module in list(modules.items()):
        file = getattr(module, "__file__", None)
        if not file:
            continue
        path = Path(file).resolve()
        if any(path.is_relative_to(folder) for folder in FOLDERS):
            files[name] = path
    return files


def home_of(modules):
    """Folder that the files of `oilfilm.ehl` lie in, with links followed."""
    return Path(modules["oilfilm.ehl"].__file__).resolve().parent


def relative_home(path, home):
    """Path below the folder that holds the part of `home`; None elsewhere."""
    holder = home.parent  # site-packages/oilfilm, or the root of a checkout
    return path.relative_to(holder) if path.is_relative_to(holder) else None


def second_copies(modules):
    """Names and files that show a second copy: bare names, files loaded twice, files of another place."""
    loaded = product_modules(modules)
    home = home_of(modules)
    wrong = [f"{name}: not below oilfilm" for name in loaded if name.partition(".")[0] != "oilfilm"]
    names = {}
    for name, path in loaded.items():
        if path in names:
            wrong.append(f"{path}: loaded as {names[path]} and as {name}")
        names.setdefault(path, name)
    wrong += [
        f"{name}: {path}, not beside {home}" for name, path in loaded.items() if relative_home(path, home) is None
    ]
    return wrong


def test_no_second_copy_is_loaded():
    """`pytest_sessionfinish` in tests/conftest.py demands it once more of each worker after its last test."""
    assert ehl and bearing and postprocess and cases
    assert nothing(second_copies(sys.modules))


def planted(name, path):
    module = ModuleType(name)
    module.__file__ = str(path)
    return {**sys.modules, name: module}


@pytest.mark.parametrize("name", ["bearing.geometry", "oilfilm.other"])
def test_a_second_copy_is_found(name):
    """A bare name, and a file under a second name below `oilfilm`."""
    import oilfilm.bearing.geometry as geometry

    assert second_copies(planted(name, geometry.__file__))


def test_a_copy_in_another_place_is_found():
    """One part from the checkout, the other from an installation."""
    home = home_of(sys.modules)
    places = {ROOT / "bearing" / "elsewhere.py", HOME / "bearing" / "elsewhere.py"}
    others = [path for path in places if relative_home(path, home) is None]
    for path in others:  # none where the product is installed by links into the checkout
        assert second_copies(planted("oilfilm.bearing.elsewhere", path))


@pytest.mark.parametrize("part", PARTS)
def test_a_bare_import_is_refused(part):
    """With the root of the checkout on the path, where the folder of that name lies."""
    code = f"import sys; sys.path.insert(0, {str(ROOT)!r}); import {part}"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.returncode != 0
    assert run.stderr.splitlines()[-1] == f"ImportError: import oilfilm.{part}"


def test_every_module_is_found_below_the_one_name():
    names = sorted(module_files())
    assert len(names) > 100
    assert all(name.partition(".")[0] == "oilfilm" for name in names)
    assert nothing([name for name in names if find_spec(name) is None])


def test_the_files_of_the_product_are_those_of_git():
    """Data beside the modules, too: what the wheel leaves out fails at the user's."""
    answer = subprocess.run(["git", "ls-files", *LAYERS], cwd=ROOT, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        pytest.skip("no checkout of git")
    missing = []
    for name in answer.stdout.splitlines():
        below = Path(name).relative_to("oilfilm") if name.startswith("oilfilm/") else Path(name)
        if (
            (ROOT / name).exists()
            and not (HOME / below).exists()
            and not (home_of(sys.modules).parent / below).exists()
        ):
            missing.append(name)
    assert nothing(missing)
